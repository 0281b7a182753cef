#include <gtest/gtest.h>

#include <cmath>

#include "support/run_problem.hpp"

namespace peritherm {
namespace {

constexpr double tolerance = 1e-5;

Problem bar_at(double temperature) {
  Problem problem = unit_body(1, 20, 3.0);
  problem.initial.temperature = temperature;
  problem.time.integrator = RungeKuttaLegendre{tolerance};
  return problem;
}

TEST(UniformStart, heat_that_begins_gently_is_taken_up) {
  Problem problem = bar_at(0.0);
  set_face(problem, Face::x_min, PrescribedFlux{Profile(std::string("sin(t)"))});
  March run(problem);
  run.advance_to(1.0);
  // Errors of single steps, relative to the rise, add up at worst.
  const double heat = 1.0 - std::cos(1.0);
  EXPECT_NEAR(run.stored_heat(), heat, tolerance * heat * static_cast<double>(run.count().accepted));
}

TEST(UniformStart, a_source_that_jumps_later_is_found) {
  for (const double start : {0.0, 20.0, 293.15}) {
    Problem problem = bar_at(start);
    problem.sources.push_back({Profile(std::string("t > 0.5")), std::nullopt});
    March run(problem);
    run.advance_to(1.0);
    // The step across the jump is accepted when 0.4 of its length is less than the tolerated share of the way left.
    const double left = 0.5;
    for (const double value : run.temperatures()) EXPECT_NEAR(value, start + left, 2.5 * tolerance * left) << start;
  }
}

TEST(UniformStart, nothing_happens_where_nothing_drives) {
  for (const double start : {0.0, -40.0, 293.15}) {
    Problem problem = bar_at(start);
    set_face(problem, Face::x_max, held_at(start));
    March run(problem);
    run.advance_to(1.0);
    for (const double value : run.temperatures()) EXPECT_NEAR(value, start, 1e-12 * std::abs(start));
  }
}

}  // namespace
}  // namespace peritherm
