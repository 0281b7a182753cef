#pragma once

#include <vector>

#include "peritherm/base/field_storage.hpp"
#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// Solves (I − γ A) x = b, A the part of the rate that is linear in the temperature, by conjugate gradients in the heat
/// product, in which the matrix is symmetric whatever the materials.
class ImplicitHeat {
 public:
  /// `preconditions`: with each point's loss rate.
  ImplicitHeat(ThermalSystem& system, bool preconditions);

  /// `solution`: a guess at first; its entries beside the body are 0. `right` is overwritten. `tolerance`: of the
  /// residual, root mean square over the heat capacity [K]. Heat accounts follow from the temperatures, and what the
  /// residual holds of heat goes to all temperatures alike, so that accounts and heat stored balance to rounding.
  /// Throws Error if the tolerance is out of reach.
  void solve(double gamma, double tolerance, Field right, Field solution);

  /// 1 for entries that hold a point of the body, 0 for others.
  ConstField body() const { return {body_.data(), body_.size()}; }
  long evaluations() const { return evaluations_; }

 private:
  void precondition(double gamma, ConstField residual);
  void apply(double gamma);
  void spread_residual(Field residual, Field solution) const;

  ThermalSystem& system_;
  FieldStorage body_, direction_, image_, preconditioned_;
  std::vector<double> loss_rates_;  ///< [1/s]; empty: not preconditioned
  double capacity_ = 0.0;           ///< Σ C [J/K]
  long evaluations_ = 0;
};

}  // namespace peritherm
