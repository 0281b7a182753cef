#pragma once

#include <sundials/sundials_linearsolver.h>

#include <functional>
#include <vector>

#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// What an implicit step's linear solver needs to know of the system. It outlives the solver.
struct SundialsSystem {
  ThermalSystem& system;
  std::vector<double> body;  ///< 1 for entries that hold a point of the body, 0 for others
  double weight = 0.0;       ///< of errors, the same for all free points [1/K]
  double free_points = 0.0;
  double capacity = 0.0;                  ///< Σ C [J/K]
  std::vector<double> loss_rates;         ///< to precondition with [1/s]; empty: not at all
  std::function<double()> current_gamma;  ///< γ of the step that is being solved [s]
  long evaluations = 0;                   ///< of the linear part
};

/// Conjugate gradients for (I − γ A) x = b, with the sweep that evaluates A fused, in the heat product, in which the
/// matrix is symmetric whatever the materials; N_Vector's plain product would not do. Heat accounts follow from x at
/// the end, so that they balance the heat stored up to what is left of the residual.
SUNLinearSolver make_heat_solver(SundialsSystem& system, SUNContext context);

}  // namespace peritherm
