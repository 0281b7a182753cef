#pragma once

#include <sundials/sundials_linearsolver.h>

#include <vector>

#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// What an implicit step's linear solver needs to know of the system. It outlives the solver.
struct SundialsSystem {
  ThermalSystem& system;
  std::vector<double> body;  ///< 1 for entries that hold a point of the body, 0 for others
  double weight = 0.0;       ///< of errors, the same for all free points [1/K]
  double free_points = 0.0;
  double capacity = 0.0;  ///< Σ C [J/K]
};

/// Conjugate gradients for (I − γ A) x = b in the heat product, in which the matrix is symmetric whatever the
/// materials; N_Vector's plain product would not do. Heat accounts follow from x at the end, so that they balance the
/// heat stored up to what is left of the residual.
SUNLinearSolver make_heat_solver(SundialsSystem& system, N_Vector like, SUNContext context);

}  // namespace peritherm
