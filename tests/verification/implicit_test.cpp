#include <gtest/gtest.h>

#include "peritherm/base/error.hpp"
#include "support/differences.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

/// Everything that may change in time does, in two materials of different conductivity and heat capacity.
Problem changing_body(int dimension) {
  Problem problem = unit_body(dimension, dimension == 1 ? 40 : 12, 2.5);
  problem.materials["good"] = {20.0, 4.0, 2.0};
  Coordinates low(static_cast<std::size_t>(dimension), 0.25), high(static_cast<std::size_t>(dimension), 0.6);
  problem.body.regions = {{"good", Box{low, high}}};
  problem.initial.temperature = Profile("x + cos(pi*x)");
  set_face(problem, Face::x_min, held_at(Profile("1 + sin(5*t)")));
  if (dimension == 1) {
    set_face(problem, Face::x_max, Convection{2.0, Profile("exp(-4*t)")});
  } else {
    set_face(problem, Face::x_max, PrescribedFlux{Profile("1 + y*sin(20*t)")});
    set_face(problem, Face::y_max, Convection{2.0, Profile("exp(-4*t)*x")});
  }
  problem.sources.push_back({Profile("30*x*cos(15*t)"), std::nullopt});
  return problem;
}

constexpr double end_of_run = 0.2;

template <class Options>
Options with_tolerance(double tolerance) {
  Options options;
  options.relative_tolerance = tolerance;
  return options;
}

std::vector<double> reference(Problem problem) {
  problem.time.integrator = RungeKutta4{std::nullopt, 0.5};
  March run(std::move(problem));
  run.advance_to(end_of_run);
  return run.temperatures();
}

/// Both implicit integrators; skipped in builds without SUNDIALS.
template <class Options>
class Implicit : public testing::Test {
 protected:
  void SetUp() override {
    const Assembly assembly = assemble(unit_body(1, 8, 2.0));
    try {
      make_integrator(Options{}, *assembly.system);
    } catch (const Error& error) {
      ASSERT_NE(std::string(error.what()).find("needs SUNDIALS"), std::string::npos);
      GTEST_SKIP() << "sundials";
    }
  }
};

using ImplicitIntegrators = testing::Types<BackwardDifferences, ImplicitRungeKutta>;
TYPED_TEST_SUITE(Implicit, ImplicitIntegrators);

TYPED_TEST(Implicit, errors_per_step_add_up_at_most_and_shrink_with_the_tolerance) {
  for (const int dimension : {1, 2}) {
    const std::vector<double> expected = reference(changing_body(dimension));
    for (const auto preconditioner : {ImplicitPreconditioner::none, ImplicitPreconditioner::jacobi}) {
      std::vector<double> tolerances, errors;
      for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
        TypeParam options = with_tolerance<TypeParam>(tolerance);
        options.preconditioner = preconditioner;
        Problem problem = changing_body(dimension);
        problem.time.integrator = options;
        March run(std::move(problem));
        run.advance_to(end_of_run);
        tolerances.push_back(tolerance);
        errors.push_back(rms_difference(run.temperatures(), expected));
        // The span grows along the way; that at the end stands for it.
        EXPECT_LT(errors.back(), tolerance * static_cast<double>(run.count().accepted) * span_of(expected))
            << dimension << ", " << tolerance;
      }
      EXPECT_GT(order_of_convergence(tolerances, errors), 0.5) << dimension;
    }
  }
}

TYPED_TEST(Implicit, every_order_keeps_the_tolerance) {
  const std::vector<double> expected = reference(changing_body(1));
  for (int order = 2; order <= 5; ++order) {
    TypeParam options = with_tolerance<TypeParam>(1e-5);
    options.order = order;
    Problem problem = changing_body(1);
    problem.time.integrator = options;
    March run(std::move(problem));
    run.advance_to(end_of_run);
    const double allowed = 1e-5 * static_cast<double>(run.count().accepted) * span_of(expected);
    EXPECT_LT(rms_difference(run.temperatures(), expected), allowed) << order;
  }
}

TYPED_TEST(Implicit, output_times_do_not_disturb) {
  Problem problem = changing_body(2);
  problem.time.integrator = with_tolerance<TypeParam>(1e-6);
  March once(problem), often(problem);
  once.advance_to(end_of_run);
  for (int k = 1; k <= 10; ++k) often.advance_to(end_of_run * k / 10);
  const double steps = static_cast<double>(once.count().accepted + often.count().accepted);
  EXPECT_LT(rms_difference(once.temperatures(), often.temperatures()), 1e-6 * steps * span_of(once.temperatures()));
}

TYPED_TEST(Implicit, heat_balances_to_the_tolerance) {
  Problem problem = changing_body(2);
  problem.time.integrator = with_tolerance<TypeParam>(1e-7);
  const Assembly assembly = assemble(problem);
  auto state = initial_state(problem, assembly);
  const double before = assembly.system->stored_heat(state);
  const auto integrator = make_integrator(problem.time.integrator, *assembly.system);
  integrator->advance(0.0, end_of_run, state, [](double, ConstField) { return true; });
  double heats = 0.0;
  for (const double heat : assembly.system->account_heats(state)) heats += heat;
  const std::vector<double> ones(state.size(), 1.0);
  const double capacity = assembly.system->stored_heat(ones);
  const auto steps = static_cast<double>(integrator->count().accepted);
  const auto [lowest, highest] = assembly.system->extremes(state);
  EXPECT_NEAR(assembly.system->stored_heat(state) - before, heats, 1e-7 * steps * capacity * (highest - lowest));
}

TYPED_TEST(Implicit, a_long_run_takes_few_evaluations) {
  Problem problem = unit_body(1, 64, 3.0);
  set_face(problem, Face::x_min, held_at(1.0));
  problem.time.integrator = with_tolerance<TypeParam>(1e-4);
  March run(problem);
  run.advance_to(1000.0);
  for (const double value : run.temperatures()) EXPECT_NEAR(value, 1.0, 1e-2);
  // Forward Euler would need half the fastest rate times 1000 s.
  EXPECT_LT(static_cast<double>(run.count().evaluations), 1e-2 * 500.0 * run.assembly().system->fastest_rate());
}

TYPED_TEST(Implicit, a_body_at_one_temperature_rests) {
  Problem problem = unit_body(2, 10, 2.5);
  problem.initial.temperature = 300.0;
  set_face(problem, Face::y_min, held_at(300.0));
  problem.time.integrator = with_tolerance<TypeParam>(1e-5);
  March run(problem);
  run.advance_to(1.0);
  const auto evaluations = static_cast<std::size_t>(run.count().evaluations);
  for (const double value : run.temperatures()) EXPECT_NEAR(value, 300.0, rounding(30 * evaluations, 300.0));
}

TYPED_TEST(Implicit, growing_cracks_are_refused) {
  Problem problem = unit_body(2, 12, 2.5);
  Crack crack;
  crack.points = {{0.1, 0.5}, {0.9, 0.5}};
  crack.tip_speed = 0.5;
  problem.cracks.push_back(crack);
  problem.time.integrator = TypeParam{};
  const std::vector<Issue> issues = find_faults(problem);
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].where.key, "crack.0.tip_speed");
  EXPECT_NE(issues[0].hint.find("rkl2"), std::string::npos);
  const Assembly assembly = assemble(problem);
  auto state = initial_state(problem, assembly);
  const auto integrator = make_integrator(problem.time.integrator, *assembly.system);
  EXPECT_THROW(integrator->advance(0.0, 1.0, state, [](double, ConstField) { return true; }), Error);
}

TYPED_TEST(Implicit, bonds_that_break_are_refused_before_the_march) {
  Problem problem = unit_body(1, 12, 2.5);
  DamageOptions& damage = problem.damage.emplace();
  damage.critical_elongation = 0.1;
  damage.displacement = {Profile("0.2*x*t")};
  damage.every = 0.1;
  const Assembly assembly = assemble(problem);
  const std::vector<double> before{0.4}, after{0.4, 1.0};
  choose_stepping(TypeParam{}, *assembly.system, 0.0, before);
  EXPECT_THROW(choose_stepping(TypeParam{}, *assembly.system, 0.0, after), Error);
}

TYPED_TEST(Implicit, loads_that_are_not_finite_are_named) {
  Problem problem = unit_body(1, 12, 2.5);
  problem.sources.push_back({Profile("1/(t < 0.1)"), std::nullopt});
  problem.time.integrator = TypeParam{};
  March run(problem);
  try {
    run.advance_to(1.0);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::numerics);
    EXPECT_NE(std::string(error.what()).find("finite"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace peritherm
