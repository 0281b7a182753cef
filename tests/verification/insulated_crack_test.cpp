#include <gtest/gtest.h>

#include "peritherm/solutions/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

/// The square [-1, 1]² with an insulated slit of half its width that only cuts bonds, held at ±100; from the exact
/// steady state on.
Problem slit_square(int cells) {
  Problem problem = unit_body(2, cells, 6.5);
  problem.body.origin = Coordinates{-1.0, -1.0};
  problem.body.size = {2.0, 2.0};
  problem.body.points = PointPlacement::boundary;
  problem.materials["body"].conductivity = 1.14;
  set_face(problem, Face::y_min, held_at(-100.0));
  set_face(problem, Face::y_max, held_at(100.0));
  Crack crack;
  crack.faces = Faces::cut;
  crack.points = {{-0.500001, 1e-6}, {0.500001, 1e-6}};
  problem.cracks.push_back(crack);
  problem.time.end = 3.0;
  problem.time.integrator = RungeKuttaLegendre{1e-6};
  return problem;
}

TEST(InsulatedCrack, approaches_the_exact_steady_state_with_first_order_in_the_horizon) {
  const std::vector<Coordinates> places{{0.0, 0.1}, {0.0, 0.25}, {0.0, 0.5}, {1.0, 0.5}};
  // Differences from the exact steady state at t = 3, to three digits, for 60 and 120 cells.
  const double listed[2][4] = {{4.97, 3.89, 2.27, 0.548}, {2.69, 2.09, 1.23, 0.313}};
  const double half_digits[2][4] = {{5e-3, 5e-3, 5e-3, 5e-4}, {5e-3, 5e-3, 5e-3, 5e-4}};
  std::vector<std::vector<double>> differences(places.size());
  for (int refinement = 0; refinement < 2; ++refinement) {
    March run(slit_square(60 << refinement));
    run.advance_to(3.0);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double exact = 100.0 * slit_in_square(0.5, places[k][0], places[k][1]);
      differences[k].push_back(run.at(places[k]) - exact);
      // The listed runs carry an error in time of up to 2e-3.
      EXPECT_NEAR(differences[k].back(), listed[refinement][k], 2e-3 + half_digits[refinement][k]);
    }
  }
  for (const auto& difference : differences) {
    // Points near a crack's faces lack bonds: first order, with a remainder of second order.
    const double order = order_of_convergence({2.0, 1.0}, difference);
    EXPECT_GT(order, 0.8);
    EXPECT_LT(order, 1.3);
  }
}

struct Divide {
  std::string name;
  int dimension;
  std::vector<Coordinates> points;
  std::string upper_side;  ///< 1 on the side that points on the crack belong to
};

std::vector<Divide> divides() {
  return {
      {"between rows", 2, {{0.0, 0.4625}, {1.0, 0.4625}}, "y > 0.4625"},
      {"on a row or between centres", 2, {{0.0, 0.5}, {1.0, 0.5}}, "y > 0.4999999"},
      {"on centres or between corners", 2, {{0.0, 0.5625}, {1.0, 0.5625}}, "y > 0.5624999"},
      {"along y", 2, {{0.5, 1.0}, {0.5, 0.0}}, "x > 0.4999999"},
      {"diagonal", 2, {{0.0, 0.0}, {1.0, 1.0}}, "y > x - 0.0000001"},
      {"inclined", 2, {{0.0, 0.25}, {1.0, 0.625}}, "y > 0.25 + 0.375*x - 0.0000001"},
      {"bent", 2, {{0.0, 0.5}, {0.5, 0.75}, {1.0, 0.5}}, "y > 0.75 - 0.5*abs(x - 0.5) - 0.0000001"},
      {"plane on a layer", 3, {{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}}, "z > 0.4999999"},
      {"plane between layers", 3, {{0, 0, 0.4625}, {1, 0, 0.4625}, {1, 1, 0.4625}, {0, 1, 0.4625}}, "z > 0.4625"},
      {"inclined plane",
       3,
       {{0, 0, 0.25}, {1, 0, 0.625}, {1, 1, 0.625}, {0, 1, 0.25}},
       "z > 0.25 + 0.375*x - 0.0000001"},
      {"diagonal plane", 3, {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}, "z > x - 0.0000001"},
  };
}

TEST(InsulatedCrack, through_the_whole_body_lets_nothing_through) {
  for (const Divide& divide : divides()) {
    for (const PointPlacement points : {PointPlacement::centres, PointPlacement::boundary}) {
      for (const BackendName backend : {BackendName::stencil, BackendName::bond}) {
        Problem problem = unit_body(divide.dimension, 8, 2.5);
        problem.body.points = points;
        problem.numerics.backend = backend;
        problem.initial.temperature = Profile("100*(" + divide.upper_side + ")");
        problem.cracks.emplace_back().points = divide.points;
        March run(problem);
        const std::vector<double> before = run.temperatures();
        run.advance_to(0.02);
        const std::vector<double> after = run.temperatures();
        // Time for heat to cross several cells; every evaluation rounds a sum of bonds anew.
        const std::size_t sums = run.assembly().geometry.stencil.entries.size() * run.count().evaluations;
        for (std::size_t n = 0; n < after.size(); ++n) {
          const Point x = run.position(n);
          ASSERT_NEAR(after[n], before[n], rounding(sums, 100.0))
              << divide.name << ", " << name_of(points) << ", " << name_of(backend) << ", point (" << x[0] << ", "
              << x[1] << ", " << x[2] << ")";
        }
      }
    }
  }
}

TEST(InsulatedCrack, through_the_whole_body_hides_a_held_face) {
  for (const PointPlacement points : {PointPlacement::centres, PointPlacement::boundary}) {
    for (const double height : {0.4625, 0.5, 0.5625}) {
      Problem problem = unit_body(2, 8, 3.5);
      problem.body.points = points;
      set_face(problem, Face::y_max, held_at(100.0));
      problem.cracks.emplace_back().points = {{0.0, height}, {1.0, height}};
      March run(problem);
      run.advance_to(1.0);
      const std::vector<double> values = run.temperatures();
      for (std::size_t n = 0; n < values.size(); ++n) {
        if (run.position(n)[1] < height - 1e-6) {
          // Cut bonds leave their rounding behind in a sum that they were part of.
          ASSERT_NEAR(values[n], 0.0, rounding(40, 100.0)) << height << ", point " << n;
        } else {
          ASSERT_GT(values[n], 50.0) << height << ", point " << n;
        }
      }
    }
  }
}

}  // namespace
}  // namespace peritherm
