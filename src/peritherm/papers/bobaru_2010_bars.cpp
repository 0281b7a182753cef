#include "peritherm/papers/bobaru_2010_bars.hpp"

#include <cmath>
#include <numbers>

namespace peritherm {
namespace {

constexpr double diffusivity_of_2010 = 1.14;      ///< [cm²/s]
constexpr double time_tolerance_of_2010 = 1e-11;  ///< of temperatures over their span

Problem bar_problem(const BarOf2010& bar, int cells) {
  PaperBody body;
  body.size = {length_of_2010(bar.example)};
  body.diffusivity = diffusivity_of_2010;
  body.cells = cells;
  body.ratio = bar.ratio;
  if (bar.constant) body.kernel = ConstantKernel{};
  Problem problem = paper_problem(body);
  if (bar.example == 1) {
    problem.initial.temperature = 100.0;
    hold(problem, Face::x_min, 0.0);
    hold(problem, Face::x_max, 0.0);
  } else if (bar.example == 2) {
    // The paper leaves the node in the middle open; the mean of both sides keeps the step where it is.
    problem.initial.temperature = Profile("abs(x - 0.05) < 1e-9 ? 30 : 60*(x < 0.05)");
    hold(problem, Face::x_max, 100.0);
  } else {
    hold(problem, Face::x_min, 20.0);
    PrescribedFlux flux;
    flux.value = 3.0 / centimetre * problem.materials.at("body").conductivity;
    problem.boundaries.push_back({Face::x_max, std::nullopt, flux});
  }
  return with_time_error(std::move(problem), time_tolerance_of_2010);
}

}  // namespace

std::string kernel_word(bool constant) { return constant ? "constant" : "triangular"; }

double length_of_2010(int example) { return example == 3 ? std::numbers::pi : 10.0; }

int nodes_of_2010(const BarOf2010& bar) { return static_cast<int>(std::lround(bar.ratio * bar.divisor / 3.0)); }

PaperRun scheme_run_of_2010(const BarOf2010& bar, std::vector<double> times) {
  Problem problem = bar_problem(bar, nodes_of_2010(bar));
  return {in_scheme(std::move(problem), Scheme::bobaru_2010, PointPlacement::centres), std::move(times)};
}

PaperRun default_run_of_2010(const BarOf2010& bar, std::vector<double> times) {
  const int nodes = nodes_of_2010(bar);
  return {bar_problem(bar, nodes + nodes % 2), std::move(times)};
}

ExactSolution classical_of_2010(int example) {
  const double length = length_of_2010(example) * centimetre;
  const double diffusivity = diffusivity_of_2010 * centimetre * centimetre;
  if (example == 1) return HeldEnds{length, diffusivity, 100.0, 0.0};
  if (example == 2) return SteppedStart{length, diffusivity, 60.0, 0.0, 0.5 * length, 100.0};
  return HeldAndGradient{length, diffusivity, 0.0, 20.0, 3.0 / centimetre};
}

BarFlux flux_of_2010(const BarOf2010& bar, const Solution& solution, std::size_t time) {
  const std::vector<double>& theta = solution.temperatures.at(time);
  const double spacing = solution.grid.spacing / centimetre;
  const double horizon = bar.ratio * spacing;
  const auto conductivity = [&](double distance) {
    return bar.constant ? 1.0 / horizon : 2.0 / horizon * (1.0 - distance / horizon);
  };
  BarFlux result;
  for (std::size_t i = 0; i + static_cast<std::size_t>(bar.ratio) < theta.size(); ++i) {
    // The node's own right half conducts as its right neighbour does, with k at distance 0.
    double sum = conductivity(0.0) * (theta[i + 1] - theta[i]) / spacing * 0.5 * spacing;
    for (int j = 1; j <= bar.ratio; ++j) {
      const double volume = j == bar.ratio ? 0.5 * spacing : spacing;
      const double distance = j * spacing;
      sum += conductivity(distance) * (theta[i + static_cast<std::size_t>(j)] - theta[i]) / distance * volume;
    }
    result.x.push_back(solution.grid.position({static_cast<int>(i), 0, 0})[0] / centimetre);
    result.flux.push_back(-sum);
  }
  return result;
}

}  // namespace peritherm
