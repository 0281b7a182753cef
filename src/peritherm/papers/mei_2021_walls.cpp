#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "peritherm/papers/mei_2021_bars.hpp"
#include "peritherm/papers/mei_2021_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2021 = mei_2021_values;

constexpr std::array<Imposed, 3> walls_2021{Imposed::mirror, Imposed::constant, Imposed::row};
constexpr std::array<std::string_view, 3> wall_names_2021{"mirror", "naive", "inner"};
constexpr std::array<int, 3> divisors_2021{10, 20, 40};
constexpr std::array<int, 4> ratios_2021{2, 4, 8, 16};
const std::vector<double> wall_times_2021{0.1, 0.3, 0.42, 0.5};
constexpr std::size_t last_wall_time = 3;
constexpr double euler_step_2021 = 5e-5;  ///< [s], section 3

/// Runs by wall, horizon and m with the paper's time step; `whole` as the paper's one-point quadrature.
struct WallStudy {
  std::map<std::array<int, 3>, Solution> solutions;
  TemperatureAt classical = classical_bar_2021();

  explicit WallStudy(PaperRuns& runs) {
    std::vector<PaperRun> all;
    std::vector<std::array<int, 3>> keys;
    for (int wall = 0; wall < 3; ++wall) {
      for (const int q : divisors_2021) {
        for (const int ratio : ratios_2021) {
          BarOf2021 bar = bar_of_2021(q, ratio, walls_2021[static_cast<std::size_t>(wall)]);
          bar.step = euler_step_2021;
          all.push_back(run_of_2021(bar, wall_times_2021));
          keys.push_back({wall, q, ratio});
        }
      }
    }
    std::vector<Solution> computed = runs.solve(std::move(all));
    for (std::size_t k = 0; k < keys.size(); ++k) solutions[keys[k]] = std::move(computed[k]);
  }
  double at(int wall, int q, int ratio, std::size_t time, double x) const {
    return solutions.at({wall, q, ratio}).at(time, place_in_bar(x));
  }
};

double nonlocal_at(double x, double time, double horizon_cm) {
  return temperature(NonlocalHeldEnds{0.1, 1e-3, horizon_cm * centimetre, 100.0, 0.0}, place_in_bar(x), time);
}

ReportTable wall_table(const WallStudy& study, const std::map<std::array<int, 2>, Solution>& defaults) {
  ReportTable table{"Temperature at x = 5 cm, t = 0.5 s (Fig. 6), rule whole, forward Euler with 5e-5 s [°C]", {}};
  const double exact = study.classical(place_in_bar(5.0), 0.5);
  for (int wall = 0; wall < 3; ++wall) {
    for (std::size_t h = 0; h < 3; ++h) {
      for (std::size_t k = 0; k < 4; ++k) {
        const int q = divisors_2021[h];
        const int ratio = ratios_2021[k];
        ReportRow row(fmt::format("{}, δ = L/{}, m = {}", wall_names_2021[static_cast<std::size_t>(wall)], q, ratio),
                      {5, false});
        row.recomputed(values_2021::wall_values[wall][h][k])
            .scheme(study.at(wall, q, ratio, last_wall_time, 5.0))
            .exact(exact)
            // The prototype's last digit; its Euler steps are evaluated exactly, ours are taken.
            .near(ValueKind::scheme, ValueKind::recomputed, 6e-6);
        if (wall == 0) row.defaults(defaults.at({q, ratio}).at(0, place_in_bar(5.0)));
        table.rows.push_back(row);
      }
    }
  }
  return table;
}

Chart m_chart_2021(const std::string& title, const std::string& y) {
  Chart chart = make_paper_chart(title, "m = δ/Δx", y);
  chart.x.scale = AxisScale::logarithmic;
  return chart;
}

void add_horizon_curves(Chart& chart, const std::function<double(int q, int ratio)>& value) {
  int colour = 0;
  for (const int q : divisors_2021) {
    Curve curve{fmt::format("δ = L/{}", q), {}, {}, CurveStyle::dots_on_line, colour++};
    for (const int ratio : ratios_2021) {
      curve.x.push_back(ratio);
      curve.y.push_back(value(q, ratio));
    }
    chart.curves.push_back(std::move(curve));
  }
}

void add_level(Chart& chart, const std::string& name, double value, int colour, double last = 16.0) {
  chart.curves.push_back({name, {2.0, last}, {value, value}, CurveStyle::dashed, colour});
}

ReportPicture difference_picture(const WallStudy& study, std::size_t time, const PaperRuns& runs) {
  const double when = wall_times_2021[time];
  const double exact = study.classical(place_in_bar(5.0), when);
  Chart chart = m_chart_2021(fmt::format("2021, Fig. 5: mirror, x = 5 cm, t = {} s", when), "relative difference");
  add_horizon_curves(chart, [&](int q, int ratio) { return study.at(0, q, ratio, time, 5.0) / exact - 1.0; });
  for (int h = 0; h < 3; ++h) {
    add_level(chart, h == 0 ? "nonlocal solution" : "",
              nonlocal_at(5.0, when, 10.0 / divisors_2021[static_cast<std::size_t>(h)]) / exact - 1.0, h);
  }
  return save_paper_chart(
      chart, fmt::format("2021_figure_05_{}s", when),
      fmt::format("Fig. 5: relative difference to the classical value with mirrored ends, t = {} s; dashed: "
                  "the nonlocal solution of the same horizon.",
                  when),
      runs);
}

ReportPicture wall_picture(const WallStudy& study, int wall, const PaperRuns& runs) {
  const std::string name(wall_names_2021[static_cast<std::size_t>(wall)]);
  Chart chart = m_chart_2021("2021, Fig. 6: " + name + ", x = 5 cm, t = 0.5 s", "temperature [°C]");
  add_horizon_curves(chart, [&](int q, int ratio) { return study.at(wall, q, ratio, last_wall_time, 5.0); });
  add_level(chart, "classical", study.classical(place_in_bar(5.0), 0.5), 3);
  for (int h = 0; wall == 0 && h < 3; ++h) {
    add_level(chart, h == 0 ? "nonlocal solution" : "",
              nonlocal_at(5.0, 0.5, 10.0 / divisors_2021[static_cast<std::size_t>(h)]), h);
  }
  return save_paper_chart(chart, "2021_figure_06_" + name, "Fig. 6: m-convergence with the " + name + " wall.", runs);
}

ReportPicture place_picture(const WallStudy& study, double x, std::size_t time, const PaperRuns& runs) {
  const double when = wall_times_2021[time];
  Chart chart = m_chart_2021(fmt::format("2021, Fig. 7: inner, x = {} cm, t = {} s", x, when), "temperature [°C]");
  add_horizon_curves(chart, [&](int q, int ratio) { return study.at(2, q, ratio, time, x); });
  add_level(chart, "classical", study.classical(place_in_bar(x), when), 3);
  return save_paper_chart(chart, fmt::format("2021_figure_07_{}_{}s", x < 2.0 ? "near_end" : "middle", when),
                          fmt::format("Fig. 7: m-convergence with the inner wall at x = {} cm, t = {} s.", x, when),
                          runs);
}

/// Mirrored bars of δ = L/10 exact in time, by rule, m = 2, 4, 8, 16, 32.
ReportTable mirror_table(PaperRuns& runs) {
  constexpr std::array<int, 5> ratios{2, 4, 8, 16, 32};
  constexpr std::array<PartialVolumes, 2> rules{PartialVolumes::whole, PartialVolumes::trapezoid};
  std::vector<PaperRun> all;
  for (const PartialVolumes rule : rules) {
    for (const int ratio : ratios) all.push_back(run_of_2021(bar_of_2021(10, ratio, Imposed::mirror, rule), {0.5}));
  }
  const std::vector<Solution> solutions = runs.solve(std::move(all));
  const TemperatureAt nonlocal = make_temperature(NonlocalHeldEnds{0.1, 1e-3, 0.01, 100.0, 0.0});
  ReportTable table{"Mirror minus nonlocal solution, δ = L/10, t = 0.5 s, exact in time [°C]", {}};
  std::vector<double> sizes;
  std::vector<double> largest;
  for (std::size_t rule = 0; rule < 2; ++rule) {
    for (std::size_t k = 0; k < ratios.size(); ++k) {
      const Solution& solution = solutions[rule * ratios.size() + k];
      const double middle = solution.at(0, place_in_bar(5.0)) - nonlocal(place_in_bar(5.0), 0.5);
      const auto& right = rule == 0 ? values_2021::mirror_whole : values_2021::mirror_trapezoid;
      table.rows.push_back(ReportRow(fmt::format("{}, x = 5 cm, m = {}", rule_name(rules[rule]), ratios[k]), {5, false})
                               .recomputed(right[k])
                               .scheme(middle)
                               .near(ValueKind::scheme, ValueKind::recomputed, 6e-6));
      if (rule == 0) continue;
      sizes.push_back(1.0 / ratios[k]);
      largest.push_back(measure(StudyNorm::maximum, compare_bar(solution, 0, nonlocal)));
      table.rows.push_back(
          ReportRow(fmt::format("{}, largest over the nodes, m = {}", rule_name(rules[rule]), ratios[k]), {5, false})
              .recomputed(values_2021::mirror_trapezoid_largest[k])
              .scheme(largest.back())
              // The prototype's last digit, as above.
              .near(ValueKind::scheme, ValueKind::recomputed, ratios[k] < 32 ? 6e-5 : 6e-6));
    }
  }
  const std::size_t count = sizes.size();
  const double order = convergence_rate(sizes[count - 2], largest[count - 2], sizes[count - 1], largest[count - 1]);
  table.rows.push_back(ReportRow("trapezoid, order in 1/m between m = 16 and 32, largest over the nodes", {3, false})
                           .scheme(order)
                           .below("|order - 2|", std::abs(order - 2.0), 0.1));
  return table;
}

/// The last change by a doubling of m over the change before: 1/2 where the error falls like 1/m, towards 1 where there
/// is no limit in sight.
double last_shrinking(const std::vector<double>& values) {
  const std::size_t last = values.size() - 1;
  return (values[last] - values[last - 1]) / (values[last - 1] - values[last - 2]);
}

void add_shrinking_rows(ReportTable& table, const std::vector<double>& inner, const std::vector<double>& naive) {
  table.rows.push_back(ReportRow("inner: last change by a doubling of m over the one before, at least 0.8", {3, false})
                           .scheme(last_shrinking(inner))
                           .below("0.8 - ratio", 0.8 - last_shrinking(inner), 0.0));
  table.rows.push_back(ReportRow("naive: the same, at most 0.6 (0.5: first order in 1/m)", {3, false})
                           .scheme(last_shrinking(naive))
                           .below("|ratio|", std::abs(last_shrinking(naive)), 0.6));
}

/// The inner wall at one horizon with ever more points.
void add_inner_finding(ReportSection& section, const WallStudy& study, PaperRuns& runs) {
  std::vector<PaperRun> all;
  std::vector<int> ratios;
  for (int ratio = 2; ratio <= (runs.quick() ? 64 : 256); ratio *= 2) {
    ratios.push_back(ratio);
    all.push_back(run_of_2021(bar_of_2021(10, ratio, Imposed::row), {0.5}));
    all.push_back(run_of_2021(bar_of_2021(10, ratio, Imposed::constant), {0.5}));
  }
  const std::vector<Solution> solutions = runs.solve(std::move(all));
  Chart chart = m_chart_2021("2021: the inner wall at one horizon, δ = L/10", "temperature at 5 cm, 0.5 s [°C]");
  Curve inner{"inner", {}, {}, CurveStyle::dots_on_line, 0};
  Curve naive{"naive", {}, {}, CurveStyle::dots_on_line, 1};
  ReportTable table{"δ = L/10, ever more points, exact in time: T(5 cm, 0.5 s) [°C]", {}};
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    inner.x.push_back(ratios[k]);
    naive.x.push_back(ratios[k]);
    inner.y.push_back(solutions[2 * k].at(0, place_in_bar(5.0)));
    naive.y.push_back(solutions[2 * k + 1].at(0, place_in_bar(5.0)));
    table.rows.push_back(ReportRow(fmt::format("inner, m = {}", ratios[k]), {4, false})
                             .recomputed(values_2021::inner_values[k])
                             .scheme(inner.y.back())
                             .near(ValueKind::scheme, ValueKind::recomputed, 6e-4));
  }
  add_shrinking_rows(table, inner.y, naive.y);
  chart.curves = {std::move(inner), std::move(naive)};
  const double last = ratios.back();
  add_level(chart, "classical", study.classical(place_in_bar(5.0), 0.5), 2, last);
  add_level(chart, "insulated bar", 100.0, 3, last);
  section.blocks.push_back(
      ReportText{"Finding, against the paper: with the inner wall the solution does not converge in m at a fixed "
                 "horizon. The held node's share "
                 "of the body vanishes, and bonds of strength 1/ξ² do not feel a single point in the limit; the bar "
                 "slowly approaches an "
                 "insulated one (100 °C), like 1/log m. What looks like a plateau is this logarithm. With the naive "
                 "wall each doubling of m changes about half as much as the one before: it converges."});
  section.blocks.push_back(save_paper_chart(chart, "2021_inner_wall_does_not_converge",
                                            "The inner wall at δ = L/10: no limit but that of an insulated bar.",
                                            runs));
  section.blocks.push_back(std::move(table));
}

ReportTable wall_time_table(const WallStudy& study, PaperRuns& runs) {
  const PaperRun exact = run_of_2021(bar_of_2021(40, 16, Imposed::row), wall_times_2021);
  const std::vector<Solution> solutions = runs.solve({exact, with_tolerance(exact, 1e-11)});
  ReportTable table{"Time integration", {}};
  table.rows.push_back(
      ReportRow("forward Euler with 5e-5 s beside exact in time, inner, δ = L/40, m = 16: largest difference [°C]",
                {1, true})
          .scheme(largest_difference(study.solutions.at({2, 40, 16}), solutions[0])));
  table.rows.push_back(time_error_row("inner, δ = L/40, m = 16 [°C]", solutions[0], solutions[1], 1e-7));
  return table;
}

std::map<std::array<int, 2>, Solution> default_bars(PaperRuns& runs) {
  std::vector<PaperRun> all;
  for (const int q : divisors_2021) {
    for (const int ratio : ratios_2021) {
      all.push_back(default_run_of_2021(bar_of_2021(q, ratio, Imposed::mirror), {0.5}));
    }
  }
  std::vector<Solution> computed = runs.solve(std::move(all));
  std::map<std::array<int, 2>, Solution> solutions;
  auto next = computed.begin();
  for (const int q : divisors_2021) {
    for (const int ratio : ratios_2021) solutions[{q, ratio}] = std::move(*next++);
  }
  return solutions;
}

}  // namespace

ReportSection wall_section_2021(PaperRuns& runs) {
  const WallStudy study(runs);
  ReportSection section;
  section.blocks.push_back(
      ReportText{"Mirror: T(-x) = -T(x) outside. Naive: the wall's temperature in a layer of one horizon outside. "
                 "Inner: the outermost node is "
                 "held (at Δx/2), nothing outside. The text gives no number for these figures; rows are judged against "
                 "an independent prototype. "
                 "Rule whole: a cell counts if its point lies within the horizon, the reading of the one-point "
                 "quadrature that fits the paper's "
                 "claims about other kernels."});
  for (std::size_t time = 1; time < wall_times_2021.size(); ++time) {
    section.blocks.push_back(difference_picture(study, time, runs));
  }
  for (int wall = 0; wall < 3; ++wall) section.blocks.push_back(wall_picture(study, wall, runs));
  section.blocks.push_back(wall_table(study, default_bars(runs)));
  section.blocks.push_back(mirror_table(runs));
  add_inner_finding(section, study, runs);
  for (const std::size_t time : {std::size_t{0}, last_wall_time}) {
    for (const double x : {1.1875, 5.0}) section.blocks.push_back(place_picture(study, x, time, runs));
  }
  section.blocks.push_back(wall_time_table(study, runs));
  if (runs.quick()) section.left_out = "the inner wall beyond m = 64.";
  return section;
}

}  // namespace peritherm
