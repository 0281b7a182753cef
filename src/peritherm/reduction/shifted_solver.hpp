#pragma once

#include "peritherm/base/field_storage.hpp"
#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// What a search came to. Sizes are those of the solution.
struct ShiftedSolution {
  double energy = 0.0;  ///< (Σ C x (shift + A) x)^½
  double error = 0.0;   ///< its estimated error in the same measure
  long iterations = 0;
  bool converged = false;
};

/// Conjugate gradients [hestenes1952] for (shift + A) x = b in the heat product, A = minus the linear part of the rate.
/// One evaluation per iteration, and three passes over what it makes.
class ShiftedSolver {
 public:
  /// `capacities`: as long as a state, 0 where nothing is free.
  ShiftedSolver(ThermalSystem& system, ConstField capacities);

  /// `residual`: b, of which the search leaves what remains; `solution` is overwritten. Ends when the estimated error
  /// is below `reduction` of the solution, both in energy, or after so many iterations.
  ShiftedSolution solve(double shift, double reduction, long most_iterations, Field residual, Field solution);

  /// Σ C a b, the same bits for any number of threads.
  double product(ConstField a, ConstField b) const;

  long evaluations() const { return evaluations_; }
  std::size_t bytes() const { return (direction_.size() + image_.size()) * sizeof(double); }

 private:
  double step(double length, Field residual, Field solution);
  void turn(double share, ConstField residual);

  ThermalSystem& system_;
  ConstField capacities_;
  FieldStorage direction_, image_;
  long evaluations_ = 0;
};

}  // namespace peritherm
