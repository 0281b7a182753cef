#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr Outside ties[] = {Outside::slaved, Outside::flux_formula};

/// A body held at x = 0 with heat 2 into x = 1, at the temperature 5 + 2 x that this gives.
Problem heated_end(int dimension, int cells, Outside outside, PointPlacement points) {
  Problem problem = unit_body(dimension, cells, 2.5);
  problem.body.points = points;
  problem.initial.temperature = Profile("5 + 2*x");
  set_face(problem, Face::x_min, held_at(5.0));
  set_face(problem, Face::x_max, PrescribedFlux{Profile("2"), outside});
  problem.time.integrator = RungeKuttaLegendre{1e-6};
  return problem;
}

TEST(TiedFaces, continue_a_linear_temperature_exactly) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (const Outside outside : ties) {
      for (const PointPlacement points : placements) {
        March run(heated_end(dimension, 8, outside, points));
        const std::vector<double> values = run.temperatures();
        for (std::size_t n = 0; n < values.size(); ++n) {
          EXPECT_NEAR(values[n], 5.0 + 2.0 * run.position(n)[0], 1e-13) << name_of(outside) << ", point " << n;
        }
      }
    }
  }
}

TEST(TiedFaces, slaved_points_keep_the_linear_temperature_that_their_flux_gives) {
  March run(heated_end(1, 20, Outside::slaved, PointPlacement::centres));
  // Rates are sums of differences times conductances over capacities, 1/spacing² at most times 4.
  for (const double rate : run.rates()) EXPECT_NEAR(rate, 0.0, 1e-15 * 7.0 * 4.0 * 400.0 * 10.0);
}

/// A plate held at one side and with ties at others.
Problem tied_plate(Outside right, Outside top) {
  Problem problem = unit_body(2, 16, 2.5);
  problem.body.points = PointPlacement::boundary;
  problem.initial.temperature = Profile("cos(3*x) + y");
  set_face(problem, Face::x_min, held_at(1.0, Imposed::row));
  set_face(problem, Face::x_max, PrescribedFlux{Profile("1 + y"), right});
  set_face(problem, Face::y_max, Insulated{top});
  set_face(problem, Face::y_min, Insulated{Outside::natural});
  problem.time.integrator = RungeKuttaLegendre{1e-6};
  return problem;
}

TEST(TiedFaces, heat_that_enters_through_them_is_what_is_stored) {
  for (const Outside right : ties) {
    for (const bool grows : {false, true}) {
      Problem problem = tied_plate(right, Outside::flux_formula);
      if (grows) {
        Crack& crack = problem.cracks.emplace_back();
        crack.points = {{0.3, 0.51}, {0.9, 0.61}};
        crack.tip_speed = 6.0;
      }
      March run(problem);
      const double before = run.stored_heat();
      run.advance_to(0.2);
      double entered = 0.0, passed = 0.0;
      for (const double heat : run.heats()) {
        entered += heat;
        passed += std::abs(heat);
      }
      const auto evaluations = static_cast<std::size_t>(run.count().evaluations);
      EXPECT_NEAR(run.stored_heat() - before, entered, rounding(evaluations, 1.0 + passed));
      EXPECT_GT(passed, 0.1);
    }
  }
}

TEST(TiedFaces, evaluate_alike_with_every_backend) {
  Problem problem = tied_plate(Outside::flux_formula, Outside::slaved);
  problem.numerics.backend = BackendName::bond;
  const std::vector<double> expected = March(problem).rates();
  const double largest = *std::max_element(expected.begin(), expected.end());
  problem.numerics.backend = BackendName::stencil;
  const std::vector<double> found = March(problem).rates();
  for (std::size_t n = 0; n < found.size(); ++n) EXPECT_NEAR(found[n], expected[n], rounding(64, largest));
}

/// The largest growth of random temperatures per application of the linear part, after many.
double power_iteration(HeatSystem& system) {
  std::vector<double> now(system.size()), next(system.size(), 0.0);
  for (std::size_t n = 0; n < now.size(); ++n) now[n] = std::sin(static_cast<double>(n * n));
  double growth = 0.0;
  for (int k = 0; k < 300; ++k) {
    system.combine_linear(-1, now, 1.0, {}, next);
    std::fill(next.begin() + static_cast<std::ptrdiff_t>(system.field_size()), next.end(), 0.0);
    double size = 0.0;
    for (const double value : next) size = std::max(size, std::abs(value));
    growth = size;
    for (std::size_t n = 0; n < now.size(); ++n) now[n] = next[n] / size;
  }
  return growth;
}

TEST(TiedFaces, decay_no_faster_than_the_bound) {
  for (const Scheme scheme : {Scheme::bobaru_2012, Scheme::peritherm}) {
    Problem problem = tied_plate(Outside::flux_formula, Outside::flux_formula);
    problem.nonlocality.scheme = scheme;
    const Assembly assembly = assemble(problem);
    EXPECT_FALSE(assembly.system->is_symmetric());
    EXPECT_LE(power_iteration(*assembly.system), assembly.system->fastest_rate());
  }
}

TEST(TiedFaces, are_left_to_integrators_that_need_no_symmetry) {
  Problem problem = tied_plate(Outside::flux_formula, Outside::slaved);
  const Assembly assembly = assemble(problem);
  const double times[] = {0.1};
  const ChosenStepping chosen = choose_stepping(AutomaticStepping{}, *assembly.system, 0.0, times);
  EXPECT_TRUE(std::holds_alternative<RungeKuttaLegendre>(chosen.stepping));
  EXPECT_NE(chosen.reason.find("one way"), std::string::npos);
  for (const TimeStepping& stepping : {TimeStepping(Chebyshev{}), TimeStepping(SteadyState{}),
                                       TimeStepping(BackwardDifferences{}), TimeStepping(ImplicitRungeKutta{})}) {
    EXPECT_THROW(choose_stepping(stepping, *assembly.system, 0.0, times), Error);
    problem.time.integrator = stepping;
    EXPECT_FALSE(find_faults(problem).empty());
  }
}

TEST(TiedFaces, points_that_will_lose_every_neighbour_are_refused_at_the_start) {
  Problem problem = heated_end(2, 10, Outside::flux_formula, PointPlacement::centres);
  Crack crack;
  crack.points = {{0.9, -0.1}, {0.9, 1.1}};
  crack.start_time = 0.5;
  problem.cracks.push_back(crack);
  EXPECT_THROW(assemble(problem), Error);
  problem.time.end = 0.4;
  EXPECT_NO_THROW(assemble(problem));
}

TEST(TiedFaces, points_without_a_neighbour_farther_in_are_refused) {
  Problem problem = tied_plate(Outside::flux_formula, Outside::natural);
  problem.cracks.emplace_back().points = {{0.99, -0.1}, {0.99, 1.1}};
  EXPECT_THROW(assemble(problem), Error);
}

}  // namespace
}  // namespace peritherm
