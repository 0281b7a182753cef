#include <fmt/format.h>

#include <cmath>

#include "peritherm/papers/bobaru_2012_plates.hpp"
#include "peritherm/papers/bobaru_2012_sections.hpp"
#include "peritherm/papers/bobaru_2012_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2012 = bobaru_2012_values;

constexpr double probe_limit = 2e-3;      ///< of what the prototype's time integration and rounding leave [°C]
constexpr double crack_tolerance = 3e-7;  ///< relative error in time of standing cracks

std::string scheme_word(PlateScheme scheme) {
  return scheme == PlateScheme::defaults ? "defaults" : "published scheme";
}

Problem slit_plate(int cells, PlateScheme scheme) {
  Problem problem = cracked_plate(cells, 1.14, scheme);
  // On y = 0 itself stands a row of points: which side it belongs to would be left to rounding.
  add_paper_crack(problem, {-0.500001, 1e-6}, {0.500001, 1e-6});
  return with_time_error(std::move(problem), crack_tolerance);
}

Problem inclined_plate(int cells, PlateScheme scheme) {
  Problem problem = cracked_plate(cells, 1.14, scheme);
  constexpr double low = -0.25480762113533156;
  constexpr double high = 0.26480762113533157;
  add_paper_crack(problem, {-0.655, low}, {-0.355, high});
  add_paper_crack(problem, {0.655, low}, {0.355, high});
  return with_time_error(std::move(problem), crack_tolerance);
}

/// Runs of one cracked plate: both schemes by number of cells.
struct CrackStudy {
  std::vector<int> cells;
  std::vector<double> times;
  std::vector<Solution> scheme;
  std::vector<Solution> defaults;

  template <class MakePlate>
  CrackStudy(std::vector<int> sizes, std::vector<double> at, const MakePlate& make, PaperRuns& runs)
      : cells(std::move(sizes)), times(std::move(at)) {
    std::vector<PaperRun> all;
    for (const int n : cells) all.push_back({make(n, PlateScheme::literal), times});
    for (const int n : cells) all.push_back({make(n, PlateScheme::defaults), times});
    std::vector<Solution> solutions = runs.solve(std::move(all));
    const auto half = solutions.begin() + static_cast<std::ptrdiff_t>(cells.size());
    scheme.assign(std::make_move_iterator(solutions.begin()), std::make_move_iterator(half));
    defaults.assign(std::make_move_iterator(half), std::make_move_iterator(solutions.end()));
  }
  std::size_t last() const { return times.size() - 1; }
};

template <class MakePlate>
ReportTable crack_time_table(const CrackStudy& study, const MakePlate& make, double limit, PaperRuns& runs) {
  const int cells = study.cells.front();
  const std::vector<Solution> tighter =
      runs.solve({with_tolerance({make(cells, PlateScheme::literal), study.times}, 0.1 * crack_tolerance),
                  with_tolerance({make(cells, PlateScheme::defaults), study.times}, 0.1 * crack_tolerance)});
  return {"Time integration",
          {time_error_row(fmt::format("published scheme, n = {} [°C]", cells), study.scheme[0], tighter[0], limit),
           time_error_row(fmt::format("defaults, n = {} [°C]", cells), study.defaults[0], tighter[1], limit)}};
}

ReportTable prototype_table(const CrackStudy& study, std::string_view places, std::string_view lines) {
  ReportTable table{"Largest difference to the temperatures of an independent prototype [°C]", {}};
  for (std::size_t k = 0; k < study.cells.size(); ++k) {
    add_probe_rows(table, places, lines, false, study.scheme[k], probe_limit);
    add_probe_rows(table, places, lines, true, study.defaults[k], probe_limit);
  }
  return table;
}

ReportTable steady_table(const CrackStudy& study) {
  const TemperatureAt exact = make_temperature(SlitInSquare{0.02, 0.01, -100.0, 100.0});
  ReportTable table{fmt::format("Steady state (t = {} s), exact by conformal mapping", study.times.back()), {}};
  for (std::size_t k = 0; k < study.cells.size(); ++k) {
    for (const std::string_view place : {"0,0.1", "0,0.25", "0,0.5", "1,0.5"}) {
      const Point at = probe_places(place).front();
      table.rows.push_back(ReportRow(fmt::format("({}) cm, δ = 13L/{}", place, 2 * study.cells[k]), {4, false})
                               .scheme(study.scheme[k].at(study.last(), at))
                               .defaults(study.defaults[k].at(study.last(), at))
                               .exact(exact(at, 0.0)));
    }
  }
  return table;
}

ReportTable transient_table(const CrackStudy& study, std::size_t time) {
  ReportTable table{"Transient at 0.5 s beside the classical one (graded finite elements, to about 1e-3)", {}};
  const std::vector<Point> at = probe_places(values_2012::crack_classical_places);
  const std::size_t k = study.cells.size() - 1;
  for (std::size_t n = 0; n < at.size(); ++n) {
    table.rows.push_back(ReportRow(fmt::format("({:g}, {:g}) cm, δ = 13L/{}", at[n][0] / centimetre,
                                               at[n][1] / centimetre, 2 * study.cells[k]),
                                   {4, false})
                             .scheme(study.scheme[k].at(time, at[n]))
                             .defaults(study.defaults[k].at(time, at[n]))
                             .exact(values_2012::crack_classical[n]));
  }
  table.rows.push_back(ReportRow("upper face of the crack, middle: 0.5 s (recomputed) and steady (exact)", {4, false})
                           .recomputed(values_2012::crack_face_transient)
                           .exact(values_2012::crack_face_steady));
  return table;
}

void add_pictures(ReportSection& section, const CrackStudy& study, std::size_t time, const Problem& problem,
                  const std::string& stem, const std::string& title, const PaperRuns& runs) {
  for (std::size_t k = 0; k < study.cells.size(); ++k) {
    for (const PlateScheme scheme : {PlateScheme::literal, PlateScheme::defaults}) {
      const bool own = scheme == PlateScheme::defaults;
      const Solution& solution = own ? study.defaults[k] : study.scheme[k];
      const std::string which = fmt::format("{}, δ = 13L/{}", scheme_word(scheme), 2 * study.cells[k]);
      section.blocks.push_back(
          save_paper_field({solution, time, title + ", " + which, -100.0, 100.0, &problem},
                           fmt::format("{}_{}_{}", stem, study.cells[k], own ? "defaults" : "scheme"),
                           fmt::format("{}: {}, t = {} s.", title, which, solution.times[time]), runs));
    }
  }
}

}  // namespace

ReportSection insulated_crack_section(PaperRuns& runs) {
  const std::vector<int> cells = runs.quick() ? std::vector<int>{60} : std::vector<int>{60, 120, 240};
  const CrackStudy study(cells, {0.05, 0.1, 0.5, 3.0}, slit_plate, runs);
  ReportSection section;
  section.blocks.push_back(
      ReportText{"L = 2 cm, m = 6.5: δ = 13L/240 has 120 cells, δ = 13L/480 has 240; 60 cells are added for "
                 "convergence. A crack drawn "
                 "on y = 0 itself lies on a row of points, where the strict test of section 3.4 cuts no bond to that "
                 "row and the crack "
                 "leaks (an independent prototype: 11.4 °C instead of 47.1 °C at (0, 0.1)); it is drawn at y = 1e-6 "
                 "cm. The paper calls "
                 "0.5 s steady; the classical solution is at 43.16 °C in the middle of the upper face then and goes to "
                 "45.85 °C."});
  section.blocks.push_back(prototype_table(study, values_2012::crack_places, values_2012::crack_probes));
  section.blocks.push_back(steady_table(study));
  section.blocks.push_back(transient_table(study, 2));
  section.blocks.push_back(ReportText{
      "Both schemes approach the exact steady state with about first order in δ: no scheme here corrects the points "
      "beside a crack for the bonds that it cuts."});
  add_pictures(section, study, 2, slit_plate(60, PlateScheme::defaults), "2012_figure_18", "2012, Fig. 18", runs);
  section.blocks.push_back(crack_time_table(study, slit_plate, 1e-3, runs));
  if (runs.quick()) section.left_out = "δ = 13L/240 and 13L/480, which the figure shows.";
  return section;
}

ReportSection inclined_cracks_section(PaperRuns& runs) {
  const std::vector<int> cells = runs.quick() ? std::vector<int>{60} : std::vector<int>{60, 120};
  const CrackStudy study(cells, {0.1, 0.5, 4.5}, inclined_plate, runs);
  ReportSection section;
  section.blocks.push_back(ReportText{
      "Fig. 19 with the geometry was not at hand: half-length 0.3 cm, 60°, centres (∓0.505, 0.005) cm were chosen. "
      "The paper compares contour plots with those of two earlier papers by eye; here the temperatures are compared "
      "with an "
      "independent prototype of both schemes."});
  section.blocks.push_back(prototype_table(study, values_2012::inclined_places, values_2012::inclined_probes));
  add_pictures(section, study, 2, inclined_plate(60, PlateScheme::defaults), "2012_figure_20", "2012, Fig. 20", runs);
  section.blocks.push_back(crack_time_table(study, inclined_plate, 1e-3, runs));
  if (runs.quick()) section.left_out = "δ = 13L/240.";
  return section;
}

}  // namespace peritherm
