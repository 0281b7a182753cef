#pragma once

#include <optional>

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

  /// What boundaries and sources prescribe, as a polynomial in time over [begin, end].
  struct LoadPiece {
    double begin, end;
    int degree;
  };
  /// Fits the loads over [from, end] with the latest end <= to at which a polynomial of at most the given degree keeps
  /// the relative tolerance. None if conductances change in [from, to], so that the rate is no such function of time.
  virtual std::optional<LoadPiece> fit_loads(double from, double to, int degree, double tolerance) = 0;

  /// As combine, with the part of the rate that is linear in the temperature, plus the k-th derivative in time of the
  /// fitted loads at the begin of their piece; k < 0: without loads.
  virtual void combine_linear(int k, Field temperature, double rate_weight, Terms terms, Field result,
                              Accumulations accumulations = {}) = 0;

  /// Whether the linear part is symmetric in the heat product (without the heat accounts), so that its eigenvalues are
  /// real and conjugate gradients apply.
  virtual bool is_symmetric() const { return true; }

  /// Σ C a b over the free points.
  virtual double heat_product(ConstField a, ConstField b) const = 0;

  /// Entries of a state that are temperatures; heat accounts stand behind them.
  virtual std::size_t field_size() const = 0;

  /// Root mean square over the free points of Σ weight · values; the same bits for any number of threads.
  virtual double rms(Terms terms) const = 0;

  /// Lowest and highest temperature of the body and of its surroundings; NaN if any temperature is not a number.
  using Extremes = ConductionOperator::Extremes;
  virtual Extremes extremes(ConstField temperature) const = 0;

  /// Rounding of a rate over the largest rates [1].
  virtual double rate_rounding() const = 0;

  /// Upper bound of the fastest decay rate [1/s]; sets explicit steps and stage counts.
  virtual double fastest_rate() = 0;
};

}  // namespace peritherm
