#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "peritherm/base/text.hpp"
#include "peritherm/studies/run_study.hpp"
#include "peritherm/studies/study_errors.hpp"

namespace peritherm {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

StudyRow make_row(const ReadStudy& read, const StudySummary& summary, std::size_t run, std::size_t time) {
  StudyRow row{run, time, {}, {}, {}};
  const Solution& solution = *summary.results[run].solution;
  const bool by_finest = std::holds_alternative<FinestReference>(read.study.reference);
  const Solution* finest = by_finest ? finest_run(read, summary.results, read.runs[run].variant) : nullptr;
  const bool comparable = !by_finest || (finest != nullptr && finest != &solution);
  row.errors.assign(read.study.norms.size(), missing);
  if (comparable) {
    const ComparedTemperatures compared = compare(read, solution, time, finest);
    for (std::size_t k = 0; k < row.errors.size(); ++k) {
      row.errors[k] = measure(read.study.norms[k], compared.computed, compared.reference);
    }
  }
  for (const StudyProbe& probe : read.study.probes) {
    const Point place = to_point(probe.at);
    row.probes.push_back(solution.at(time, place));
    row.references.push_back(comparable ? reference_at(read, place, time, solution.horizon, finest) : missing);
  }
  return row;
}

/// Runs that differ along one axis only: variant and the entries along the others.
using SeriesKey = std::tuple<std::size_t, std::array<int, 4>>;

std::string series_name(const ReadStudy& read, const StudyRun& run, StudyAxis along) {
  std::vector<std::string> parts;
  if (read.study.variants.size() > 1) parts.push_back(read.study.variants[run.variant].name);
  for (const StudyAxis axis : study_axes) {
    if (axis == along || count_values(read.study.vary, axis) < 2) continue;
    parts.push_back(std::string(axis_name(axis)) + ' ' + axis_text(run, axis));
  }
  return join(parts);
}

double error_of(const ReadStudy& read, const StudyRow& row, std::size_t quantity) {
  const std::size_t norms = read.study.norms.size();
  if (quantity < norms) return row.errors[quantity];
  return std::abs(row.probes[quantity - norms] - row.references[quantity - norms]);
}

std::string quantity_name(const ReadStudy& read, std::size_t quantity) {
  const std::size_t norms = read.study.norms.size();
  return quantity < norms ? std::string(name_of(read.study.norms[quantity])) : read.study.probes[quantity - norms].name;
}

void fit(ConvergenceSeries& series, StudyAxis axis) {
  std::vector<double> sizes = series.parameters;
  if (axis == StudyAxis::horizon_ratio) {
    for (double& size : sizes) size = 1.0 / size;
  }
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
    series.rates.push_back(convergence_rate(sizes[i], series.errors[i], sizes[i + 1], series.errors[i + 1]));
  }
  series.rate = fitted_rate(sizes, series.errors);
}

const StudyRow* row_of(const StudySummary& summary, std::size_t run, std::size_t time) {
  const auto found = std::find_if(summary.rows.begin(), summary.rows.end(),
                                  [run, time](const StudyRow& row) { return row.run == run && row.time == time; });
  return found == summary.rows.end() ? nullptr : &*found;
}

void add_series(const ReadStudy& read, StudyAxis axis, const std::vector<std::size_t>& runs, StudySummary& summary) {
  for (std::size_t time = 0; time < read.study.times.size(); ++time) {
    for (std::size_t q = 0; q < read.study.norms.size() + read.study.probes.size(); ++q) {
      ConvergenceSeries series;
      series.axis = axis_name(axis);
      series.quantity = quantity_name(read, q);
      series.name = series_name(read, read.runs[runs.front()], axis);
      series.time = read.study.times[time];
      for (const std::size_t run : runs) {
        const StudyRow* row = row_of(summary, run, time);
        series.parameters.push_back(axis_value(read.runs[run], axis));
        series.errors.push_back(row == nullptr ? missing : error_of(read, *row, q));
      }
      fit(series, axis);
      summary.series.push_back(std::move(series));
    }
  }
}

void add_all_series(const ReadStudy& read, StudyAxis axis, StudySummary& summary) {
  std::map<SeriesKey, std::vector<std::size_t>> groups;
  for (std::size_t run = 0; run < read.runs.size(); ++run) {
    std::array<int, 4> others = read.runs[run].entries;
    others[static_cast<std::size_t>(axis)] = 0;
    groups[{read.runs[run].variant, others}].push_back(run);
  }
  for (auto& [key, runs] : groups) {
    // From coarse to fine, however the list is written.
    std::sort(runs.begin(), runs.end(), [&](std::size_t a, std::size_t b) {
      const double first = axis_value(read.runs[a], axis), second = axis_value(read.runs[b], axis);
      return axis == StudyAxis::horizon_ratio ? first < second : first > second;
    });
    add_series(read, axis, runs, summary);
  }
}

}  // namespace

const Solution* finest_run(const ReadStudy& read, const std::vector<RunResult>& results, std::size_t variant) {
  const StudyRun* best = nullptr;
  const Solution* solution = nullptr;
  for (std::size_t n = 0; n < read.runs.size(); ++n) {
    const StudyRun& run = read.runs[n];
    const auto fineness = [](const StudyRun& r) { return std::tuple(r.horizon, r.spacing, r.step.value_or(0.0)); };
    if (run.variant != variant || (best != nullptr && fineness(run) >= fineness(*best))) continue;
    best = &run;
    solution = results[n].solution ? &*results[n].solution : nullptr;
  }
  return solution;
}

void compare_runs(const ReadStudy& read, StudySummary& summary) {
  for (std::size_t run = 0; run < read.runs.size(); ++run) {
    for (std::size_t time = 0; summary.results[run].solution && time < read.study.times.size(); ++time) {
      summary.rows.push_back(make_row(read, summary, run, time));
    }
  }
  for (const StudyAxis axis : study_axes) {
    if (count_values(read.study.vary, axis) >= 2) add_all_series(read, axis, summary);
  }
}

}  // namespace peritherm
