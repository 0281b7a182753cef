#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "peritherm/papers/paper_chart.hpp"
#include "peritherm/papers/xue_2018_cases.hpp"
#include "peritherm/papers/xue_2018_sections.hpp"
#include "peritherm/papers/xue_2018_values.hpp"
#include "peritherm/solutions/layered_slab.hpp"

namespace peritherm {
namespace {

const std::array<std::string_view, 5> ramp_quantities_2018{"T(.25)", "T(.5-)", "T(.5+)", "T(.75)", "flux"};

DrivenLayers ramp_solution_2018(const LayersOf2018& layers) {
  return {{layers.first, layers.second}, FarEnd::held, TemperatureRamp{1.0, layers.rise_time}};
}

/// The four points about x = .25 and x = .75, which lie between points.
std::vector<Point> beside_2018(int cells) {
  std::vector<Point> places;
  for (const double x : {0.25, 0.75}) {
    for (const double layers : {-1.5, -0.5, 0.5, 1.5}) places.push_back({x + 0.5 * layers / cells, 0.0, 0.0});
  }
  return places;
}

/// Cubic between these, so that reading off adds nothing to the error.
double between_2018(const std::vector<double>& values, std::size_t first) {
  return (9.0 * (values[first + 1] + values[first + 2]) - values[first] - values[first + 3]) / 16.0;
}

/// As the prototype did: 100 points per layer, midpoint steps of 1e-3.
ContactTask ramp_task_2018(const LayersOf2018& layers, std::vector<double> times, std::optional<double> stabilisation) {
  Problem problem = problem_of_2018({layers, 100, 3.0, stabilisation, 1});
  drive(problem, ramp_of(layers));
  step_by(problem, 1e-3, 1.0, 0.0, SingleStepStart::consistent);
  return {std::move(problem), std::move(times), beside_2018(100)};
}

std::array<double, 5> ramp_values_2018(const ContactRun& run, std::size_t time) {
  const InterfaceValues& contact = run.contacts[time].front();
  const std::vector<double>& values = run.at_places[time];
  return {between_2018(values, 0), contact.first[0], contact.second[0], between_2018(values, 4), contact.flux[0]};
}

std::array<double, 5> exact_ramp_2018(const LayersOf2018& layers, double t) {
  const DrivenLayers solution = ramp_solution_2018(layers);
  return {solution.temperature_in(0, 0.25, t), solution.temperature_in(0, 0.5, t), solution.temperature_in(1, 0.5, t),
          solution.temperature_in(1, 0.75, t), solution.flux_in(0, 0.5, t)};
}

/// The front of case III is spread by the stabilisation.
double ramp_limit_2018(std::string_view name) {
  return name.substr(0, 3) == "III" ? 1e-2 : (name.substr(0, 2) == "II" ? 6e-4 : 1e-4);
}

ReportTable ramp_table_2018(const std::vector<ContactRun>& computed) {
  ReportTable table{"100 points per layer, s = 1, midpoint steps of 1e-3", {}};
  std::size_t number = 0;
  for (const auto& known : xue_2018_values::ramps) {
    const std::array<double, 5> found = ramp_values_2018(computed[number++], 0);
    const std::array<double, 5> exact = exact_ramp_2018(layers_of_2018(std::string(known.name)), known.time);
    for (std::size_t k = 0; k < 5; ++k) {
      table.rows.push_back(
          ReportRow(fmt::format("{}, t = {}: {}", known.name, known.time, ramp_quantities_2018[k]), {8, false})
              .recomputed(known.values[k])
              .defaults(found[k])
              .exact(exact[k])
              .near(ValueKind::defaults, ValueKind::recomputed, 1e-8)
              .near(ValueKind::defaults, ValueKind::exact, ramp_limit_2018(known.name)));
    }
  }
  return table;
}

ReportTable system_table_2018(const std::vector<ContactRun>& computed) {
  ReportTable table{
      "The systems: largest constraint residual after any step", {}, {"index", "rows", "relaxing fluxes"}};
  for (std::size_t k = 0; k < computed.size(); ++k) {
    const ContactRun& run = computed[k];
    ReportRow row(fmt::format("{}, t = {}", xue_2018_values::ramps[k].name, xue_2018_values::ramps[k].time), {1, true});
    row.defaults(run.summary.largest_residual).below("residual", run.summary.largest_residual, 1e-12);
    row.further = {std::to_string(run.plan.index), std::to_string(run.plan.multipliers),
                   std::to_string(run.plan.flux_unknowns)};
    table.rows.push_back(std::move(row));
  }
  return table;
}

void add_profile_2018(Chart& chart, const ContactRun& run, std::size_t time, const DrivenLayers& solution, int colour) {
  Curve computed{fmt::format("t = {}", run.times[time]), {}, {}, CurveStyle::dots, colour};
  Curve exact{"", {}, {}, CurveStyle::line, colour};
  for (std::size_t i = 0; i < run.grid.size(); ++i) {
    const double x = run.grid.position(run.grid.index(i))[0];
    if (i % 5 == 2) {
      computed.x.push_back(x);
      computed.y.push_back(run.temperatures[time][i]);
    }
  }
  for (std::size_t layer = 0; layer < 2; ++layer) {
    for (int i = 0; i <= 50; ++i) {
      const double x = 0.5 * static_cast<double>(layer) + 0.01 * i;
      exact.x.push_back(x);
      exact.y.push_back(solution.temperature_in(layer, x, run.times[time]));
    }
  }
  chart.curves.push_back(std::move(computed));
  chart.curves.push_back(std::move(exact));
}

ReportPicture profile_picture_2018(const LayersOf2018& layers, const ContactRun& run, const PaperRuns& runs) {
  Chart chart = make_paper_chart("Case " + layers.name, "x", "temperature");
  const DrivenLayers solution = ramp_solution_2018(layers).quick();
  for (std::size_t time = 0; time < run.times.size(); ++time) {
    add_profile_2018(chart, run, time, solution, static_cast<int>(time));
  }
  std::string stem = "2018_case_" + layers.name;
  std::replace(stem.begin(), stem.end(), ' ', '_');
  return save_paper_chart(chart, stem,
                          fmt::format("Case {}: computed (dots) and exact (lines){}.", layers.name,
                                      layers.second.resistance > 0.0 ? "; the temperature jumps by R q" : ""),
                          runs);
}

std::vector<ContactTask> profile_tasks_2018() {
  std::vector<ContactTask> tasks;
  for (const LayersOf2018& layers : layers_of_2018()) {
    const std::vector<double> times = layers.name.substr(0, 3) == "III" ? std::vector<double>{0.2, 0.5, 1.0, 1.5}
                                                                        : std::vector<double>{0.05, 0.1, 0.2, 0.6};
    tasks.push_back(ramp_task_2018(layers, times, std::nullopt));
  }
  return tasks;
}

double step_limit_2018(int cells) { return cells == 100 ? 1e-4 : 2.5e-5; }

ContactTask step_task_2018(int cells, const LayersOf2018& layers) {
  Problem problem = problem_of_2018({layers, cells, 3.0, 1.0, 1});
  drive(problem, "1");
  step_by(problem, 5e-4, 0.5, 0.0);
  return {std::move(problem), {0.1, 0.5}, beside_2018(cells)};
}

void add_step_rows_2018(ReportTable& table, const LayersOf2018& layers, int cells, const ContactRun& run) {
  const LayeredSlab slab(
      {{0.5, layers.first.conductivity, layers.first.heat_capacity, 0.0},
       {0.5, layers.second.conductivity, layers.second.heat_capacity, 0.0, layers.second.resistance}},
      1.0, 0.0);
  for (std::size_t time = 0; time < run.times.size(); ++time) {
    const double t = run.times[time];
    const std::array<double, 5> found = ramp_values_2018(run, time);
    const std::array<double, 4> exact{slab.temperature(0.25, t), slab.temperature_in(0, 0.5, t),
                                      slab.temperature_in(1, 0.5, t), slab.temperature(0.75, t)};
    for (std::size_t k = 0; k < 4; ++k) {
      table.rows.push_back(
          ReportRow(fmt::format("{}, {} points per layer, t = {}: {}", layers.name, cells, t, ramp_quantities_2018[k]),
                    {8, false})
              .defaults(found[k])
              .exact(exact[k])
              .near(ValueKind::defaults, ValueKind::exact, step_limit_2018(cells)));
    }
  }
}

}  // namespace

ReportSection ramps_section_2018(PaperRuns& runs) {
  std::vector<ContactTask> tasks;
  for (const auto& known : xue_2018_values::ramps) {
    tasks.push_back(ramp_task_2018(layers_of_2018(std::string(known.name)), {known.time}, 1.0));
  }
  const std::size_t first_profile = tasks.size();
  for (ContactTask& task : profile_tasks_2018()) tasks.push_back(std::move(task));
  std::vector<ContactRun> computed = march_contacts(runs, tasks);
  const std::vector<ContactRun> profiles(computed.begin() + static_cast<std::ptrdiff_t>(first_profile), computed.end());
  computed.resize(first_profile);
  ReportSection section;
  section.blocks.push_back(
      ReportText{"T(0, t) = 1 - (1 + z + z²/2) e^{-z}, z = t/t_r, begins with slope and curvature 0, so that nothing "
                 "has to be said "
                 "about start steps; t_r = 0.05, in case III 0.1. The exact values come from the impedances of the "
                 "layers, inverted "
                 "by a Fourier series. T(.75) of case III at t = 0.5 lies ahead of the front and is exactly 0: what is "
                 "below 0 there "
                 "is the stabilisation's, and reported."});
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    section.blocks.push_back(profile_picture_2018(layers_of_2018()[k], profiles[k], runs));
  }
  section.blocks.push_back(ramp_table_2018(computed));
  section.blocks.push_back(system_table_2018(computed));
  return section;
}

ReportSection steps_section_2018(PaperRuns& runs) {
  const std::vector<int> cells = runs.quick() ? std::vector<int>{100} : std::vector<int>{100, 200};
  const std::array<std::string, 2> names{"I perfect", "I resistance"};
  std::vector<ContactTask> tasks;
  for (const int n : cells) {
    for (const std::string& name : names) tasks.push_back(step_task_2018(n, layers_of_2018(name)));
  }
  const std::vector<ContactRun> computed = march_contacts(runs, tasks);
  ReportSection section;
  section.blocks.push_back(ReportText{
      "T(0) = 1 from the start on, which the start at 0 does not fit: the march begins with two half steps of backward "
      "Euler. Exact: the sum over modes with the contact resistance."});
  ReportTable table{"Steps of 5e-4 with (ρ∞, ρ∞ of the rate) = (0.5, 0), s = 1", {}};
  std::size_t next = 0;
  for (const int n : cells) {
    for (const std::string& name : names) add_step_rows_2018(table, layers_of_2018(name), n, computed[next++]);
  }
  section.blocks.push_back(std::move(table));
  if (runs.quick()) section.left_out = "200 points per layer.";
  return section;
}

}  // namespace peritherm
