#include <fmt/format.h>

#include <cmath>
#include <map>

#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/papers/bobaru_2012_plates.hpp"
#include "peritherm/papers/bobaru_2012_sections.hpp"
#include "peritherm/papers/bobaru_2012_values.hpp"
#include "peritherm/papers/paper.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2012 = bobaru_2012_values;

constexpr double middle_row = 0.5 * centimetre;
/// Half of the last digit of the prototype's relative differences, and as much for the integration of both in time.
constexpr double square_row_limit = 1e-5;
constexpr double convergence_time_2012 = 0.025;  ///< of example 1 [s]
const std::vector<double> profile_times_2012{0.01, 0.025, 0.05, 0.1};

std::vector<double> horizons_of_2012(std::size_t count) {
  std::vector<double> horizons;
  for (std::size_t h = 0; h < count; ++h) horizons.push_back(13.0 / (120 << h));
  return horizons;
}

std::string horizon_name(std::size_t h) { return fmt::format("δ = 13L/{}", 120 << h); }

/// Runs of example 1: published scheme by cells at the coarsest horizon and refinement, defaults with m = 6.5.
struct SquareStudy {
  std::vector<int> coarse_cells;  ///< 120 m/13
  std::size_t horizons = 3;
  std::map<std::pair<int, std::size_t>, Solution> scheme;
  std::vector<Solution> defaults;
  TemperatureAt classical = make_temperature(classical_square(1));

  explicit SquareStudy(PaperRuns& runs)
      : coarse_cells(runs.quick() ? std::vector<int>{48, 60} : std::vector<int>{24, 36, 48, 60, 64, 96}),
        horizons(runs.quick() ? 2 : 3) {
    std::vector<PaperRun> all;
    for (const int cells : coarse_cells) {
      for (std::size_t h = 0; h < horizons; ++h) {
        all.push_back(square_run({1, cells, 1 << h, PlateScheme::literal}, times(cells, h)));
      }
    }
    for (std::size_t h = 0; h < 3; ++h) {
      all.push_back(square_run({1, 60, 1 << h, PlateScheme::defaults}, times(64, h)));
    }
    std::vector<Solution> solutions = runs.solve(std::move(all));
    auto next = solutions.begin();
    for (const int cells : coarse_cells) {
      for (std::size_t h = 0; h < horizons; ++h) scheme[{cells, h}] = std::move(*next++);
    }
    defaults.assign(std::make_move_iterator(next), std::make_move_iterator(solutions.end()));
  }

  static std::vector<double> times(int cells, std::size_t h) {
    return cells == 64 && h == 2 ? profile_times_2012 : std::vector<double>{convergence_time_2012};
  }
  double difference(const Solution& solution) const {
    const std::size_t time = solution.times.size() > 1 ? 1 : 0;
    return measure(StudyNorm::relative_l2, compare_row(solution, time, middle_row, classical));
  }
};

ReportTable square_rate_table(const SquareStudy& study) {
  ReportTable table{"Fig. 12: relative differences at 0.025 s on y = 0.5, and their rates", {}};
  for (const auto& rate : values_2012::square_rates) {
    if (!study.scheme.contains({rate.cells, 0})) continue;
    std::vector<double> differences;
    for (std::size_t h = 0; h < study.horizons; ++h) {
      differences.push_back(study.difference(study.scheme.at({rate.cells, h})));
      table.rows.push_back(ReportRow(fmt::format("m = {}, {}", rate.ratio, horizon_name(h)), {5, false})
                               .recomputed(rate.differences[h])
                               .scheme(differences.back())
                               .near(ValueKind::scheme, ValueKind::recomputed, square_row_limit));
    }
    if (study.horizons < 3) continue;
    table.rows.push_back(ReportRow(fmt::format("m = {}, rate", rate.ratio), {3, false})
                             .published(rate.printed, "Fig. 12, caption")
                             .recomputed(rate.recomputed)
                             .scheme(fitted_rate(horizons_of_2012(3), differences))
                             .near(ValueKind::scheme, ValueKind::published, 0.02));
  }
  return table;
}

ReportTable square_default_table(const SquareStudy& study) {
  ReportTable table{"Defaults, m = 6.5: relative differences at 0.025 s on y = 0.5", {}};
  std::vector<double> differences;
  for (std::size_t h = 0; h < study.defaults.size(); ++h) {
    differences.push_back(study.difference(study.defaults[h]));
    ReportRow row(horizon_name(h), {6, false});
    if (h < study.horizons) row.scheme(study.difference(study.scheme.at({60, h})));
    row.defaults(differences.back()).below("defaults", differences.back(), values_2012::square_default_limits[h]);
    table.rows.push_back(row);
  }
  const double order = fitted_rate(horizons_of_2012(3), differences);
  table.rows.push_back(ReportRow("order", {3, false}).defaults(order).below("|order - 2|", std::abs(order - 2.0), 0.1));
  return table;
}

/// What a linear field feels of the conductivity, deep inside, by the stencil of the published scheme.
ReportTable square_conductivity_table() {
  ReportTable table{"Effective conductivity of the published scheme over that of the plate", {}};
  for (const auto& rate : values_2012::square_rates) {
    StencilOptions options;
    options.horizon = ratio_of_2012(rate.cells);
    options.calibration = Calibration::continuum;
    options.self_term = SelfTerm::bobaru_2012;
    const double found = effective_conductivity(make_stencil(options, 1.0, 2), 1.0, 2);
    options.self_term = SelfTerm::none;
    const double none = effective_conductivity(make_stencil(options, 1.0, 2), 1.0, 2);
    table.rows.push_back(ReportRow(fmt::format("m = {}", rate.ratio), {4, false})
                             .recomputed(rate.conductivity)
                             .scheme(found)
                             .near(ValueKind::scheme, ValueKind::recomputed, 5.1e-5));
    table.rows.push_back(ReportRow(fmt::format("m = {}, without the p = i term", rate.ratio), {4, false}).scheme(none));
  }
  return table;
}

ReportPicture square_profile_picture(const SquareStudy& study, const PaperRuns& runs) {
  Chart chart = make_paper_chart("2012, Fig. 9: example 1 on y = 0.5", "x [cm]", "temperature [°C]");
  const Solution& defaults = study.defaults.back();
  for (std::size_t time = 0; time < profile_times_2012.size(); ++time) {
    const std::string when = fmt::format("{} s", profile_times_2012[time]);
    const ComparedPoints points = compare_row(defaults, time, middle_row, study.classical);
    const int colour = static_cast<int>(time);
    chart.curves.push_back({"classical, " + when, points.x, points.classical, CurveStyle::line, colour});
    if (study.scheme.contains({64, 2})) {
      const ComparedPoints scheme = compare_row(study.scheme.at({64, 2}), time, middle_row, study.classical);
      chart.curves.push_back({"scheme, " + when, scheme.x, scheme.computed, CurveStyle::dashed, colour});
    }
    Curve dots{"defaults, " + when, {}, {}, CurveStyle::dots, colour};
    for (std::size_t n = 0; n < points.x.size(); n += 12) {
      dots.x.push_back(points.x[n]);
      dots.y.push_back(points.computed[n]);
    }
    chart.curves.push_back(std::move(dots));
  }
  return save_paper_chart(
      chart, "2012_figure_09",
      "Fig. 9: temperatures on y = 0.5; published scheme with δ = 13L/480, m = 6.933 (256 cells), defaults "
      "with δ = 13L/480, m = 6.5 (240 cells).",
      runs);
}

ReportPicture square_flux_picture(const SquareStudy& study, const PaperRuns& runs) {
  Chart chart =
      make_paper_chart("2012, Fig. 10: heat flux on y = 0.5 at 0.05 s", "x [cm]", "heat flux along x [W/cm²]");
  constexpr std::size_t time = 2;
  const ExactSolution exact = classical_square(1);
  Curve line{"classical", {}, {}, CurveStyle::line, 0};
  for (int n = 0; n <= 200; ++n) {
    const double x = n / 200.0 * centimetre;
    line.x.push_back(x / centimetre);
    line.y.push_back(-114.0 * gradient_along_x(exact, {x, middle_row, 0.0}, profile_times_2012[time]) * 1e-4);
  }
  chart.curves.push_back(std::move(line));
  const auto add = [&](const std::string& name, const PaperRun& run, const Solution& solution, int colour) {
    const std::vector<Point> flux = flux_of_solution(run.problem, solution, time);
    const int middle = solution.grid.cells[1] / 2;
    Curve dots{name, {}, {}, CurveStyle::dots, colour};
    for (int i = 0; i < solution.grid.count(0); i += 6) {
      const GridIndex p{i, middle, 0};
      dots.x.push_back(solution.grid.position(p)[0] / centimetre);
      dots.y.push_back(flux[solution.grid.number(p)][0] * 1e-4);
    }
    chart.curves.push_back(std::move(dots));
  };
  if (study.scheme.contains({64, 2})) {
    add("published scheme", square_run({1, 64, 4, PlateScheme::literal}, {}), study.scheme.at({64, 2}), 1);
  }
  add("defaults", square_run({1, 60, 4, PlateScheme::defaults}, {}), study.defaults.back(), 2);
  return save_paper_chart(
      chart, "2012_figure_10",
      "Fig. 10: heat flux along x, from the bonds to hotter points (eq. 7), and of the classical solution.", runs);
}

ReportPicture square_m_picture(const SquareStudy& study, const PaperRuns& runs) {
  Chart chart = make_paper_chart("2012, Fig. 11: example 1 at 0.025 s", "m = δ/Δx", "relative difference");
  for (std::size_t h = 0; h < study.horizons; ++h) {
    Curve curve{horizon_name(h), {}, {}, CurveStyle::dots_on_line, static_cast<int>(h)};
    for (const int cells : study.coarse_cells) {
      curve.x.push_back(ratio_of_2012(cells));
      curve.y.push_back(study.difference(study.scheme.at({cells, h})));
    }
    chart.curves.push_back(std::move(curve));
  }
  return save_paper_chart(
      chart, "2012_figure_11",
      "Fig. 11: relative difference over m for three horizons, published scheme. The text names m = 5.2, 6.5, "
      "6.933 and 10.4 only; the smaller ones (2.6, 3.9) are chosen here.",
      runs);
}

ReportPicture square_rate_picture(const SquareStudy& study, const PaperRuns& runs) {
  Chart chart = make_paper_chart("2012, Fig. 12: example 1 at 0.025 s", "δ/L", "relative difference", true);
  for (const auto& rate : values_2012::square_rates) {
    if (!study.scheme.contains({rate.cells, 0})) continue;
    Curve curve{
        fmt::format("scheme, m = {}", rate.ratio), horizons_of_2012(study.horizons), {}, CurveStyle::dots_on_line};
    for (std::size_t h = 0; h < study.horizons; ++h) {
      curve.y.push_back(study.difference(study.scheme.at({rate.cells, h})));
    }
    chart.curves.push_back(std::move(curve));
  }
  Curve curve{"defaults, m = 6.5", horizons_of_2012(3), {}, CurveStyle::dots_on_line};
  for (const Solution& solution : study.defaults) curve.y.push_back(study.difference(solution));
  chart.curves.push_back(std::move(curve));
  return save_paper_chart(
      chart, "2012_figure_12",
      "Fig. 12: δ-convergence of example 1. The published scheme heads for the floor that its effective "
      "diffusivity leaves (+6.6 % at m = 6.5); the defaults have order 2.",
      runs);
}

ReportTable square_time_table(const SquareStudy& study, PaperRuns& runs) {
  const Solution scheme =
      runs.solve(with_tolerance(square_run({1, 60, 1, PlateScheme::literal}, {convergence_time_2012}), 1e-8));
  const Solution defaults =
      runs.solve(with_tolerance(square_run({1, 60, 1, PlateScheme::defaults}, {convergence_time_2012}), 1e-8));
  const auto row = [&](const std::string& name, const Solution& run, const Solution& tighter) {
    return difference_change_row(name, std::abs(study.difference(run) - study.difference(tighter)),
                                 0.1 * square_row_limit);
  };
  return {"Time integration (judged by a tenth of what the rows of Fig. 12 are)",
          {row("published scheme, δ = 13L/120, m = 6.5", study.scheme.at({60, 0}), scheme),
           row("defaults, δ = 13L/120, m = 6.5", study.defaults[0], defaults)}};
}

ReportSection held_square_section(PaperRuns& runs) {
  const SquareStudy study(runs);
  ReportSection section;
  section.blocks.push_back(
      ReportText{"Published scheme: points on the boundary with half and quarter areas there, Algorithm 1, the p = i "
                 "term as the mean over "
                 "eight neighbours with s = r/2 at which k is evaluated too, sides held on one row. The term counts a "
                 "point's own cell four "
                 "times too much, so that a plate conducts 6.6 % too well at m = 6.5; with it the scheme does not "
                 "converge to the classical "
                 "solution at fixed m, and the printed rates are those of a boundary error on its way to that floor."});
  section.blocks.push_back(square_profile_picture(study, runs));
  section.blocks.push_back(square_flux_picture(study, runs));
  section.blocks.push_back(square_m_picture(study, runs));
  section.blocks.push_back(square_rate_picture(study, runs));
  section.blocks.push_back(square_rate_table(study));
  section.blocks.push_back(square_conductivity_table());
  section.blocks.push_back(square_default_table(study));
  section.blocks.push_back(square_time_table(study, runs));
  if (runs.quick()) {
    section.left_out =
        "the published scheme at δ = 13L/480, and with it its four rates and its curves in Figs. 9 and 10; m = 2.6, "
        "3.9, 6.933 "
        "and 10.4.";
  }
  return section;
}

}  // namespace

Paper bobaru_2012() {
  return {"bobaru_2012",
          "Bobaru and Duangpanya 2012",
          "F. Bobaru, M. Duangpanya: A peridynamic formulation for transient heat conduction in bodies with evolving "
          "discontinuities. Journal of Computational Physics 231 (2012) 2764–2785.",
          {{"Example 1: plate with held sides", held_square_section},
           {"Example 2: plate held on one side", heated_square_section},
           {"Example 3: one insulated crack", insulated_crack_section},
           {"Example 4: two inclined cracks", inclined_cracks_section},
           {"Example 5: growing, crossing cracks", growing_cracks_section},
           {"Example 6: fibre composite", fibre_composite_section}}};
}

}  // namespace peritherm
