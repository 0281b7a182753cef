#include <omp.h>

#include <memory>
#include <vector>

#include "machine.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

constexpr long iterations = 100'000;

Calibration triad(std::size_t count) {
  struct Arrays {
    std::vector<double> a, b, c;
  };
  const auto arrays = std::make_shared<Arrays>(
      Arrays{std::vector<double>(count, 1.0), std::vector<double>(count, 2.0), std::vector<double>(count, 3.0)});
  return {[arrays] {
            machine_loops().front().triad(arrays->a.data(), arrays->b.data(), arrays->c.data(), arrays->a.size());
          },
          24.0 * static_cast<double>(count)};
}

Spread rate_of(double work, const Spread& time) {
  return {1e-9 * work / time.median, 1e-9 * work / time.high, 1e-9 * work / time.low};
}

/// 1e9 multiply-adds a second of all threads together, each by its own processor time.
double rate_of_all(double (*multiply)(long), int threads) {
  double rate = 0.0;
#pragma omp parallel num_threads(threads) reduction(+ : rate)
  {
    const double start = seconds(Clock::thread);
    const double work = multiply(20 * iterations);
    rate += 1e-9 * work / (seconds(Clock::thread) - start);
  }
  return rate;
}

void measure_fma(const Settings& settings, int threads, Report& report) {
  std::vector<std::vector<double>> rates(2 * machine_loops().size());
  for (int round = 0; round < settings.rounds; ++round) {
    for (std::size_t k = 0; k < rates.size(); ++k) {
      const MachineLoops& loops = machine_loops()[k / 2];
      rates[k].push_back(rate_of_all(k % 2 == 0 ? loops.multiply_adds : loops.multiply_adds_single, threads));
    }
  }
  for (std::size_t k = 0; k < rates.size(); ++k) {
    report.row({std::string("multiply-adds, ") + (k % 2 == 0 ? "double, " : "single, ") + machine_loops()[k / 2].name,
                static_cast<double>(threads), spread(rates[k]), std::string("1e9/s")});
  }
}

}  // namespace

Calibration fma_calibration(bool single) {
  const MachineLoops& widest = machine_loops().front();
  const auto multiply = single ? widest.multiply_adds_single : widest.multiply_adds;
  return {[multiply] { multiply(iterations); }, multiply(1) * iterations};
}

Calibration triad_calibration(bool quick) { return triad(std::size_t{1} << (quick ? 23 : 24)); }

void measure_limits(const Settings& settings, Report& report) {
  report.begin("limits",
               "what the machine can do, by the processor time of each thread; triad a = b + s c, 24 B counted per "
               "entry",
               {{"what"}, {"threads"}, {"rate"}, {"unit"}});
  const int all = omp_get_num_procs();
  measure_fma(settings, 1, report);
  if (all > 1) measure_fma(settings, all, report);
  const Calibration near = triad(std::size_t{1} << 13), far = triad_calibration(settings.quick);
  const Rounds rounds = interleave({near.run, far.run}, settings.rounds);
  report.row({std::string("triad, 192 KiB"), 1.0, rate_of(near.work, rounds.of(0)), std::string("GB/s")});
  report.row({std::string(settings.quick ? "triad, 192 MiB" : "triad, 384 MiB"), 1.0, rate_of(far.work, rounds.of(1)),
              std::string("GB/s")});
  report.end();
}

}  // namespace peritherm::bench
