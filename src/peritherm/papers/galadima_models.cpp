#include "peritherm/papers/galadima_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "peritherm/papers/paper_chart.hpp"
#include "peritherm/reduction/model_products.hpp"

namespace peritherm {
namespace {

class StopWatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Problem on_one_thread(Problem problem, const std::vector<double>& times) {
  problem.numerics.threads = 1;
  problem.time.end = times.back();
  OutputOptions& output = problem.outputs.emplace_back();
  output.times = times;
  return problem;
}

double largest_difference_at(const std::vector<double>& a, const std::vector<double>& b,
                             const std::vector<std::int64_t>& points) {
  double largest = 0.0;
  for (const std::int64_t n : points)
    largest = std::max(largest, std::abs(a[static_cast<std::size_t>(n)] - b[static_cast<std::size_t>(n)]));
  return largest;
}

double largest_difference_of(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
  return largest;
}

std::vector<double> shapes_product(const SparseMatrix& shapes, const std::vector<double>& unknowns) {
  std::vector<double> values(shapes.rows(), 0.0);
  for (std::size_t row = 0; row < values.size(); ++row) {
    for (auto n = static_cast<std::size_t>(shapes.begin[row]); n < static_cast<std::size_t>(shapes.begin[row + 1]); ++n)
      values[row] += shapes.values[n] * unknowns[static_cast<std::size_t>(shapes.column_of[n])];
  }
  return values;
}

double bytes_in(const Matrix& matrix) { return static_cast<double>(matrix.values.size() * sizeof(double)); }

/// Shares of all retained and held points in the temperature of each point.
std::vector<double> sums_of_shares(const ReducedModel& model) {
  std::vector<double> sums = shapes_product(model.basis.shapes, std::vector<double>(model.unknowns(), 1.0));
  std::size_t input = 0;
  for (const Load& load : model.loads) {
    for (std::size_t k = 0; k < load.shapes.size(); ++k, ++input) {
      if (load.kind != LoadKind::temperature) continue;
      const ConstField direct = model.direct.column(input);
      std::vector<double> at_once;
      for (const std::int64_t n : model.retained) at_once.push_back(direct[static_cast<std::size_t>(n)]);
      const std::vector<double> through_unknowns = shapes_product(model.basis.shapes, at_once);
      for (std::size_t n = 0; n < sums.size(); ++n) sums[n] += direct[n] - through_unknowns[n];
    }
  }
  return sums;
}

std::string duration_text(double seconds) {
  return seconds < 1e-2 ? fmt::format("{:.2g} ms", 1e3 * seconds) : fmt::format("{:.2g} s", seconds);
}

std::string largest_error_text(const std::vector<double>& errors) {
  if (errors.empty()) return "";
  return fmt::format("{:.1e}", *std::max_element(errors.begin(), errors.end()));
}

}  // namespace

double TriedModel::worst() const { return *std::max_element(everywhere.begin(), everywhere.end()); }

double TriedModel::model_bytes() const {
  const ReducedModel& one = model();
  const double sparse = 12.0 * static_cast<double>(one.basis.shapes.values.size());
  return sparse + bytes_in(one.basis.dense) + bytes_in(one.basis.modes) + bytes_in(one.direct);
}

TrialBody::TrialBody(const Problem& problem, std::vector<double> times, bool relative, PaperRuns& runs)
    : problem_(on_one_thread(problem, times)),
      runs_(runs),
      relative_(relative),
      full_(runs.solve(PaperRun{problem, std::move(times)})),
      reducible_(make_reducible(problem_)) {}

TriedModel TrialBody::reduce(std::string name, const ReductionMethod& method) {
  const StopWatch watch;
  const ReductionProgress progress = [this](const std::string&, double) {
    runs_.pass();
    return true;
  };
  Reduction reduction = peritherm::reduce(method, reducible_.full, progress);
  const double set_up = watch.seconds();
  TriedModel tried = judge(std::move(name), std::move(reduction));
  tried.set_up = set_up;
  return tried;
}

TriedModel TrialBody::judge(std::string name, Reduction reduction) const {
  TriedModel tried;
  tried.name = std::move(name);
  tried.reduction = std::move(reduction);
  const ModelAnswerer answerer(tried.model());
  const ModelQuestion question = make_question(problem_, tried.model(), full_.times);
  const StopWatch watch;
  for (const ModelState& state : answerer.answer(question)) {
    lift(tried.model(), state, question.level, tried.temperatures.emplace_back(full_.grid.size()));
  }
  tried.answer = watch.seconds();
  for (std::size_t k = 0; k < full_.times.size(); ++k) {
    const std::vector<double>& right = full_.temperatures[k];
    double span = 1.0;
    if (relative_) span = *std::max_element(right.begin(), right.end());
    tried.everywhere.push_back(largest_difference_of(tried.temperatures[k], right) / span);
    if (tried.model().retained.empty()) continue;
    tried.at_retained.push_back(largest_difference_at(tried.temperatures[k], right, tried.model().retained) / span);
  }
  return tried;
}

double half_last_digit(double value) {
  const std::string text = fmt::format("{}", std::abs(value));
  const std::string digits = text.substr(0, text.find('e'));
  const std::size_t point = digits.find('.');
  // What stands behind the point, shifted by the power of ten.
  double power = point == std::string::npos ? 0.0 : -static_cast<double>(digits.size() - point - 1);
  if (digits.size() < text.size()) power += std::stod(text.substr(digits.size() + 1));
  return 0.501 * std::pow(10.0, power);
}

RetainedPoints every_point(int every) {
  RetainedPoints points;
  points.every = std::vector<int>{every};
  return points;
}

Reduction with_sampled_start(Reduction projected) {
  ReducedModel& model = projected.model;
  ModalEquations& equations = model.stages.front().equations;
  equations.start_gains = Matrix(equations.size(), model.inputs());
  for (std::size_t m = 0; m < model.inputs(); ++m) {
    // What inputs add at once to the temperatures of retained points has to be absent at first.
    std::vector<double> at_once;
    for (const std::int64_t n : model.retained) at_once.push_back(model.direct(static_cast<std::size_t>(n), m));
    std::vector<double> heats = shapes_product(model.basis.shapes, at_once);
    for (std::size_t n = 0; n < heats.size(); ++n) heats[n] *= model.capacities[n];
    const std::vector<double> shares = basis_product(model.basis, heats);
    std::copy(shares.begin(), shares.end(), equations.start_gains.column(m).begin());
  }
  model.start = ModelStart::sampled;
  return projected;
}

Reduction without_condensed_sources(Reduction reduction, double heating) {
  ReducedModel& model = reduction.model;
  ModalEquations& equations = model.stages.front().equations;
  for (std::size_t k = 0; k < equations.size(); ++k) {
    equations.gains(k, 0) = 0.0;
    for (std::size_t q = 0; q < model.retained.size(); ++q) {
      const auto point = static_cast<std::size_t>(model.retained[q]);
      if (point >= static_cast<std::size_t>(plate_points)) continue;
      equations.gains(k, 0) += model.basis.modes(q, k) * model.capacities[point] * heating;
    }
  }
  return reduction;
}

void add_shape_rows(ReportTable& table, const TriedModel& tried) {
  const ReducedModel& model = tried.model();
  double lowest = 0.0, sum_error = 0.0, capacity = 0.0, whole = 0.0;
  for (const double share : model.basis.shapes.values) lowest = std::min(lowest, share);
  const std::vector<double> sums = sums_of_shares(model);
  for (std::size_t n = 0; n < sums.size(); ++n) {
    if (model.capacities[n] == 0.0) continue;
    sum_error = std::max(sum_error, std::abs(sums[n] - 1.0));
    capacity += model.capacities[n] * sums[n];
    whole += model.capacities[n];
  }
  const auto rounding = [&](const std::string& what, double value) {
    table.rows.push_back(ReportRow(tried.name + ": " + what, {1, true}).below("off by", value, 1e-12));
  };
  rounding("no share of a retained point is negative", -lowest);
  rounding("the shares of every point sum to 1", sum_error);
  rounding("the capacities sum to the whole", std::abs(capacity / whole - 1.0));
}

double longest_step(const TriedModel& tried) { return 2.0 / tried.rates().back(); }

void add_error_rows(ReportTable& table, const TriedModel& tried, std::span<const double> times,
                    std::span<const double> reference) {
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (reference[k] <= 0.0) continue;
    ReportRow row(fmt::format("{}, {} s", tried.name, times[k]), {4, true});
    table.rows.push_back(row.recomputed(reference[k])
                             .scheme(tried.at_retained[k])
                             .near(ValueKind::scheme, ValueKind::recomputed, 0.02 * reference[k]));
  }
}

ReportTable side_by_side(std::string caption, const std::vector<const TriedModel*>& models) {
  ReportTable table{std::move(caption), {}};
  table.further = {"unknowns", "at retained points", "at all points", "set-up", "most memory", "model", "an answer"};
  for (const TriedModel* one : models) {
    ReportRow row(one->name, {0, false});
    row.further = {fmt::format("{}", one->unknowns()),
                   largest_error_text(one->at_retained),
                   largest_error_text(one->everywhere),
                   duration_text(one->set_up),
                   fmt::format("{:.1f} MiB", static_cast<double>(one->reduction.cost.peak_bytes) / 1048576.0),
                   fmt::format("{:.1f} MiB", one->model_bytes() / 1048576.0),
                   duration_text(one->answer)};
    table.rows.push_back(std::move(row));
  }
  return table;
}

Chart chart_over_time(std::string title, std::string y_label, const std::vector<double>& times,
                      const std::vector<const TriedModel*>& models) {
  Chart chart = make_paper_chart(std::move(title), "time [s]", std::move(y_label), true);
  for (const TriedModel* one : models) {
    chart.curves.push_back({one->name, times, one->everywhere, CurveStyle::dots_on_line});
  }
  return chart;
}

}  // namespace peritherm
