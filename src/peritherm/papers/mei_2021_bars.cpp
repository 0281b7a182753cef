#include "peritherm/papers/mei_2021_bars.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "peritherm/studies/intersection.hpp"

namespace peritherm {
namespace {

constexpr double length_2021 = 10.0;  ///< [cm]
constexpr double fast_2021 = 10.0;    ///< diffusivities [cm²/s]
constexpr double slow_2021 = 1.0;

Problem bar_problem_2021(const BarOf2021& bar) {
  PaperBody body;
  body.size = {length_2021};
  body.diffusivity = fast_2021;
  body.cells = bar.cells;
  body.ratio = bar.ratio;
  body.kernel = ConstantKernel{};
  Problem problem = paper_problem(body);
  problem.body.points = PointPlacement::centres;
  problem.initial.temperature = 100.0;
  for (const Face face : {Face::x_min, Face::x_max}) {
    HeldTemperature held;
    held.value = 0.0;
    problem.boundaries.push_back({face, std::nullopt, held});
  }
  if (bar.layered) {
    problem.materials["slow"] = paper_material(slow_2021);
    for (const auto& [from, to] : {std::pair{2.5, 3.75}, std::pair{7.5, 10.0}}) {
      problem.body.regions.push_back({"slow", Box{{from * centimetre}, {to * centimetre}}});
    }
  }
  return problem;
}

}  // namespace

BarOf2021 bar_of_2021(int q, int ratio, Imposed wall, PartialVolumes rule) {
  BarOf2021 bar;
  bar.ratio = ratio;
  bar.cells = q * ratio;
  bar.wall = wall;
  bar.rule = rule;
  return bar;
}

PaperRun run_of_2021(const BarOf2021& bar, std::vector<double> times) {
  Problem problem = in_scheme(bar_problem_2021(bar), Scheme::mei_2021, PointPlacement::centres);
  problem.nonlocality.partial_volumes = bar.rule;
  if (bar.layered) problem.nonlocality.interface = bar.interface;
  for (BoundaryOptions& boundary : problem.boundaries) {
    std::get<HeldTemperature>(boundary.condition).imposed = bar.wall;
  }
  if (bar.step) {
    ForwardEuler euler;
    euler.step = *bar.step;
    problem.time.integrator = euler;
  } else {
    problem = with_time_error(std::move(problem), 1e-10);
  }
  return {std::move(problem), std::move(times)};
}

PaperRun default_run_of_2021(const BarOf2021& bar, std::vector<double> times) {
  return {with_time_error(bar_problem_2021(bar), 1e-10), std::move(times)};
}

TemperatureAt classical_bar_2021() {
  return make_temperature(HeldEnds{length_2021 * centimetre, fast_2021 * centimetre * centimetre, 100.0, 0.0});
}

TemperatureAt classical_layered_bar_2021() {
  LayeredBar bar;
  for (const double length : {2.5, 1.25, 3.75, 2.5}) bar.lengths.push_back(length * centimetre);
  for (const double diffusivity : {fast_2021, slow_2021, fast_2021, slow_2021}) {
    const Material material = paper_material(diffusivity);
    bar.conductivities.push_back(material.conductivity);
    bar.heat_capacities.push_back(volumetric_heat_capacity(material));
  }
  bar.start = {100.0};
  return make_temperature(bar);
}

Point place_in_bar(double x_cm) { return {x_cm * centimetre, 0.0, 0.0}; }

std::string rule_name(PartialVolumes rule) { return std::string(name_of(rule)); }

std::vector<PaperRun> SixRuns::runs() const {
  std::vector<PaperRun> all;
  for (const int q : {10, 20}) {
    for (const int ratio : {2, 4, 8}) {
      BarOf2021 one = bar;
      one.ratio = ratio;
      one.cells = q * ratio;
      all.push_back(run_of_2021(one, times));
    }
  }
  return all;
}

std::array<double, 3> SixRuns::curve(int q, std::size_t time, double x_cm) const {
  std::array<double, 3> values{};
  for (std::size_t k = 0; k < 3; ++k) values[k] = solutions[(q == 10 ? 0 : 3) + k].at(time, place_in_bar(x_cm));
  return values;
}

SixRuns::Crossing SixRuns::crossing(std::size_t time, double x_cm) const {
  const auto found = find_crossing(ratios, curve(10, time, x_cm), curve(20, time, x_cm));
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return found ? Crossing{found->ratio, found->temperature} : Crossing{none, none};
}

BarErrors errors_of(const Solution& solution, std::size_t time, const TemperatureAt& classical) {
  const ComparedPoints points = compare_bar(solution, time, classical);
  // The mean of the errors: a straight line between the nodes would add an error of its own.
  const std::size_t right = points.x.size() / 2;
  const std::size_t left = right - 1;
  const double middle =
      0.5 * (points.computed[left] - points.classical[left] + points.computed[right] - points.classical[right]);
  return {measure(StudyNorm::maximum, points), measure(StudyNorm::rms, points), std::abs(middle)};
}

}  // namespace peritherm
