#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "peritherm/papers/mei_2021_bars.hpp"
#include "peritherm/papers/mei_2021_reruns.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2021 = mei_2021_values;

constexpr double layered_step_2021 = 1e-4;  ///< of forward Euler [s]
constexpr double layered_time_2021 = 2.0;   ///< [s]

BarOf2021 layered_bar(double ratio, int cells, PartialVolumes rule, InterfaceRule interface) {
  BarOf2021 bar;
  bar.layered = true;
  bar.ratio = ratio;
  bar.cells = cells;
  bar.rule = rule;
  bar.interface = interface;
  bar.step = layered_step_2021;
  return bar;
}

/// Six runs of a rule and an interface.
struct LayeredCase {
  PartialVolumes rule;
  InterfaceRule interface;
  double recomputed;  ///< crossing at 5 cm; 0: unknown
  std::string name;
};

std::vector<LayeredCase> layered_cases() {
  constexpr InterfaceRule sided = InterfaceRule::sided_harmonic;
  return {{PartialVolumes::whole, sided, values_2021::crossing_whole.layered, "whole"},
          {PartialVolumes::half_normalised, sided, values_2021::crossing_half_normalised.layered, "half_normalised"},
          {PartialVolumes::cell_integrated, sided, values_2021::crossing_cell_integrated.layered, "cell_integrated"},
          {PartialVolumes::trapezoid, sided, values_2021::crossing_trapezoid.layered, "trapezoid"},
          {PartialVolumes::trapezoid, InterfaceRule::length_weighted_harmonic, 0.0, "trapezoid, in series"}};
}

std::vector<SixRuns> layered_crossings(PaperRuns& runs) {
  std::vector<SixRuns> studies;
  std::vector<PaperRun> all;
  for (const LayeredCase& one : layered_cases()) {
    SixRuns& six = studies.emplace_back();
    six.bar = layered_bar(2.0, 20, one.rule, one.interface);
    six.times = {layered_time_2021};
    for (PaperRun& run : six.runs()) all.push_back(std::move(run));
  }
  const std::vector<Solution> solutions = runs.solve(std::move(all));
  for (std::size_t k = 0; k < studies.size(); ++k) {
    studies[k].solutions.assign(solutions.begin() + static_cast<std::ptrdiff_t>(6 * k),
                                solutions.begin() + static_cast<std::ptrdiff_t>(6 * k + 6));
  }
  return studies;
}

ReportTable layered_classical_table(const TemperatureAt& classical) {
  ReportTable table{"The classical solution of the four segments [°C]", {}};
  for (const int time : {1, 2}) {
    for (std::size_t k = 0; k < values_2021::layered_places.size(); ++k) {
      table.rows.push_back(
          ReportRow(fmt::format("x = {} cm, t = {} s", values_2021::layered_places[k], time), {8, false})
              .recomputed(values_2021::layered_classical[time - 1][k])
              .exact(classical(place_in_bar(values_2021::layered_places[k]), time))
              .near(ValueKind::exact, ValueKind::recomputed, 1.1e-8));
    }
  }
  return table;
}

ReportPicture layered_classical_picture(const TemperatureAt& classical, const PaperRuns& runs) {
  Chart chart =
      make_paper_chart("2021, Fig. 11: classical solution of the heterogeneous bar", "x [cm]", "temperature [°C]");
  for (const double time : {1.0, 2.0, 4.0}) {
    Curve curve{fmt::format("{} s", time), {}, {}};
    for (int n = 0; n <= 400; ++n) {
      curve.x.push_back(n / 40.0);
      curve.y.push_back(classical(place_in_bar(n / 40.0), time));
    }
    chart.curves.push_back(std::move(curve));
  }
  return save_paper_chart(
      chart, "2021_figure_11",
      "Fig. 11: the classical solution; fast segments 0 to 2.5 and 3.75 to 7.5 cm, slow ones between and beyond.",
      runs);
}

ReportTable layered_crossing_table(const std::vector<SixRuns>& studies) {
  ReportTable table{"Crossing m of the curves of L/10 and L/20 at x = 5 cm, 2 s", {}};
  const std::vector<LayeredCase> cases = layered_cases();
  std::map<std::string, double> found;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    found[cases[k].name] = studies[k].crossing(0, 5.0).ratio;
    ReportRow row(cases[k].name, {4, false});
    row.published(values_2021::printed_layered_crossing, "section 5, Fig. 13").scheme(found[cases[k].name]);
    if (cases[k].recomputed > 0.0)
      row.recomputed(cases[k].recomputed).near(ValueKind::scheme, ValueKind::recomputed, 0.01);
    table.rows.push_back(row);
  }
  const double low = found["half_normalised"];
  const double high = found["trapezoid"];
  const double printed = values_2021::printed_layered_crossing;
  table.rows.push_back(
      ReportRow(fmt::format("the published 4.432: between {:.3f} (half_normalised) and {:.3f} (trapezoid)", low, high),
                {3, false})
          .published(printed, "section 5, Fig. 13")
          .below("outside by", outside_by(printed, low, high), 0.0));
  for (std::size_t k = 0; k < values_2021::layered_places.size(); ++k) {
    table.rows.push_back(
        ReportRow(fmt::format("trapezoid, in series, x = {} cm", values_2021::layered_places[k]), {4, false})
            .recomputed(values_2021::layered_series_crossing[k])
            .scheme(studies.back().crossing(0, values_2021::layered_places[k]).ratio)
            .near(ValueKind::scheme, ValueKind::recomputed, 0.01));
  }
  return table;
}

std::vector<ReportPicture> place_pictures(PaperRuns& runs, const TemperatureAt& classical) {
  constexpr std::array<int, 3> divisors{10, 20, 40};
  constexpr std::array<int, 3> ratios{2, 4, 8};
  std::vector<PaperRun> all;
  for (const int q : divisors) {
    for (const int ratio : ratios) {
      BarOf2021 bar = layered_bar(ratio, q * ratio, PartialVolumes::trapezoid, InterfaceRule::sided_harmonic);
      bar.step = 5e-5;
      all.push_back(run_of_2021(bar, {layered_time_2021}));
    }
  }
  const std::vector<Solution> solutions = runs.solve(std::move(all));
  std::vector<ReportPicture> pictures;
  for (const double x : values_2021::layered_places) {
    Chart chart = make_paper_chart(fmt::format("2021, Fig. 12: heterogeneous bar, x = {} cm, 2 s", x), "m = δ/Δx",
                                   "temperature [°C]");
    for (std::size_t h = 0; h < divisors.size(); ++h) {
      Curve curve{fmt::format("δ = L/{}", divisors[h]), {}, {}, CurveStyle::dots_on_line, static_cast<int>(h)};
      for (std::size_t k = 0; k < ratios.size(); ++k) {
        curve.x.push_back(ratios[k]);
        curve.y.push_back(solutions[3 * h + k].at(0, place_in_bar(x)));
      }
      chart.curves.push_back(std::move(curve));
    }
    const double exact = classical(place_in_bar(x), layered_time_2021);
    chart.curves.push_back({"classical", {2.0, 8.0}, {exact, exact}, CurveStyle::dashed, 3});
    pictures.push_back(
        save_paper_chart(chart, fmt::format("2021_figure_12_{}", x),
                         fmt::format("Fig. 12: m-convergence at x = {} cm, rule trapezoid. (The caption lists 3.125 cm "
                                     "in the fast material; it lies in the slow one.)",
                                     x),
                         runs));
  }
  return pictures;
}

ReportPicture layered_along_picture(const std::vector<SixRuns>& studies, const PaperRuns& runs) {
  Chart chart = make_paper_chart("2021, Fig. 13a: crossing m along the heterogeneous bar, 2 s", "x [cm]", "crossing m");
  const std::vector<LayeredCase> cases = layered_cases();
  for (const std::size_t k : {std::size_t{1}, std::size_t{3}, std::size_t{4}}) {
    Curve curve{cases[k].name, {}, {}};
    for (double x = 0.5; x < 9.51; x += 0.1) {
      const double ratio = studies[k].crossing(0, x).ratio;
      curve.x.push_back(x);
      curve.y.push_back(ratio < 8.0 ? ratio : std::nan(""));
    }
    chart.curves.push_back(std::move(curve));
  }
  chart.curves.push_back({"published at 5 cm", {5.0}, {values_2021::printed_layered_crossing}, CurveStyle::dots});
  return save_paper_chart(
      chart, "2021_figure_13a",
      "Fig. 13a: crossing m along the bar; with bonds as resistors in series the jumps at the interfaces vanish.",
      runs);
}

std::vector<JudgedBar> layered_bars() {
  constexpr InterfaceRule sided = InterfaceRule::sided_harmonic;
  constexpr double published = values_2021::printed_layered_crossing;
  return {{"m = 4.432, N = 160, whole", layered_bar(published, 160, PartialVolumes::whole, sided),
           values_2021::layered_rerun_whole},
          {"m = 4.432, N = 160, half_normalised", layered_bar(published, 160, PartialVolumes::half_normalised, sided),
           values_2021::layered_rerun_half_normalised},
          {"m = 4.432, N = 160, trapezoid", layered_bar(published, 160, PartialVolumes::trapezoid, sided),
           values_2021::layered_rerun_trapezoid},
          {"m = 3.367, N = 160, trapezoid, in series",
           layered_bar(values_2021::printed_crossing, 160, PartialVolumes::trapezoid,
                       InterfaceRule::length_weighted_harmonic),
           values_2021::layered_rerun_series},
          {"single run, δ = L/40, m = 16, whole", layered_bar(16.0, 640, PartialVolumes::whole, sided),
           values_2021::layered_single_whole},
          {"single run, δ = L/40, m = 16, trapezoid", layered_bar(16.0, 640, PartialVolumes::trapezoid, sided),
           values_2021::layered_single_trapezoid}};
}

void add_layered_rerun(ReportSection& section, PaperRuns& runs, const TemperatureAt& classical) {
  const JudgedBars judged = solve_judged_bars(layered_bars(), layered_time_2021, classical, runs);
  ReportTable table = table_of_errors("Errors at 2 s against the classical solution [°C]", judged);
  const double single = values_2021::layered_single_trapezoid.rms;
  const double rerun = values_2021::layered_rerun_trapezoid.rms;
  // Both of the prototype's numbers are known to two digits.
  const double limit = single / rerun * (6e-3 / single + 6e-3 / rerun);
  table.rows.push_back(ReportRow("single over rerun, rms, trapezoid", {2, false})
                           .recomputed(single / rerun)
                           .scheme(judged.errors[5].rms / judged.errors[2].rms)
                           .near(ValueKind::scheme, ValueKind::recomputed, limit));
  section.blocks.push_back(save_paper_chart(
      chart_of_errors("2021, Fig. 13b: difference to the classical solution, 2 s", judged, {2, 3, 5}),
      "2021_figure_13b",
      "Fig. 13b: the reruns and the single run against the classical solution, where the paper takes a finite "
      "element one that is up to 0.1 °C off.",
      runs));
  section.blocks.push_back(std::move(table));
}

}  // namespace

ReportSection layered_section_2021(PaperRuns& runs) {
  const TemperatureAt classical = classical_layered_bar_2021();
  const std::vector<SixRuns> studies = layered_crossings(runs);
  ReportSection section;
  section.blocks.push_back(
      ReportText{"Segments: fast 2.5 cm, slow 1.25 cm, fast 3.75 cm, slow 2.5 cm, diffusivities 10 and 1 cm²/s; bonds "
                 "between materials "
                 "conduct with the harmonic mean. With δ = L/10, m = 2 a node stands exactly on the interface at 3.75 "
                 "cm: here it takes its "
                 "partner's material, so that no bond begins on the interface. The published 4.432 lies between "
                 "half_normalised (4.378) and "
                 "trapezoid (4.922). The step of 1e-4 s is a part of the published scheme, so no row varies it."});
  section.blocks.push_back(layered_classical_picture(classical, runs));
  section.blocks.push_back(layered_classical_table(classical));
  for (ReportPicture& picture : place_pictures(runs, classical)) section.blocks.push_back(std::move(picture));
  section.blocks.push_back(layered_along_picture(studies, runs));
  section.blocks.push_back(layered_crossing_table(studies));
  add_layered_rerun(section, runs, classical);
  return section;
}

}  // namespace peritherm
