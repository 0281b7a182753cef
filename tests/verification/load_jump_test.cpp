#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/running_case.hpp"
#include "peritherm/simulation/two_field_assembly.hpp"
#include "peritherm/two_field/two_field_gs4.hpp"
#include "peritherm/two_field/two_field_ida.hpp"
#include "support/differences.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// What jumps stands nowhere near a whole step.
constexpr double jump_time = 0.0537;
constexpr double end_after_jump = 0.2;

/// Two layers with a resistance between them, of which something jumps.
Problem jumping_problem() {
  Problem problem = unit_body(1, 40, 3.0);
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  problem.materials["other"] = {0.25, 2.0, 1.0};
  problem.body.regions.push_back({"other", Box{{0.5}, {1.0}}});
  problem.contacts.push_back({{"body", "other"}, ContactResistance{Profile(0.5)}});
  return problem;
}

std::string from_jump(const std::string& before, const std::string& after) {
  return "t < " + std::to_string(jump_time) + " ? " + before + " : " + after;
}

/// Problems in which held temperature, ambient temperature, flux, source and resistance jump.
std::vector<std::pair<std::string, Problem>> jumping_problems() {
  std::vector<std::pair<std::string, Problem>> all;
  const auto add = [&all](const std::string& name, BoundaryCondition condition) {
    all.emplace_back(name, jumping_problem());
    set_face(all.back().second, Face::x_min, std::move(condition));
  };
  add("held", HeldTemperature{Profile(from_jump("0", "1")), {}, {}});
  add("ambient", Convection{3.0, Profile(from_jump("0", "1"))});
  add("flux", PrescribedFlux{Profile(from_jump("0", "1"))});
  all.emplace_back("source", jumping_problem());
  all.back().second.sources.push_back({Profile(from_jump("x", "3*x")), std::nullopt});
  add("resistance", HeldTemperature{Profile("1 - exp(-30*t)"), {}, {}});
  all.back().second.contacts[0].law = ContactResistance{Profile(from_jump("0.5", "0.05"))};
  return all;
}

struct JumpMarch {
  TwoFieldState state;
  TwoFieldCount count;
  double energy_fault = 0.0;
};

JumpMarch march_over_jump(const Problem& problem, const GeneralisedSingleStep& options) {
  check(problem);
  const TwoFieldAssembly assembly = assemble_two_field(problem);
  JumpMarch march{initial_state(problem, assembly), {}, 0.0};
  TwoFieldGs4 integrator(options, *assembly.system);
  const double before = assembly.system->stored_heat(march.state.temperature);
  const double times[] = {0.02, 0.04, 0.06, end_after_jump};
  EXPECT_EQ(integrator.march(0.0, times, march.state, {}), end_after_jump);
  march.count = integrator.count();
  march.energy_fault = assembly.system->stored_heat(march.state.temperature) - before;
  for (const double heat : march.state.account_heats) march.energy_fault -= heat;
  return march;
}

GeneralisedSingleStep damped_steps(double step) {
  GeneralisedSingleStep options;
  options.rho_infinity = 0.5;
  options.rho_infinity_rate = 0.0;
  options.step = step;
  return options;
}

TEST(LoadJump, in_the_midst_of_a_step_costs_no_order) {
  for (const auto& [name, problem] : jumping_problems()) {
    const TwoFieldState exact = march_over_jump(problem, damped_steps(1e-4)).state;
    std::vector<double> steps, temperatures, fluxes;
    for (const double step : {4e-3, 2e-3, 1e-3}) {
      const JumpMarch found = march_over_jump(problem, damped_steps(step));
      steps.push_back(step);
      temperatures.push_back(largest_difference(found.state.temperature, exact.temperature));
      fluxes.push_back(largest_difference(found.state.multipliers, exact.multipliers));
      // Forty unknowns in each of some hundred steps.
      EXPECT_LT(std::abs(found.energy_fault), 40 * 200 * 1e-16) << name;
      EXPECT_LT(found.count.largest_residual, 1e-12) << name;
    }
    // Steps on both sides of the jump are not halved alike, and those of backward Euler leave something of their own;
    // with a jump within a step errors are of first order.
    EXPECT_GT(order_of_convergence(steps, temperatures), 1.7) << name;
    EXPECT_GT(order_of_convergence(steps, fluxes), 1.7) << name;
  }
}

TEST(LoadJump, in_the_midst_of_a_march_is_the_jump_at_its_start) {
  Problem late = jumping_problem(), first = late;
  set_face(late, Face::x_min, HeldTemperature{Profile(from_jump("0", "1")), {}, {}});
  set_face(first, Face::x_min, HeldTemperature{Profile(1.0), {}, {}});
  const TwoFieldState found = march_over_jump(late, damped_steps(1e-4)).state;
  const TwoFieldAssembly assembly = assemble_two_field(first);
  TwoFieldState exact = initial_state(first, assembly);
  // Behind the jump as many steps as the other march has.
  GeneralisedSingleStep options =
      damped_steps((end_after_jump - jump_time) / std::ceil((end_after_jump - jump_time) / 1e-4));
  const double times[] = {end_after_jump - jump_time};
  TwoFieldGs4(options, *assembly.system).march(0.0, times, exact, {});
  // The time of the jump is known to 1e-12 of the way, rates are some ten per second.
  EXPECT_LT(largest_difference(found.temperature, exact.temperature), 1e-10);
  EXPECT_LT(largest_difference(found.multipliers, exact.multipliers), 1e-9);
}

TEST(LoadJump, is_passed_under_error_control) {
  for (const auto& [name, problem] : jumping_problems()) {
    const TwoFieldState exact = march_over_jump(problem, damped_steps(1e-4)).state;
    GeneralisedSingleStep options;
    options.relative_tolerance = 1e-5;
    const JumpMarch found = march_over_jump(problem, options);
    const auto steps = static_cast<double>(found.count.steps.accepted);
    EXPECT_LT(steps, 600) << name;
    // Errors per step add up at most; the span is 1 or less.
    EXPECT_LT(rms_difference(found.state.temperature, exact.temperature), 1e-5 * steps) << name;
    EXPECT_LT(std::abs(found.energy_fault), 40 * 600 * 1e-16) << name;
  }
}

TEST(LoadJump, loads_that_begin_late_and_without_a_jump_are_passed_too) {
  for (const char* load : {"max(0, t - 0.0537)", "t < 0.05 ? 0 : (t - 0.05)^3", "exp(-((t - 0.0537)/0.004)^2)"}) {
    const bool pulse = load[0] == 'e';
    for (const bool held : {true, false}) {
      if (pulse && held) continue;
      Problem problem = jumping_problem();
      set_face(problem, Face::x_min,
               held ? BoundaryCondition{HeldTemperature{Profile(load), {}, {}}}
                    : BoundaryCondition{PrescribedFlux{Profile(load)}});
      const TwoFieldState exact = march_over_jump(problem, damped_steps(1e-4)).state;
      const JumpMarch found = march_over_jump(problem, {});
      const auto steps = static_cast<double>(found.count.steps.accepted);
      EXPECT_LT(steps, 2000) << load << held;
      const double span = span_of(exact.temperature);
      EXPECT_LT(rms_difference(found.state.temperature, exact.temperature), 1e-5 * steps * span) << load << held;
    }
  }
}

TEST(LoadJump, is_restarted_or_refused_by_ida) {
  const double times[] = {end_after_jump};
  for (const auto& [name, problem] : jumping_problems()) {
    const TwoFieldAssembly assembly = assemble_two_field(problem);
    std::unique_ptr<TwoFieldIntegrator> integrator;
    try {
      integrator = make_two_field_ida({}, *assembly.system);
    } catch (const Error&) {
      GTEST_SKIP() << "sundials";
    }
    TwoFieldState state = initial_state(problem, assembly);
    if (name == "held") {
      try {
        integrator->march(0.0, times, state, {});
        FAIL() << "accepted";
      } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("at t = 0.0537 s, (0, 0, 0) they are off by -1 K"), std::string::npos) << message;
        EXPECT_NE(message.find("choose \"gs4\""), std::string::npos) << message;
      }
      continue;
    }
    EXPECT_EQ(integrator->march(0.0, times, state, {}), end_after_jump) << name;
    const TwoFieldState exact = march_over_jump(problem, damped_steps(1e-4)).state;
    EXPECT_LT(rms_difference(state.temperature, exact.temperature),
              1e-5 * static_cast<double>(integrator->count().steps.accepted))
        << name;
  }
}

}  // namespace
}  // namespace peritherm
