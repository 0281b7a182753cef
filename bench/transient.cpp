// Time to solution of a cracked plate: evaluations, error, and how much longer RK4 at its limit takes, in one process.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>
#include <ctime>

#include "bodies.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm::bench {
namespace {

constexpr int cells = 512;

/// Temperature at the end, evaluations and processor time of the march alone.
struct Outcome {
  std::vector<double> temperature;
  long evaluations = 0;
  double seconds = 0.0;
};

Outcome march(const TimeStepping& stepping) {
  const Problem problem = body(2, cells, 6.5, BackendName::stencil, true);
  const Assembly assembly = assemble(problem);
  Outcome outcome{initial_state(problem, assembly), 0, 0.0};
  const auto integrator = make_integrator(stepping, *assembly.system);
  const std::clock_t start = std::clock();
  integrator->advance(0.0, problem.time.end, outcome.temperature, [](double, ConstField) { return true; });
  outcome.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  outcome.evaluations = integrator->count().evaluations;
  std::vector<double> points(assembly.geometry.body.grid.size());
  assembly.layout.gather(outcome.temperature, points);
  outcome.temperature = points;
  return outcome;
}

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    difference += (a[n] - b[n]) * (a[n] - b[n]);
    size += b[n] * b[n];
  }
  return std::sqrt(difference / size);
}

void transient(benchmark::State& state, const TimeStepping& stepping) {
  omp_set_num_threads(1);
  // Its own error is about 1e-7, far below those of the others.
  static const Outcome reference = march(RungeKutta4{std::nullopt, 1.0});
  Outcome outcome;
  for (auto _ : state) outcome = march(stepping);
  state.counters["evaluations"] = static_cast<double>(outcome.evaluations);
  state.counters["error"] = relative_difference(outcome.temperature, reference.temperature);
  state.counters["rk4_takes_times"] = reference.seconds / outcome.seconds;
}

BENCHMARK_CAPTURE(transient, rkl2_1em4, RungeKuttaLegendre{1e-4})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(transient, rkl2_3em5, RungeKuttaLegendre{3e-5})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(transient, rkl2_1em5, RungeKuttaLegendre{1e-5})->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(transient, euler_at_its_limit, ForwardEuler{std::nullopt, 1.0})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace peritherm::bench
