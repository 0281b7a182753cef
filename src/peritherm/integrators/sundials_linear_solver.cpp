#include "peritherm/integrators/sundials_linear_solver.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

constexpr int most_linear_iterations = 5000;

struct HeatSolver {
  SundialsSystem& system;
  std::vector<double> residual, preconditioned, direction, image;
  int iterations = 0;
  double norm = 0.0;

  double product(ConstField a, ConstField b) const { return system.system.heat_product(a, b); }
  /// In the measure of the integrator's tolerance: Σ over free points of (weight · value)², as a root.
  double norm_of(double square) const {
    return system.weight * std::sqrt(square * system.free_points / system.capacity);
  }
};

HeatSolver& content(SUNLinearSolver solver) { return *static_cast<HeatSolver*>(solver->content); }

SUNLinearSolver_Type type_of_solver(SUNLinearSolver) { return SUNLINEARSOLVER_ITERATIVE; }
SUNLinearSolver_ID id_of_solver(SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; }
/// The solver evaluates by itself; SUNDIALS asks for these of every solver that iterates.
int ignore_multiply(SUNLinearSolver, void*, SUNATimesFn) { return SUNLS_SUCCESS; }
int ignore_scaling(SUNLinearSolver, N_Vector, N_Vector) { return SUNLS_SUCCESS; }
int count_of_iterations(SUNLinearSolver solver) { return content(solver).iterations; }
double norm_of_residual(SUNLinearSolver solver) { return content(solver).norm; }
int do_nothing(SUNLinearSolver) { return SUNLS_SUCCESS; }
int set_up_nothing(SUNLinearSolver, SUNMatrix) { return SUNLS_SUCCESS; }

int free_solver(SUNLinearSolver solver) {
  delete &content(solver);
  solver->content = nullptr;
  SUNLinSolFreeEmpty(solver);
  return SUNLS_SUCCESS;
}

/// preconditioned = residual / (1 + γ · loss rate); 0 outside of the body and for the accounts.
void precondition(HeatSolver& own, double gamma) {
  const auto count = static_cast<std::ptrdiff_t>(own.residual.size());
  const double* const body = own.system.body.data();
  const double* const loss_rates = own.system.loss_rates.data();
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    own.preconditioned[n] = body[n] * own.residual[n] / (1.0 + gamma * loss_rates[n]);
  }
}

/// direction = values + share · direction, within the body.
void turn(HeatSolver& own, ConstField values, double share) {
  const auto count = static_cast<std::ptrdiff_t>(values.size());
  const double* const body = own.system.body.data();
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) own.direction[n] = body[n] * (values[n] + share * own.direction[n]);
}

void move_along(HeatSolver& own, double length, Field solution) {
  const auto count = static_cast<std::ptrdiff_t>(solution.size());
  const double* const body = own.system.body.data();
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    solution[n] += length * body[n] * own.direction[n];
    own.residual[n] -= length * own.image[n];
  }
}

/// Accounts stand in their own rows as 1, so what is left of their residual is what they lack.
void complete_accounts(const HeatSolver& own, Field solution) {
  for (std::size_t n = own.system.system.field_size(); n < solution.size(); ++n) solution[n] += own.residual[n];
}

int solve_for_step(SUNLinearSolver solver, SUNMatrix, N_Vector result, N_Vector right, double tolerance) {
  HeatSolver& own = content(solver);
  const Field solution(N_VGetArrayPointer(result), own.residual.size());
  const double gamma = own.system.current_gamma();
  const bool preconditions = !own.system.loss_rates.empty();
  std::fill(solution.begin(), solution.end(), 0.0);
  std::copy_n(N_VGetArrayPointer(right), own.residual.size(), own.residual.begin());
  double plain = own.product(own.residual, own.residual), before = 0.0;
  const double start = own.norm_of(plain);
  own.norm = start;
  for (own.iterations = 0; own.norm > tolerance; ++own.iterations) {
    if (own.iterations == most_linear_iterations || !std::isfinite(own.norm)) break;
    if (preconditions) precondition(own, gamma);
    const std::vector<double>& values = preconditions ? own.preconditioned : own.residual;
    const double square = preconditions ? own.product(own.residual, values) : plain;
    turn(own, values, own.iterations == 0 ? 0.0 : square / before);
    before = square;
    const Term itself[] = {{1.0, own.direction.data()}};
    own.system.system.combine_linear(-1, own.direction, -gamma, itself, own.image);
    ++own.system.evaluations;
    const double curvature = own.product(own.direction, own.image);
    if (!(curvature > 0.0)) break;
    move_along(own, square / curvature, solution);
    plain = own.product(own.residual, own.residual);
    own.norm = own.norm_of(plain);
  }
  complete_accounts(own, solution);
  if (own.norm <= tolerance) return SUNLS_SUCCESS;
  return own.norm < start ? SUNLS_RES_REDUCED : SUNLS_CONV_FAIL;
}

}  // namespace

SUNLinearSolver make_heat_solver(SundialsSystem& system, SUNContext context) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  const std::vector<double> zeros(system.system.size(), 0.0);
  solver->content = new HeatSolver{system, zeros, zeros, zeros, zeros};
  solver->ops->gettype = type_of_solver;
  solver->ops->getid = id_of_solver;
  solver->ops->setatimes = ignore_multiply;
  solver->ops->setscalingvectors = ignore_scaling;
  solver->ops->initialize = do_nothing;
  solver->ops->setup = set_up_nothing;
  solver->ops->solve = solve_for_step;
  solver->ops->numiters = count_of_iterations;
  solver->ops->resnorm = norm_of_residual;
  solver->ops->free = free_solver;
  return solver;
}

}  // namespace peritherm
