#pragma once

#include "peritherm/operators/conduction.hpp"

namespace peritherm {

/// dT/dt = rate(t, T). A state holds every point, fictitious and held ones included (they are filled in here, not
/// integrated), and behind them the heat that has passed each boundary, so that any linear integrator balances
/// energy to rounding.
class ThermalSystem {
 public:
  virtual ~ThermalSystem() = default;
  virtual std::size_t size() const = 0;  ///< entries of a state

  /// Conductances that change in time take their mean over [from, to] (the first Magnus term, second order).
  /// True if the rate is another function than before.
  virtual bool begin_step(double from, double to) = 0;

  /// result = Σ weight · values + rate_weight · rate(time, temperature). Writes the held and fictitious entries of
  /// `temperature`. `result` may be one of the terms, but not `temperature`.
  virtual void combine(double time, Field temperature, double rate_weight, Terms terms, Field result) = 0;

  /// Root mean square over the free points of Σ weight · values; the same bits for any number of threads.
  virtual double rms(Terms terms) const = 0;

  /// Lowest and highest temperature of the body and of its surroundings; NaN if any temperature is not a number.
  using Extremes = ConductionOperator::Extremes;
  virtual Extremes extremes(ConstField temperature) const = 0;

  /// Upper bound of the fastest decay rate [1/s]; sets explicit steps and stage counts.
  virtual double fastest_rate() const = 0;
};

}  // namespace peritherm
