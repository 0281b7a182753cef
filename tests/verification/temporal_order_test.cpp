#include <gtest/gtest.h>

#include <algorithm>

#include "support/differences.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// Everything that may change in time does: held ends, flux, surroundings, sources.
Problem changing_plate() {
  Problem problem = unit_body(2, 8, 2.0);
  problem.initial.temperature = Profile("x + cos(pi*y)");
  set_face(problem, Face::x_min, held_at(Profile("sin(5*t) + cos(pi*y)")));
  set_face(problem, Face::x_max, PrescribedFlux{Profile("1 + y*sin(20*t)")});
  set_face(problem, Face::y_max, Convection{2.0, Profile("exp(-4*t)*x")});
  problem.sources.push_back({Profile("30*x*cos(15*t)"), std::nullopt});
  return problem;
}

/// A crack whose tip passes a row of points every 0.0125 s and cuts bonds much more often.
Problem cracking_plate() {
  Problem problem = unit_body(2, 8, 3.0);
  problem.initial.temperature = Profile("y");
  set_face(problem, Face::y_min, held_at(0.0));
  set_face(problem, Face::y_max, held_at(1.0));
  Crack crack;
  crack.points = {{0.1, 0.47}, {0.9, 0.53}};
  crack.tip_speed = 10.0;
  problem.cracks.push_back(crack);
  return problem;
}

/// A plate that is stretched until most of its bonds have broken, at times that differ from place to place.
Problem breaking_plate() {
  Problem problem = unit_body(2, 8, 3.0);
  problem.initial.temperature = Profile("y");
  set_face(problem, Face::y_min, held_at(0.0));
  set_face(problem, Face::y_max, held_at(1.0));
  DamageOptions& damage = problem.damage.emplace();
  damage.critical_elongation = 0.1;
  damage.transmission = 0.1;
  damage.displacement = {Profile("0.3*x*x*t"), Profile("3*t*y*(1 + x + 0.3*sin(7*x + 9*y))")};
  damage.every = 0.01;
  return problem;
}

std::vector<double> solve(Problem problem, const TimeStepping& integrator, double end) {
  problem.time.integrator = integrator;
  March run(std::move(problem));
  run.advance_to(end);
  return run.temperatures();
}

template <class Integrator>
double order_in_the_step(const Problem& problem, double end, const std::vector<int>& step_counts, int reference_steps) {
  const std::vector<double> reference = solve(problem, RungeKutta4{end / reference_steps, 0.9}, end);
  std::vector<double> steps;
  std::vector<double> errors;
  for (const int count : step_counts) {
    steps.push_back(end / count);
    errors.push_back(largest_difference(solve(problem, Integrator{end / count, 0.9}, end), reference));
  }
  return order_of_convergence(steps, errors);
}

TEST(TemporalOrder, forward_euler_is_of_first_order) {
  EXPECT_NEAR(order_in_the_step<ForwardEuler>(changing_plate(), 0.2, {200, 400, 800}, 3200), 1.0, 0.1);
}

TEST(TemporalOrder, the_classical_runge_kutta_method_is_of_fourth_order) {
  EXPECT_NEAR(order_in_the_step<RungeKutta4>(changing_plate(), 0.2, {160, 320, 640}, 2560), 4.0, 0.1);
}

TEST(TemporalOrder, runge_kutta_legendre_is_of_second_order_in_its_mean_step) {
  const double end = 0.2;
  const std::vector<double> reference = solve(changing_plate(), RungeKutta4{end / 1000, 0.9}, end);
  std::vector<double> steps;
  std::vector<double> errors;
  for (const double tolerance : {1e-6, 1e-7, 1e-8, 1e-9}) {
    Problem problem = changing_plate();
    problem.time.integrator = RungeKuttaLegendre{tolerance};
    March run(std::move(problem));
    run.advance_to(end);
    steps.push_back(end / static_cast<double>(run.count().accepted));
    errors.push_back(largest_difference(run.temperatures(), reference));
    // Errors per step add up at most.
    EXPECT_LT(errors.back(), 10.0 * tolerance * static_cast<double>(run.count().accepted));
  }
  // Steps differ along the way, so the mean is a coarser measure than a fixed step.
  EXPECT_NEAR(order_of_convergence(steps, errors), 2.0, 0.2);
}

GeneralisedSingleStep single_steps(double rho, double rho_rate, double step) {
  GeneralisedSingleStep options;
  options.rho_infinity = rho;
  options.rho_infinity_rate = rho_rate;
  options.step = step;
  return options;
}

TEST(TemporalOrder, every_member_of_the_single_step_family_is_of_second_order) {
  const double end = 0.2;
  const std::vector<double> reference = solve(changing_plate(), RungeKutta4{end / 800, 0.9}, end);
  const std::pair<double, double> members[] = {{1.0, 1.0}, {1.0, 0.5}, {1.0, 0.0}, {0.5, 0.5}, {0.5, 0.0}, {0.0, 0.0}};
  for (const auto& [rho, rho_rate] : members) {
    std::vector<double> steps, errors;
    for (const int count : {40, 80, 160}) {
      steps.push_back(end / count);
      const std::vector<double> found = solve(changing_plate(), single_steps(rho, rho_rate, end / count), end);
      errors.push_back(largest_difference(found, reference));
    }
    const double order = order_of_convergence(steps, errors);
    EXPECT_GT(order, 1.9) << rho << ", " << rho_rate;
    EXPECT_LT(order, 2.1) << rho << ", " << rho_rate;
  }
}

TEST(TemporalOrder, single_steps_with_error_control_shrink_errors_with_the_tolerance) {
  const double end = 0.2;
  const std::vector<double> reference = solve(changing_plate(), RungeKutta4{end / 800, 0.9}, end);
  for (const SingleStepMethod method : {SingleStepMethod::midpoint, SingleStepMethod::bdf2}) {
    for (const double tolerance : {1e-3, 1e-5}) {
      Problem problem = changing_plate();
      GeneralisedSingleStep options;
      options.method = method;
      options.relative_tolerance = tolerance;
      problem.time.integrator = options;
      March run(std::move(problem));
      run.advance_to(end);
      const auto [lowest, highest] = std::minmax_element(reference.begin(), reference.end());
      // Errors per step add up at most.
      const double most = tolerance * static_cast<double>(run.count().accepted) * (*highest - *lowest);
      EXPECT_LT(largest_difference(run.temperatures(), reference), most) << name_of(method) << ", " << tolerance;
    }
  }
}

TEST(TemporalOrder, growing_cracks_leave_fixed_steps_at_second_order) {
  // Cuts fall differently into the steps of every refinement, so the order is at least two on the whole only.
  EXPECT_GT(order_in_the_step<RungeKutta4>(cracking_plate(), 0.1, {25, 50, 100, 200}, 20000), 1.8);
}

TEST(TemporalOrder, bonds_that_break_leave_fixed_steps_at_second_order) {
  // As for cracks.
  EXPECT_GT(order_in_the_step<RungeKutta4>(breaking_plate(), 0.1, {25, 50, 100, 200}, 20000), 1.8);
}

TEST(TemporalOrder, growing_cracks_leave_error_control_in_charge) {
  const Problem problem = cracking_plate();
  const double end = 0.1;
  const std::vector<double> reference = solve(problem, RungeKutta4{end / 20000, 0.9}, end);
  std::vector<double> errors;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    errors.push_back(largest_difference(solve(problem, RungeKuttaLegendre{tolerance}, end), reference));
  }
  // Second order: the error falls like tolerance^(2/3), 21 times from one to the next.
  EXPECT_LT(errors[1], errors[0] / 10.0);
  EXPECT_LT(errors[2], errors[1] / 10.0);
}

}  // namespace
}  // namespace peritherm
