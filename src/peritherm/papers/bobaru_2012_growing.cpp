#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "peritherm/base/larger.hpp"
#include "peritherm/papers/bobaru_2012_plates.hpp"
#include "peritherm/papers/bobaru_2012_sections.hpp"
#include "peritherm/papers/bobaru_2012_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2012 = bobaru_2012_values;

constexpr double growing_limit = 5e-3;  ///< of what the prototype's steps of 5e-4 s leave [°C]
constexpr double fast = 1.14;           ///< diffusivities [cm²/s]
constexpr double slow = 0.114;
const std::vector<double> growing_times{1.0, 3.0, 5.0, 7.0};

Problem growing_plate(int cells, double diffusivity, PlateScheme scheme, double tolerance) {
  Problem problem = cracked_plate(cells, diffusivity, scheme);
  add_paper_crack(problem, {-0.5, -0.496}, {0.5, 0.504});
  add_paper_crack(problem, {0.5, -0.496}, {-0.5, 0.504});
  for (Crack& crack : problem.cracks) crack.tip_speed = 0.2 * centimetre;
  problem.time.integrator = RungeKuttaLegendre{tolerance};
  return problem;
}

/// A run and what it is called.
struct GrowingRun {
  int cells;
  double diffusivity;
  PlateScheme scheme;
  double tolerance;
};

std::string growing_name(const GrowingRun& run) {
  return fmt::format("{}, α = {} cm²/s, n = {}", run.scheme == PlateScheme::defaults ? "defaults" : "published scheme",
                     run.diffusivity, run.cells);
}

std::vector<GrowingRun> growing_runs(bool quick) {
  std::vector<GrowingRun> runs{{60, fast, PlateScheme::defaults, 1e-6}, {60, slow, PlateScheme::literal, 1e-6}};
  if (quick) return runs;
  runs.push_back({60, fast, PlateScheme::literal, 1e-6});
  // What the figure shows; pictures do not ask for more.
  for (const double diffusivity : {fast, slow}) {
    for (const PlateScheme scheme : {PlateScheme::literal, PlateScheme::defaults}) {
      runs.push_back({120, diffusivity, scheme, 1e-4});
    }
  }
  return runs;
}

ReportTable growing_table(const std::vector<GrowingRun>& runs, const std::vector<Solution>& solutions) {
  ReportTable table{"Largest difference to the temperatures of an independent prototype [°C]", {}};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].cells != 60) continue;
    const std::string_view lines =
        runs[k].diffusivity == fast ? values_2012::growing_probes : values_2012::slow_growing_probes;
    ReportTable part{"", {}};
    add_probe_rows(part, values_2012::growing_places, lines, runs[k].scheme == PlateScheme::defaults, solutions[k],
                   growing_limit);
    for (ReportRow& row : part.rows) {
      row.quantity = fmt::format("α = {} cm²/s, {}", runs[k].diffusivity, row.quantity);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

ReportTable jump_table(const std::vector<GrowingRun>& runs, const std::vector<Solution>& solutions) {
  ReportTable table{"Temperature above and below the crossing, (0, ±0.1) cm [°C]", {}};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    for (std::size_t time = 0; time < growing_times.size(); ++time) {
      for (const double side : {1.0, -1.0}) {
        const double value = solutions[k].at(time, {0.0, side * 0.1 * centimetre, 0.0});
        ReportRow row(fmt::format("α = {} cm²/s, n = {}, t = {} s, {}", runs[k].diffusivity, runs[k].cells,
                                  growing_times[time], side > 0.0 ? "above" : "below"),
                      {3, false});
        runs[k].scheme == PlateScheme::defaults ? row.defaults(value) : row.scheme(value);
        table.rows.push_back(row);
      }
    }
  }
  return table;
}

/// Largest change at the prototype's places: points beside a tip that has just passed are left out there as here.
ReportRow growing_time_row(const GrowingRun& run, const Solution& solution, const Solution& tighter) {
  const std::vector<Point> places = probe_places(values_2012::growing_places);
  double largest = 0.0;
  for (const ProbeLine& line : probe_lines(values_2012::growing_probes)) {
    if (!line.defaults) continue;
    const auto time = static_cast<std::size_t>(std::find(growing_times.begin(), growing_times.end(), line.time) -
                                               growing_times.begin());
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (std::isnan(line.values[k])) continue;
      largest = larger(largest, std::abs(solution.at(time, places[k]) - tighter.at(time, places[k])));
    }
  }
  ReportRow row("error in time: largest change at the prototype's places with a tenth of the tolerance, " +
                    growing_name(run) + " [°C]",
                {1, true});
  return row.below("change", largest, 0.5 * growing_limit);
}

}  // namespace

ReportSection growing_cracks_section(PaperRuns& runs) {
  const std::vector<GrowingRun> wanted = growing_runs(runs.quick());
  std::vector<PaperRun> all;
  for (const GrowingRun& run : wanted) {
    all.push_back({growing_plate(run.cells, run.diffusivity, run.scheme, run.tolerance), growing_times});
  }
  GrowingRun tighter = wanted.front();
  tighter.tolerance *= 0.1;
  all.push_back({growing_plate(tighter.cells, tighter.diffusivity, tighter.scheme, tighter.tolerance), growing_times});
  const std::vector<Solution> solutions = runs.solve(std::move(all));
  ReportSection section;
  section.blocks.push_back(ReportText{
      "The figure with the starting points was not at hand: the cracks run from (∓0.5, -0.496) to (±0.5, 0.504) cm, at "
      "0.2 cm/s "
      "from t = 0, and meet at (0, 0.004) cm at 3.54 s. A bond breaks when a tip passes it; between two steps its "
      "conductance is averaged over the step, so that results do not depend on the steps to first order."});
  section.blocks.push_back(growing_table(wanted, solutions));
  section.blocks.push_back(jump_table(wanted, solutions));
  const int shown = runs.quick() ? 60 : 120;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (wanted[k].cells != shown) continue;
    const Problem problem = growing_plate(shown, wanted[k].diffusivity, wanted[k].scheme, wanted[k].tolerance);
    for (std::size_t time = 0; time < growing_times.size(); ++time) {
      const std::string name = growing_name(wanted[k]);
      section.blocks.push_back(save_paper_field(
          {solutions[k], time, "2012, Fig. 22: " + name, -100.0, 100.0, &problem},
          fmt::format("2012_figure_22_{}_{}_{}s", wanted[k].diffusivity == fast ? "fast" : "slow",
                      wanted[k].scheme == PlateScheme::defaults ? "defaults" : "scheme", growing_times[time]),
          fmt::format("Fig. 22: {}, t = {} s.", name, growing_times[time]), runs));
    }
  }
  section.blocks.push_back(
      ReportTable{"Time integration", {growing_time_row(wanted.front(), solutions.front(), solutions.back())}});
  if (runs.quick()) {
    section.left_out =
        "δ = 13L/240, which the figure shows; both schemes at both diffusivities (one each is computed).";
  }
  return section;
}

}  // namespace peritherm
