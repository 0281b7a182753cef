#include <fmt/format.h>

#include <cmath>

#include "peritherm/base/larger.hpp"
#include "peritherm/papers/bobaru_2012_plates.hpp"
#include "peritherm/papers/bobaru_2012_sections.hpp"
#include "peritherm/papers/bobaru_2012_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2012 = bobaru_2012_values;

constexpr double probe_limit = 2e-3;      ///< of what the prototype's time integration and rounding leave [°C]
constexpr double crack_tolerance = 3e-7;  ///< relative error in time of standing cracks

constexpr std::string_view steady_places = "0,0.1 0,0.25 0,0.5 1,0.5";

/// Classical temperature of example 3, steady.
TemperatureAt classical_slit() { return make_temperature(SlitInSquare{0.02, 0.01, -100.0, 100.0}); }

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
ReportTable crack_time_table(const CrackStudy& study, const MakePlate& make, PaperRuns& runs) {
  const int cells = study.cells.front();
  const std::vector<Solution> tighter =
      runs.solve({with_tolerance({make(cells, PlateScheme::literal), study.times}, 0.1 * crack_tolerance),
                  with_tolerance({make(cells, PlateScheme::defaults), study.times}, 0.1 * crack_tolerance)});
  const double limit = 0.5 * probe_limit;
  return {"Time integration (judged by half of what the prototype's rows are)",
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

/// How fast the largest of the steady differences falls between the two finest horizons.
ReportRow steady_order_row(const CrackStudy& study, const TemperatureAt& exact) {
  const std::size_t fine = study.cells.size() - 1;
  const auto largest = [&](const Solution& solution) {
    double difference = 0.0;
    for (const Point& at : probe_places(steady_places)) {
      difference = larger(difference, std::abs(solution.at(study.last(), at) - exact(at, 0.0)));
    }
    return difference;
  };
  const auto order = [&](const std::vector<Solution>& solutions) {
    return convergence_rate(1.0 / study.cells[fine - 1], largest(solutions[fine - 1]), 1.0 / study.cells[fine],
                            largest(solutions[fine]));
  };
  return ReportRow(fmt::format("order of the largest of these differences between δ = 13L/{} and 13L/{}",
                               2 * study.cells[fine - 1], 2 * study.cells[fine]),
                   {2, false})
      .scheme(order(study.scheme))
      .defaults(order(study.defaults));
}

ReportTable steady_table(const CrackStudy& study) {
  const TemperatureAt exact = classical_slit();
  ReportTable table{fmt::format("Steady state (t = {} s), exact by conformal mapping", study.times.back()), {}};
  for (std::size_t k = 0; k < study.cells.size(); ++k) {
    for (const Point& at : probe_places(steady_places)) {
      table.rows.push_back(ReportRow(fmt::format("({:g}, {:g}) cm, δ = 13L/{}", at[0] / centimetre, at[1] / centimetre,
                                                 2 * study.cells[k]),
                                     {4, false})
                               .scheme(study.scheme[k].at(study.last(), at))
                               .defaults(study.defaults[k].at(study.last(), at))
                               .exact(exact(at, 0.0)));
    }
  }
  if (study.cells.size() > 1) table.rows.push_back(steady_order_row(study, exact));
  return table;
}

ReportTable transient_table(const CrackStudy& study, std::size_t time) {
  ReportTable table{
      "Transient at 0.5 s; recomputed elsewhere: the classical one, graded finite elements, to about 1e-3", {}};
  const std::vector<Point> at = probe_places(values_2012::crack_classical_places);
  const std::size_t k = study.cells.size() - 1;
  for (std::size_t n = 0; n < at.size(); ++n) {
    table.rows.push_back(ReportRow(fmt::format("({:g}, {:g}) cm, δ = 13L/{}", at[n][0] / centimetre,
                                               at[n][1] / centimetre, 2 * study.cells[k]),
                                   {4, false})
                             .scheme(study.scheme[k].at(time, at[n]))
                             .defaults(study.defaults[k].at(time, at[n]))
                             .recomputed(values_2012::crack_classical[n]));
  }
  table.rows.push_back(ReportRow("middle of the crack's upper face, classical", {4, false})
                           .recomputed(values_2012::crack_face_transient));
  table.rows.push_back(ReportRow("the same, steady", {8, false})
                           .recomputed(values_2012::crack_face_steady)
                           .exact(classical_slit()({0.0, 0.0, 0.0}, 0.0))
                           .near(ValueKind::exact, ValueKind::recomputed, 5.1e-9));
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

/// The closed form on the points of the coarsest plate, whose row on y = 0 lies below the crack.
ReportPicture classical_slit_picture(const CrackStudy& study, const PaperRuns& runs) {
  const TemperatureAt exact = classical_slit();
  Solution classical = study.defaults.front();
  std::vector<double>& temperatures = classical.temperatures[study.last()];
  for (int j = 0; j < classical.grid.count(1); ++j) {
    for (int i = 0; i < classical.grid.count(0); ++i) {
      Point place = classical.grid.position({i, j, 0});
      if (std::abs(place[1]) < 1e-9) place[1] = -1e-9;
      temperatures[classical.grid.number({i, j, 0})] = exact(place, 0.0);
    }
  }
  const Problem problem = slit_plate(study.cells.front(), PlateScheme::defaults);
  return save_paper_field(
      {classical, study.last(), "2012, Fig. 17: classical solution, steady", -100.0, 100.0, &problem}, "2012_figure_17",
      "Fig. 17: the classical solution by conformal mapping, in its steady state (the paper's finite element solution "
      "is at 0.5 s, which it calls steady).",
      runs);
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
      "No scheme here corrects the points beside a crack for the bonds that it cuts. The order in δ that is left "
      "stands below the steady temperatures where two horizons or more are computed."});
  section.blocks.push_back(classical_slit_picture(study, runs));
  add_pictures(section, study, 2, slit_plate(60, PlateScheme::defaults), "2012_figure_18", "2012, Fig. 18", runs);
  section.blocks.push_back(crack_time_table(study, slit_plate, runs));
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
      "independent prototype of both schemes. The classical half of Fig. 19 is missing: no closed form is at hand."});
  section.blocks.push_back(prototype_table(study, values_2012::inclined_places, values_2012::inclined_probes));
  add_pictures(section, study, 2, inclined_plate(60, PlateScheme::defaults), "2012_figure_20", "2012, Fig. 20", runs);
  section.blocks.push_back(crack_time_table(study, inclined_plate, runs));
  if (runs.quick()) section.left_out = "δ = 13L/240.";
  return section;
}

}  // namespace peritherm
