#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "peritherm/papers/paper_chart.hpp"
#include "peritherm/papers/xue_2018_cases.hpp"
#include "peritherm/papers/xue_2018_sections.hpp"
#include "peritherm/papers/xue_2018_values.hpp"

namespace peritherm {
namespace {

constexpr int mode_steps_2018 = 400;  ///< leave 1e-5 of the mode

ContactTask mode_task_2018(const LayersOf2018& layers, int cells, double stabilisation) {
  Problem problem = problem_of_2018({layers, cells, 3.0, stabilisation, 1});
  start_in(problem, mode_of_2018(layers), 0.0);
  step_by(problem, layers.mode_end / mode_steps_2018, 1.0, 1.0);
  return {std::move(problem), {layers.mode_end}};
}

/// Errors of one case on ever finer grids.
struct ModeSeries {
  const xue_2018_values::ModeErrors& known;
  std::vector<int> cells;
  std::vector<ContactErrors> errors;
  double residual = 0.0;

  double order() const {
    const std::size_t last = errors.size() - 1;
    return halving_order(errors[last - 1].temperature, errors[last].temperature);
  }
};

std::vector<ModeSeries> mode_series_2018(PaperRuns& runs) {
  const std::vector<int> cells = runs.quick() ? std::vector<int>{20, 40, 80} : std::vector<int>{20, 40, 80, 160};
  std::vector<ContactTask> tasks;
  std::vector<ModeSeries> series;
  for (const auto& known : xue_2018_values::modes) {
    const LayersOf2018& layers = layers_of_2018(std::string(known.name));
    for (const int n : cells) tasks.push_back(mode_task_2018(layers, n, known.stabilisation));
    series.push_back({known, cells, {}});
  }
  const std::vector<ContactRun> computed = march_contacts(runs, tasks);
  std::size_t next = 0;
  for (ModeSeries& one : series) {
    const ContactMode mode = mode_of_2018(layers_of_2018(std::string(one.known.name)));
    for (std::size_t k = 0; k < cells.size(); ++k, ++next) {
      one.errors.push_back(errors_of(computed[next], 0, mode));
      one.residual = std::max(one.residual, computed[next].summary.largest_residual);
    }
  }
  return series;
}

ReportTable mode_table_2018(const std::vector<ModeSeries>& series) {
  ReportTable table{"Largest error over the largest temperature, horizon of three spacings", {}};
  for (const ModeSeries& one : series) {
    for (std::size_t k = 0; k < one.cells.size(); ++k) {
      ReportRow row(
          fmt::format("{}, s = {}, {} points per layer", one.known.name, one.known.stabilisation, one.cells[k]),
          {1, true});
      row.defaults(one.errors[k].temperature);
      if (one.cells[k] == 20) row.recomputed(one.known.coarse);
      if (one.cells[k] == 160) row.recomputed(one.known.fine);
      // The prototype prints two digits.
      if (row.value(ValueKind::recomputed)) {
        row.below("|ours / its - 1|", std::abs(one.errors[k].temperature / *row.value(ValueKind::recomputed) - 1.0),
                  0.06);
      }
      table.rows.push_back(std::move(row));
    }
    table.rows.push_back(
        ReportRow(fmt::format("{}, s = {}, order of the last halving", one.known.name, one.known.stabilisation),
                  {2, false})
            .defaults(one.order())
            .below("|order - 2|", std::abs(one.order() - 2.0), 0.2));
  }
  return table;
}

ReportTable mode_flux_table_2018(const std::vector<ModeSeries>& series) {
  ReportTable table{"Error of the flux through the contact over the largest flux, finest grid; constraint residual",
                    {}};
  for (const ModeSeries& one : series) {
    table.rows.push_back(ReportRow(fmt::format("{}, s = {}", one.known.name, one.known.stabilisation), {1, true})
                             .defaults(one.errors.back().flux)
                             .below("residual after any step", one.residual, 1e-12));
  }
  return table;
}

ReportPicture mode_picture_2018(const std::vector<ModeSeries>& series, const PaperRuns& runs) {
  Chart chart = make_paper_chart("Exact modes: error of the temperature", "horizon δ", "largest error, relative", true);
  for (const ModeSeries& one : series) {
    if (one.known.stabilisation != 1.0) continue;
    Curve curve{std::string(one.known.name), {}, {}, CurveStyle::dots_on_line};
    for (std::size_t k = 0; k < one.cells.size(); ++k) {
      curve.x.push_back(1.5 / one.cells[k]);
      curve.y.push_back(one.errors[k].temperature);
    }
    chart.curves.push_back(std::move(curve));
  }
  chart.slopes.push_back({0.02, 0.04, 1.5e-4, 2.0, "2"});
  return save_paper_chart(chart, "2018_modes", "Modes of two layers, s = 1: second order in the horizon.", runs);
}

ReportTable rate_table_2018() {
  ReportTable table{"Rates σ of the exact modes, real and imaginary part [1/s]", {}};
  const auto add = [&](const std::string& name, std::complex<double> found, std::complex<double> known) {
    for (const bool imaginary : {false, true}) {
      const double value = imaginary ? found.imag() : found.real();
      if (imaginary && known.imag() == 0.0) continue;
      table.rows.push_back(ReportRow(name + (imaginary ? ", imaginary" : ", real"), {12, false})
                               .recomputed(imaginary ? known.imag() : known.real())
                               .exact(value)
                               .near(ValueKind::exact, ValueKind::recomputed, 1e-12));
    }
  };
  add("I perfect", mode_of_2018(layers_of_2018("I perfect")).rate(), -2.997269960607);
  add("I resistance", mode_of_2018(layers_of_2018("I resistance")).rate(), -2.500715699953);
  add("II perfect", mode_of_2018(layers_of_2018("II perfect")).rate(), {-3.405500096603, 2.672634591388});
  add("II resistance", mode_of_2018(layers_of_2018("II resistance")).rate(), {-3.243632924927, 1.890791193594});
  add("III resistance", mode_of_2018(layers_of_2018("III resistance")).rate(), {-1.101903979687, 2.587099313997});
  return table;
}

}  // namespace

ReportSection modes_section_2018(PaperRuns& runs) {
  const std::vector<ModeSeries> series = mode_series_2018(runs);
  ReportSection section;
  section.blocks.push_back(ReportText{
      "Two layers held at 0 at both ends decay in modes that are known exactly for every law of flux and every "
      "resistance. A run starts in the slow one and is held against it at t = 0.3 (I), 0.6 (II) and 1 (III), after 400 "
      "steps of Crank and Nicolson. Where materials relax, the rates are complex: temperatures swing."});
  section.blocks.push_back(rate_table_2018());
  section.blocks.push_back(mode_picture_2018(series, runs));
  section.blocks.push_back(mode_table_2018(series));
  section.blocks.push_back(mode_flux_table_2018(series));
  if (runs.quick()) section.left_out = "160 points per layer.";
  return section;
}

}  // namespace peritherm
