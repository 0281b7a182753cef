#include <omp.h>

#include <vector>

#include "machine.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

constexpr long iterations = 100'000;

/// a = b + 3 c on arrays of this many numbers; bytes are counted without the read of a that a store may cost.
class Triad {
 public:
  explicit Triad(std::size_t count) : a_(count, 1.0), b_(count, 2.0), c_(count, 3.0) {}
  void run() { machine_loops().front().triad(a_.data(), b_.data(), c_.data(), a_.size()); }
  double bytes() const { return 24.0 * static_cast<double>(a_.size()); }

 private:
  std::vector<double> a_, b_, c_;
};

Spread rate_of(double work, const Spread& time) {
  return {1e-9 * work / time.median, 1e-9 * work / time.high, 1e-9 * work / time.low};
}

void measure_fma(const Settings& settings, int threads, Report& report) {
  Contenders contenders;
  std::vector<double> work(2 * machine_loops().size());
  for (std::size_t k = 0; k < work.size(); ++k) {
    const MachineLoops& loops = machine_loops()[k / 2];
    const auto multiply = k % 2 == 0 ? loops.multiply_adds : loops.multiply_adds_single;
    work[k] = threads * multiply(1) * iterations;
    contenders.push_back([multiply, threads] {
#pragma omp parallel num_threads(threads)
      multiply(iterations);
    });
  }
  const Rounds rounds = interleave(contenders, settings.rounds, threads == 1 ? Clock::thread : Clock::wall);
  for (std::size_t k = 0; k < work.size(); ++k) {
    report.row({std::string("multiply-adds, ") + (k % 2 == 0 ? "double, " : "single, ") + machine_loops()[k / 2].name,
                static_cast<double>(threads), rate_of(work[k], rounds.of(k)), std::string("1e9/s")});
  }
}

}  // namespace

FmaCalibration fma_calibration(bool single) {
  const MachineLoops& widest = machine_loops().front();
  const auto multiply = single ? widest.multiply_adds_single : widest.multiply_adds;
  return {[multiply] { multiply(iterations); }, multiply(1) * iterations};
}

void measure_limits(const Settings& settings, Report& report) {
  report.begin("limits",
               "what the machine can do; one thread by its processor time, several by the time of day; triad "
               "a = b + s c, 24 B counted per entry",
               {{"what"}, {"threads"}, {"rate"}, {"unit"}});
  const int all = omp_get_num_procs();
  measure_fma(settings, 1, report);
  if (all > 1) measure_fma(settings, all, report);
  Triad near(std::size_t{1} << 13), far(std::size_t{1} << (settings.quick ? 23 : 24));
  const Rounds rounds = interleave({[&near] { near.run(); }, [&far] { far.run(); }}, settings.rounds);
  report.row({std::string("triad, 192 KiB"), 1.0, rate_of(near.bytes(), rounds.of(0)), std::string("GB/s")});
  report.row({std::string(settings.quick ? "triad, 192 MiB" : "triad, 384 MiB"), 1.0,
              rate_of(far.bytes(), rounds.of(1)), std::string("GB/s")});
  report.end();
}

}  // namespace peritherm::bench
