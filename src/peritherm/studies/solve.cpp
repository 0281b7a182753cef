#include "peritherm/studies/solve.hpp"

#include <omp.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "peritherm/output/interpolation.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/gap_stepping.hpp"
#include "peritherm/simulation/not_finite.hpp"
#include "peritherm/simulation/running_case.hpp"
#include "peritherm/simulation/two_field_plan.hpp"

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

/// Through the interface that runs have too: parts may have points off the grid.
Solution solve_two_fields(const Problem& problem, std::span<const double> times,
                          const std::function<bool()>& stop_requested) {
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<RunningCase> running = make_two_field_case(problem);
  Solution solution;
  const auto record = [&](double time) {
    const Snapshot snapshot = running->snapshot(time);
    if (solution.times.empty()) {
      solution.grid = snapshot.grid;
      solution.materials.assign(snapshot.materials.begin(), snapshot.materials.end());
    }
    solution.temperatures.emplace_back(snapshot.temperature.size());
    snapshot.temperature.copy(0, solution.temperatures.back());
    solution.times.push_back(time);
    return !stop_requested || !stop_requested();
  };
  const Plan plan = running->plan();
  solution.horizon = plan.horizon;
  solution.integrator = plan.integrator;
  const std::size_t first = !times.empty() && times.front() == 0.0 ? 1 : 0;
  if (first == 1) record(0.0);
  const auto goes_on = [&stop_requested](double) { return !stop_requested || !stop_requested(); };
  if (first < times.size()) running->march(times.subspan(first), {goes_on, record, goes_on});
  solution.count = running->count();
  solution.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return solution;
}

}  // namespace

double Solution::at(std::size_t time, const Point& place) const {
  const std::vector<double>& values = temperatures.at(time);
  if (materials.empty()) return interpolate(grid, values, place);
  // Never across an interface, where temperatures may jump.
  const std::size_t nearest = grid.number(nearest_point(grid, place));
  const InterpolationWeights weights =
      interpolation_weights(grid, place, [&](std::size_t number) { return materials[number] == materials[nearest]; });
  double sum = weights.count == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  for (const WeightedPoint& point : weights) sum += point.weight * values[point.number];
  return sum;
}

Prepared prepare_to_solve(Problem problem, std::span<const double> times) {
  if (!times.empty() && times.back() > 0.0) problem.time.end = times.back();
  problem.outputs.clear();
  check(problem);
  if (problem.nonlocality.model != Model::two_field) return prepare(problem);
  Prepared prepared;
  prepared.problem = prepare_two_field(problem);
  prepared.threads = omp_get_max_threads();
  return prepared;
}

Solution solve(const Problem& problem, std::span<const double> times, const std::function<bool()>& stop_requested) {
  return solve(prepare_to_solve(problem, times), times, stop_requested);
}

Solution solve(const Prepared& prepared, std::span<const double> times, const std::function<bool()>& stop_requested) {
  const Problem& problem = prepared.problem;
  omp_set_num_threads(prepared.threads);  // Each thread of the program has a number of its own.
  if (problem.nonlocality.model == Model::two_field) {
    Problem with_threads = problem;
    with_threads.numerics.threads = prepared.threads;
    return solve_two_fields(with_threads, times, stop_requested);
  }
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
  const auto integrator = make_case_integrator(chosen.stepping, problem, assembly);
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
