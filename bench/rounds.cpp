#include "rounds.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace peritherm::bench {
namespace {

double timed(const std::function<void()>& run, long repeats, Clock clock) {
  const double start = seconds(clock);
  for (long n = 0; n < repeats; ++n) run();
  return (seconds(clock) - start) / static_cast<double>(repeats);
}

}  // namespace

double seconds(Clock clock) {
  timespec now{};
  clock_gettime(clock == Clock::thread    ? CLOCK_THREAD_CPUTIME_ID
                : clock == Clock::process ? CLOCK_PROCESS_CPUTIME_ID
                                          : CLOCK_MONOTONIC,
                &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Spread spread(std::vector<double> values) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {none, none, none};
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {median, values.front(), values.back()};
}

Spread Rounds::ratio(std::size_t above, std::size_t below) const {
  std::vector<double> ratios;
  for (std::size_t r = 0; r < times_.at(above).size(); ++r) ratios.push_back(times_[above][r] / times_.at(below)[r]);
  return spread(std::move(ratios));
}

Rounds interleave(const Contenders& contenders, int rounds, Clock clock, double least_seconds) {
  std::vector<long> repeats;
  for (const auto& run : contenders) {
    run();  // The first run pays for pages and for tables.
    repeats.push_back(std::clamp(std::lround(least_seconds / timed(run, 1, clock)), 1L, 100'000'000L));
  }
  std::vector<std::vector<double>> times(contenders.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < contenders.size(); ++k) times[k].push_back(timed(contenders[k], repeats[k], clock));
  }
  return Rounds(std::move(times));
}

}  // namespace peritherm::bench
