#pragma once

#include <functional>
#include <memory>
#include <span>

#include "peritherm/integrators/integrator.hpp"
#include "peritherm/two_field/two_field_system.hpp"

namespace peritherm {

/// Who follows a march through two fields. Each call that returns false ends it.
struct TwoFieldFollower {
  std::function<bool(double time, const TwoFieldState& state)> after_step;
  std::function<bool(double time, const TwoFieldState& state)> at_time;  ///< at each of the times asked for
};

struct TwoFieldCount {
  StepCount steps;  ///< evaluations: solved linear systems
  long factorisations = 0;
  long iterations = 0;                             ///< of conjugate gradients
  double largest_residual = 0.0;                   ///< of a constraint after any step [K]
  double longest_step = 0.0, shortest_step = 0.0;  ///< [s]
};

/// Moves two fields from one time to another; knows neither bodies nor files.
class TwoFieldIntegrator {
 public:
  virtual ~TwoFieldIntegrator() = default;
  /// Through the times, ascending and after `from`; returns the time reached. The state must be consistent, or the
  /// method's options must say that it starts with backward Euler.
  virtual double march(double from, std::span<const double> times, TwoFieldState& state,
                       const TwoFieldFollower& follower) = 0;
  virtual TwoFieldCount count() const = 0;
};

/// Throws Error for methods that do not integrate systems with algebraic rows; says which do.
std::unique_ptr<TwoFieldIntegrator> make_two_field_integrator(const TimeStepping& options, TwoFieldSystem& system);

}  // namespace peritherm
