// One evaluation of dT/dt: nanoseconds per point and per bond, bytes per point, of both backends on the same bodies.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>

#include "bodies.hpp"

namespace peritherm::bench {
namespace {

/// Arguments: dimension, cells along each axis, 10 × horizon/spacing, cracked.
void apply(benchmark::State& state, BackendName backend) {
  omp_set_num_threads(1);
  const Problem problem = body(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                               static_cast<double>(state.range(2)) / 10.0, backend, state.range(3) != 0);
  const Assembly assembly = assemble(problem);
  HeatSystem& system = *assembly.system;
  std::vector<double> temperature = initial_state(problem, assembly);
  std::vector<double> rate(system.size());
  for (std::size_t n = 0; n < temperature.size(); ++n) temperature[n] = std::sin(0.001 * static_cast<double>(n));
  for (auto _ : state) {
    system.combine(0.0, temperature, 1.0, {}, rate);
    benchmark::DoNotOptimize(rate.data());
    benchmark::ClobberMemory();
  }
  const auto points = static_cast<double>(assembly.geometry.body.grid.size());
  const auto bonds = static_cast<double>(assembly.geometry.stencil.entries.size());
  const double held = static_cast<double>(system.bytes()) + 8.0 * static_cast<double>(system.size());
  using benchmark::Counter;
  state.counters["bonds"] = bonds;
  state.counters["ns/point"] = Counter(points * 1e-9, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["ns/bond"] = Counter(points * bonds * 1e-9, Counter::kIsIterationInvariantRate | Counter::kInvert);
  // One field and the operator; a run with rkl2 keeps three fields more.
  state.counters["B/point"] = held / points;
}

void cases(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"dim", "cells", "10m", "crack"})->Unit(benchmark::kMicrosecond);
  for (const int ratio : {30, 65, 130}) bench->Args({1, 100000, ratio, 0});
  for (const int ratio : {30, 65, 130}) bench->Args({2, 512, ratio, 0});
  bench->Args({2, 512, 65, 1});
  for (const int ratio : {20, 30, 40}) bench->Args({3, 64, ratio, 0});
  bench->Args({3, 64, 30, 1});
}

BENCHMARK_CAPTURE(apply, stencil, BackendName::stencil)->Apply(cases);
BENCHMARK_CAPTURE(apply, bond, BackendName::bond)->Apply(cases);

}  // namespace
}  // namespace peritherm::bench
