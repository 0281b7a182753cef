#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "peritherm/base/larger.hpp"
#include "peritherm/simulation/two_field_assembly.hpp"
#include "peritherm/two_field/two_field_gs4.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// A square or cube with two fields in each part.
Problem touching_box(int dimension, int cells, double ratio) {
  Problem problem = unit_body(dimension, cells, ratio);
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  return problem;
}

void add_part(Problem& problem, const std::string& material, const Coordinates& from, const Coordinates& to,
              double conductivity) {
  problem.materials[material] = {conductivity, 2.0, 1.0};
  problem.body.regions.push_back({material, Box{from, to}});
}

void hold_all_faces(Problem& problem, const std::string& temperature) {
  set_all_faces(problem, HeldTemperature{Profile(temperature), {}, {}});
}

/// A problem's system with temperatures by place, marched by BDF2, which leaves nothing of fast decays.
struct TouchingMarch {
  TwoFieldAssembly assembly;
  TwoFieldState state;
  std::vector<Point> places;
  double stored_before = 0.0;
  TwoFieldCount count{};

  TouchingMarch(const Problem& problem, const std::function<double(const Point&)>& start)
      : assembly((check(problem), assemble_two_field(problem))), state(assembly.system->make_state()) {
    for (const SubDomain& part : assembly.body.parts) {
      places.insert(places.end(), part.positions.begin(), part.positions.end());
    }
    for (std::size_t n = 0; n < places.size(); ++n) state.temperature[n] = start(places[n]);
    stored_before = assembly.system->stored_heat(state.temperature);
  }

  void march(double step, int steps) {
    GeneralisedSingleStep options;
    options.method = SingleStepMethod::bdf2;
    options.step = step;
    TwoFieldGs4 integrator(options, *assembly.system);
    const double times[] = {step * steps};
    integrator.march(0.0, times, state, {});
    count = integrator.count();
  }

  double error(const std::function<double(const Point&)>& exact) const {
    double largest = 0.0;
    for (std::size_t n = 0; n < places.size(); ++n) {
      largest = larger(largest, std::abs(state.temperature[n] - exact(places[n])));
    }
    return largest;
  }

  double energy_fault() const {
    double entered = 0.0;
    for (const double heat : state.account_heats) entered += heat;
    return assembly.system->stored_heat(state.temperature) - stored_before - entered;
  }
};

const auto at_rest = [](const Point&) { return 0.0; };

/// What changes slowest decays with about 2.5 per second: after so many steps a march is steady to rounding. Longer
/// steps come near to the singular matrix of an insulated part.
constexpr double steady_step = 1.0;
constexpr int steady_steps = 40;
/// The notes' for linear fields; the system has some hundred rows.
constexpr double linear_tolerance = 1e-12;

TEST(TouchingParts, a_cube_held_all_around_keeps_a_linear_temperature_and_finds_it) {
  Problem problem = touching_box(3, 10, 3.0);
  hold_all_faces(problem, "1 + 0.7*x - 1.3*y + 0.4*z");
  const auto linear = [](const Point& x) { return 1.0 + 0.7 * x[0] - 1.3 * x[1] + 0.4 * x[2]; };
  TouchingMarch kept(problem, linear);
  EXPECT_EQ(kept.assembly.system->multipliers(), 1000U - 512U) << "one for each cell at the surface";
  kept.march(0.01, 3);
  EXPECT_LT(kept.error(linear), linear_tolerance);
  EXPECT_LT(kept.count.largest_residual, linear_tolerance);
  TouchingMarch found(problem, at_rest);
  found.march(steady_step, steady_steps);
  EXPECT_LT(found.error(linear), linear_tolerance);
}

/// Two halves of a cube in contact, 0 and 1 at the ends; the flux and what is left at the contact.
struct HalvedCube {
  double resistance;
  double flux() const { return 1.0 / (0.5 / 1.0 + resistance + 0.5 / 0.25); }  ///< against x
  double temperature(const Point& x) const { return x[0] < 0.5 ? flux() * x[0] : 1.0 - flux() / 0.25 * (1.0 - x[0]); }
};

Problem halved_problem(double resistance) {
  Problem problem = touching_box(3, 8, 1.5);
  add_part(problem, "other", {0.5, 0.0, 0.0}, {1.0, 1.0, 1.0}, 0.25);
  problem.contacts.push_back({{"body", "other"}, ContactResistance{Profile(resistance)}});
  return problem;
}

TEST(TouchingParts, halves_of_a_cube_have_the_jump_of_their_resistance) {
  for (const double resistance : {0.0, 0.5}) {
    Problem problem = halved_problem(resistance);
    set_face(problem, Face::x_min, HeldTemperature{Profile(0.0), {}, {}});
    set_face(problem, Face::x_max, HeldTemperature{Profile(1.0), {}, {}});
    const HalvedCube exact{resistance};
    TouchingMarch march(problem, at_rest);
    march.march(steady_step, steady_steps);
    EXPECT_LT(march.error([&](const Point& x) { return exact.temperature(x); }), linear_tolerance) << resistance;
    EXPECT_LT(march.count.largest_residual, linear_tolerance);
    ASSERT_EQ(march.assembly.interfaces.size(), 1U);
    const Interface& contact = march.assembly.interfaces.front();
    ASSERT_EQ(contact.rows.size(), 64U);
    for (std::size_t k = 0; k < contact.rows.size(); ++k) {
      EXPECT_NEAR(contact.directions[k] * march.state.multipliers[contact.rows[k]], -exact.flux(), 1e-10) << resistance;
    }
  }
}

TEST(TouchingParts, a_contact_may_end_at_held_faces) {
  for (const double resistance : {0.0, 0.5}) {
    const HalvedCube exact{resistance};
    Problem problem = halved_problem(resistance);
    const std::string flux = fmt::format("{:.17g}", exact.flux());
    for (const Face face : {Face::y_min, Face::y_max}) {
      set_face(problem, face,
               HeldTemperature{Profile("x < 0.5 ? " + flux + "*x : 1 - 4*" + flux + "*(1 - x)"), {}, {}});
    }
    set_face(problem, Face::x_min, PrescribedFlux{Profile(-exact.flux())});
    set_face(problem, Face::x_max, PrescribedFlux{Profile(exact.flux())});
    TouchingMarch march(problem, at_rest);
    march.march(steady_step, steady_steps);
    EXPECT_LT(march.error([&](const Point& x) { return exact.temperature(x); }), linear_tolerance) << resistance;
    EXPECT_LT(march.count.largest_residual, linear_tolerance) << resistance;
  }
}

/// A left part, and two on the right that touch each other: three interfaces meet in the middle.
Problem junction(double resistance, const std::array<double, 3>& conductivities) {
  Problem problem = touching_box(2, 16, 2.0);
  problem.materials["body"].conductivity = conductivities[0];
  add_part(problem, "below", {0.5, 0.0}, {1.0, 0.5}, conductivities[1]);
  add_part(problem, "above", {0.5, 0.5}, {1.0, 1.0}, conductivities[2]);
  problem.contacts.push_back({{"body", "below"}, ContactResistance{Profile(resistance)}});
  problem.contacts.push_back({{"body", "above"}, ContactResistance{Profile(2.0 * resistance)}});
  problem.contacts.push_back({{"below", "above"}, ContactResistance{Profile(0.5 * resistance)}});
  return problem;
}

TEST(TouchingParts, three_that_meet_in_a_corner_keep_a_linear_temperature) {
  Problem problem = junction(0.0, {1.0, 1.0, 1.0});
  hold_all_faces(problem, "1 + 0.7*x - 1.3*y");
  const auto linear = [](const Point& x) { return 1.0 + 0.7 * x[0] - 1.3 * x[1]; };
  TouchingMarch kept(problem, linear);
  ASSERT_EQ(kept.assembly.body.parts.size(), 3U);
  ASSERT_EQ(kept.assembly.interfaces.size(), 3U);
  kept.march(0.01, 5);
  EXPECT_LT(kept.error(linear), linear_tolerance);
  EXPECT_LT(kept.count.largest_residual, linear_tolerance);
  TouchingMarch found(problem, at_rest);
  found.march(steady_step, steady_steps);
  EXPECT_LT(found.error(linear), linear_tolerance);
}

TEST(TouchingParts, three_that_meet_in_a_corner_keep_their_heat) {
  for (const double resistance : {0.0, 0.5}) {
    for (const bool relaxes : {false, true}) {
      Problem problem = junction(resistance, {1.0, 0.25, 4.0});
      if (relaxes) {
        problem.materials["below"].flux_law = CattaneoLaw{0.1};
        problem.materials["above"].flux_law = JeffreysLaw{0.2, 0.3};
      }
      TouchingMarch march(problem, [](const Point& x) { return x[0] < 0.5 ? 1.0 : (x[1] < 0.5 ? 0.2 : 3.0 * x[0]); });
      march.march(0.005, 40);
      EXPECT_LT(std::abs(march.energy_fault()), 1e-11 * march.stored_before) << resistance;
      EXPECT_LT(march.count.largest_residual, linear_tolerance) << resistance;
    }
  }
}

TEST(TouchingParts, three_that_meet_in_a_corner_balance_what_enters) {
  Problem problem = junction(0.5, {1.0, 0.25, 4.0});
  set_face(problem, Face::x_min, HeldTemperature{Profile("1 - exp(-10*t)"), {}, {}});
  set_face(problem, Face::y_max, Convection{3.0, Profile(2.0)});
  set_face(problem, Face::y_min, PrescribedFlux{Profile("x")});
  TouchingMarch march(problem, at_rest);
  march.march(0.005, 40);
  const double stored = march.assembly.system->stored_heat(march.state.temperature);
  EXPECT_GT(stored, 0.1);
  EXPECT_LT(std::abs(march.energy_fault()), 1e-11 * stored);
  EXPECT_LT(march.count.largest_residual, linear_tolerance);
}

}  // namespace
}  // namespace peritherm
