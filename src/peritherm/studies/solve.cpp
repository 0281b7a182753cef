#include "peritherm/studies/solve.hpp"

#include <omp.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "peritherm/output/interpolation.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/not_finite.hpp"

namespace peritherm {
namespace {

std::vector<double> points_of(const Assembly& assembly, ConstField state) {
  const Body& body = assembly.geometry.body;
  std::vector<double> values(body.grid.size());
  assembly.layout.gather(state, values);
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (body.material_of[n] == no_material) values[n] = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

/// Keeps the temperatures of every point at each time.
class Recorder {
 public:
  Recorder(Assembly& assembly, Solution& solution) : assembly_(assembly), solution_(solution) {}

  void operator()(double time, Field state) {
    assembly_.system->begin_step(time, time);
    assembly_.system->fill(time, state);
    solution_.temperatures.push_back(points_of(assembly_, state));
    const Body& body = assembly_.geometry.body;
    for (std::size_t n = 0; n < body.grid.size(); ++n) {
      if (body.material_of[n] == no_material || std::isfinite(solution_.temperatures.back()[n])) continue;
      report_not_finite(assembly_, state, time);
    }
    solution_.times.push_back(time);
  }

 private:
  Assembly& assembly_;
  Solution& solution_;
};

}  // namespace

double Solution::at(std::size_t time, const Point& place) const {
  return interpolate(grid, temperatures.at(time), place);
}

Prepared prepare_to_solve(Problem problem, std::span<const double> times) {
  if (!times.empty() && times.back() > 0.0) problem.time.end = times.back();
  problem.outputs.clear();
  check(problem);
  return prepare(problem);
}

Solution solve(const Problem& problem, std::span<const double> times, const std::function<bool()>& stop_requested) {
  return solve(prepare_to_solve(problem, times), times, stop_requested);
}

Solution solve(const Prepared& prepared, std::span<const double> times, const std::function<bool()>& stop_requested) {
  const Problem& problem = prepared.problem;
  omp_set_num_threads(prepared.threads);  // Each thread of the program has a number of its own.
  const auto start = std::chrono::steady_clock::now();
  Assembly assembly = assemble(problem);
  Solution solution;
  solution.grid = assembly.geometry.body.grid;
  solution.horizon = assembly.geometry.stencil_options.horizon;
  solution.bonds = static_cast<double>(count_bonds(assembly.geometry.body, assembly.geometry.stencil));
  FieldStorage state = initial_state(problem, assembly);
  Recorder record(assembly, solution);
  const std::size_t first = !times.empty() && times.front() == 0.0 ? 1 : 0;
  if (first == 1) record(0.0, state);
  const std::span<const double> later = times.subspan(first);
  if (later.empty()) return solution;
  const ChosenStepping chosen = choose_stepping(problem.time.integrator, *assembly.system, 0.0, later);
  solution.integrator = std::visit([](const auto& options) { return std::string(options.name); }, chosen.stepping);
  const auto integrator = make_integrator(chosen.stepping, *assembly.system);
  const auto goes_on = [&stop_requested] { return !stop_requested || !stop_requested(); };
  const auto arrive = [&](double now, Field field) {
    record(now, field);
    return goes_on();
  };
  integrator->march(0.0, later, state,
                    {[&](double, ConstField) { return goes_on(); }, arrive, [&](double) { return goes_on(); }});
  solution.count = integrator->count();
  solution.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return solution;
}

}  // namespace peritherm
