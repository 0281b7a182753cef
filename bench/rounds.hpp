#pragma once

#include <functional>
#include <vector>

namespace peritherm::bench {

/// Which clock a comparison is made by: the processor time of the calling thread, which other programs do not spend,
/// that of all threads, or the time of day.
enum class Clock { thread, process, wall };
double seconds(Clock clock);

/// Middle value and range over the rounds.
struct Spread {
  double median = 0.0, low = 0.0, high = 0.0;
};
Spread spread(std::vector<double> values);

/// What takes part in a comparison.
using Contenders = std::vector<std::function<void()>>;

/// Seconds of one run of each contender in each round.
class Rounds {
 public:
  explicit Rounds(std::vector<std::vector<double>> times) : times_(std::move(times)) {}

  Spread of(std::size_t contender) const { return spread(times_.at(contender)); }
  /// Ratio of two contenders within the same round: what slows the machine for a while slows both.
  Spread ratio(std::size_t above, std::size_t below) const;
  const std::vector<double>& times(std::size_t contender) const { return times_.at(contender); }

 private:
  std::vector<std::vector<double>> times_;
};

/// Every round runs each contender once, so often in a row that it takes `least_seconds`.
Rounds interleave(const Contenders& contenders, int rounds, Clock clock = Clock::thread, double least_seconds = 0.02);

}  // namespace peritherm::bench
