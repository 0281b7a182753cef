#include "peritherm/integrators/sundials_linear_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace peritherm {
namespace {

constexpr int most_linear_iterations = 5000;

struct HeatSolver {
  SundialsSystem& system;
  std::array<N_Vector, 4> work{};  ///< residual, preconditioned residual, direction, its image
  SUNATimesFn multiply = nullptr;
  void* multiply_data = nullptr;
  SUNPSolveFn precondition = nullptr;
  void* precondition_data = nullptr;
  int iterations = 0;
  double residual = 0.0;

  std::size_t size() const { return system.system.size(); }
  Field values(N_Vector vector) const { return {N_VGetArrayPointer(vector), size()}; }
  double product(N_Vector a, N_Vector b) const { return system.system.heat_product(values(a), values(b)); }
  /// In the measure of the integrator's tolerance: Σ over free points of (weight · value)², as a root.
  double norm_of(double square) const {
    return system.weight * std::sqrt(square * system.free_points / system.capacity);
  }
};

HeatSolver& content(SUNLinearSolver solver) { return *static_cast<HeatSolver*>(solver->content); }

SUNLinearSolver_Type type_of_solver(SUNLinearSolver) { return SUNLINEARSOLVER_ITERATIVE; }
SUNLinearSolver_ID id_of_solver(SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; }
int set_multiply(SUNLinearSolver solver, void* data, SUNATimesFn multiply) {
  content(solver).multiply = multiply;
  content(solver).multiply_data = data;
  return SUNLS_SUCCESS;
}
int set_precondition(SUNLinearSolver solver, void* data, SUNPSetupFn, SUNPSolveFn precondition) {
  content(solver).precondition = precondition;
  content(solver).precondition_data = data;
  return SUNLS_SUCCESS;
}
/// The weights are known; with scaling at hand, SUNDIALS states its tolerance in terms of them.
int ignore_scaling(SUNLinearSolver, N_Vector, N_Vector) { return SUNLS_SUCCESS; }
int count_of_iterations(SUNLinearSolver solver) { return content(solver).iterations; }
double norm_of_residual(SUNLinearSolver solver) { return content(solver).residual; }
int do_nothing(SUNLinearSolver) { return SUNLS_SUCCESS; }
int set_up_nothing(SUNLinearSolver, SUNMatrix) { return SUNLS_SUCCESS; }

int free_solver(SUNLinearSolver solver) {
  for (const N_Vector vector : content(solver).work) N_VDestroy(vector);
  delete &content(solver);
  solver->content = nullptr;
  SUNLinSolFreeEmpty(solver);
  return SUNLS_SUCCESS;
}

/// preconditioned = P⁻¹ residual, 0 outside of the body and for the accounts.
int apply_preconditioner(HeatSolver& own, double tolerance) {
  const auto [r, z, p, q] = own.work;
  if (own.precondition != nullptr && own.precondition(own.precondition_data, r, z, tolerance, 1) != 0) {
    return SUNLS_PSOLVE_FAIL_UNREC;
  }
  const Field from = own.values(own.precondition != nullptr ? z : r), to = own.values(z);
  const auto count = static_cast<std::ptrdiff_t>(own.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) to[n] = own.system.body[n] * from[n];
  return SUNLS_SUCCESS;
}

void move_along(HeatSolver& own, double length, N_Vector solution) {
  const auto [r, z, p, q] = own.work;
  const Field x = own.values(solution), residual = own.values(r), direction = own.values(p), image = own.values(q);
  const auto count = static_cast<std::ptrdiff_t>(own.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    x[n] += length * own.system.body[n] * direction[n];
    residual[n] -= length * image[n];
  }
}

/// Accounts stand in their own rows as 1, so what is left of their residual is what they lack.
void complete_accounts(HeatSolver& own, N_Vector solution) {
  const Field x = own.values(solution), residual = own.values(own.work[0]);
  for (std::size_t n = own.system.system.field_size(); n < own.size(); ++n) x[n] += residual[n];
}

int solve_for_step(SUNLinearSolver solver, SUNMatrix, N_Vector solution, N_Vector right, double tolerance) {
  HeatSolver& own = content(solver);
  const auto [r, z, p, q] = own.work;
  own.iterations = 0;
  N_VConst(0.0, solution);
  N_VScale(1.0, right, r);
  double before = 0.0;
  const double start = own.norm_of(own.product(r, r));
  for (own.residual = start; own.residual > tolerance; ++own.iterations) {
    if (own.iterations == most_linear_iterations || !std::isfinite(own.residual)) break;
    if (apply_preconditioner(own, tolerance) != SUNLS_SUCCESS) return SUNLS_PSOLVE_FAIL_UNREC;
    const double square = own.product(r, z);
    N_VLinearSum(1.0, z, own.iterations == 0 ? 0.0 : square / before, p, p);
    before = square;
    if (own.multiply(own.multiply_data, p, q) != 0) return SUNLS_ATIMES_FAIL_UNREC;
    const double curvature = own.product(p, q);
    if (!(curvature > 0.0)) break;
    move_along(own, square / curvature, solution);
    own.residual = own.norm_of(own.product(r, r));
  }
  complete_accounts(own, solution);
  if (own.residual <= tolerance) return SUNLS_SUCCESS;
  return own.residual < start ? SUNLS_RES_REDUCED : SUNLS_CONV_FAIL;
}

}  // namespace

SUNLinearSolver make_heat_solver(SundialsSystem& system, N_Vector like, SUNContext context) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  auto* own = new HeatSolver{system};
  for (N_Vector& vector : own->work) {
    vector = N_VClone(like);
    N_VConst(0.0, vector);
  }
  solver->content = own;
  solver->ops->gettype = type_of_solver;
  solver->ops->getid = id_of_solver;
  solver->ops->setatimes = set_multiply;
  solver->ops->setpreconditioner = set_precondition;
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
