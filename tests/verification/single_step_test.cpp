#include <gtest/gtest.h>

#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/gs4_parameters.hpp"
#include "support/differences.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// Two points of equal temperature that exchange heat with surroundings at 0: h = 2 in series with half a cell of
/// conductance 4, over half a cell's capacity of 1/2.
constexpr double exchange = 2.0;
constexpr double single_rate = 1.0 / (1.0 / exchange + 1.0 / 4.0) / 0.5;

Problem single_point(SingleStepMethod method, double step) {
  Problem problem = unit_body(1, 2, 1.0);
  problem.initial.temperature = 1.0;
  set_face(problem, Face::x_min, Convection{exchange, Profile(0.0)});
  set_face(problem, Face::x_max, Convection{exchange, Profile(0.0)});
  GeneralisedSingleStep options;
  options.method = method;
  options.step = step;
  options.start = SingleStepStart::consistent;
  problem.time.integrator = options;
  return problem;
}

std::vector<double> course(const Problem& problem, int steps, double step) {
  March run(problem);
  std::vector<double> values{1.0};
  for (int n = 1; n <= steps; ++n) {
    run.advance_to(n * step);
    values.push_back(run.temperatures()[0]);
  }
  return values;
}

TEST(SingleStep, with_both_numbers_one_is_crank_nicolson) {
  const double step = 0.05, ratio = (1.0 - 0.5 * single_rate * step) / (1.0 + 0.5 * single_rate * step);
  const std::vector<double> values = course(single_point(SingleStepMethod::crank_nicolson, step), 8, step);
  for (std::size_t n = 0; n < values.size(); ++n) {
    EXPECT_NEAR(values[n], std::pow(ratio, static_cast<double>(n)), 1e-13) << n;
  }
}

TEST(SingleStep, midpoint_leaves_temperatures_as_crank_nicolson_does) {
  const double step = 0.05;
  const std::vector<double> values = course(single_point(SingleStepMethod::midpoint, step), 8, step);
  const std::vector<double> expected = course(single_point(SingleStepMethod::crank_nicolson, step), 8, step);
  EXPECT_LT(largest_difference(values, expected), 1e-13);
}

TEST(SingleStep, with_both_numbers_zero_is_bdf2) {
  const double step = 0.05;
  const std::vector<double> values = course(single_point(SingleStepMethod::bdf2, step), 8, step);
  for (std::size_t n = 2; n < values.size(); ++n) {
    const double rate = (1.5 * values[n] - 2.0 * values[n - 1] + 0.5 * values[n - 2]) / step;
    EXPECT_NEAR(rate, -single_rate * values[n], 1e-12) << n;
  }
}

TEST(SingleStep, error_constants_are_those_of_the_known_members) {
  EXPECT_NEAR(gs4_parameters(1.0, 1.0).error_constant(), 1.0 / 12.0, 1e-15);
  EXPECT_NEAR(gs4_parameters(1.0, 0.0).error_constant(), 1.0 / 12.0, 1e-15);
  EXPECT_NEAR(gs4_parameters(0.5, 0.0).error_constant(), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(gs4_parameters(0.0, 0.0).error_constant(), 1.0 / 3.0, 1e-15);
}

TEST(SingleStep, refuses_numbers_that_contradict_each_other) {
  const auto fault = [](std::optional<SingleStepMethod> method, std::optional<double> rho, std::optional<double> rate) {
    GeneralisedSingleStep options;
    options.method = method;
    options.rho_infinity = rho;
    options.rho_infinity_rate = rate;
    return find_fault(options).where.key;
  };
  EXPECT_EQ(fault({}, {}, {}), "");
  EXPECT_EQ(fault({}, 0.5, {}), "");
  EXPECT_EQ(fault({}, 0.5, 0.6), "time.integrator.rho_infinity_rate");
  EXPECT_EQ(fault({}, {}, 0.6), "time.integrator.rho_infinity");
  EXPECT_EQ(fault(SingleStepMethod::bdf2, 0.5, {}), "time.integrator.rho_infinity");
  EXPECT_EQ(fault(SingleStepMethod::generalised_alpha, {}, {}), "time.integrator.rho_infinity");
  EXPECT_EQ(fault(SingleStepMethod::custom, 0.5, {}), "time.integrator.rho_infinity_rate");
}

TEST(SingleStep, start_values_that_jump_are_damped) {
  Problem problem = unit_body(1, 40, 3.0);
  set_face(problem, Face::x_min, held_at(1.0));
  GeneralisedSingleStep options;
  options.step = 0.002;  // 240 times the fastest decay
  problem.time.integrator = options;
  March run(problem);
  run.advance_to(0.1);
  problem.time.integrator = RungeKutta4{};
  March exact(problem);
  exact.advance_to(0.1);
  EXPECT_LT(largest_difference(run.temperatures(), exact.temperatures()), 1e-4);
}

TEST(SingleStep, heat_balances_to_rounding) {
  Problem problem = unit_body(2, 8, 2.5);
  problem.initial.temperature = Profile("x*y");
  set_face(problem, Face::x_min, held_at(Profile("sin(5*t)")));
  set_face(problem, Face::y_max, PrescribedFlux{Profile("1 + x*sin(20*t)")});
  for (const std::optional<double> step : {std::optional<double>(0.01), std::optional<double>()}) {
    GeneralisedSingleStep options;
    options.step = step;
    problem.time.integrator = options;
    March run(problem);
    const double before = run.stored_heat();
    run.advance_to(0.2);
    double heats = 0.0;
    for (const double heat : run.heats()) heats += heat;
    EXPECT_NEAR(run.stored_heat() - before, heats, 1e-12);
  }
}

TEST(SingleStep, one_field_is_no_matter_for_ida) {
  const Assembly assembly = assemble(unit_body(1, 8, 2.0));
  try {
    make_integrator(DifferentialAlgebraic{}, *assembly.system);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("cvode"), std::string::npos);
  }
}

}  // namespace
}  // namespace peritherm
