#pragma once

#include <vector>

#include "peritherm/two_field/two_field_system.hpp"

namespace peritherm {

/// What is prescribed, looked at ahead of a march, so that steps that follow errors do not pass over a pulse. What is
/// shorter than the time between two looks may be missed.
class LoadLooks {
 public:
  explicit LoadLooks(const TwoFieldSystem& system);

  /// Forgets the looks before.
  void look(double from, double to);
  /// Up to when loads are as good as straight from `from` on, within the looks [s]; never much nearer than the next
  /// look. Infinite if nothing changes with time.
  double reach(double from) const;
  /// A share of what loads may bring, to measure errors by before they have [K].
  double promise() const { return promise_; }

 private:
  const TwoFieldSystem& system_;
  double capacity_ = 0.0;  ///< Σ ρ c V [J/K]
  std::vector<double> times_;
  std::vector<std::vector<double>> values_;  ///< per look
  std::vector<double> allowed_;              ///< misfit of each value
  double promise_ = 0.0;
};

}  // namespace peritherm
