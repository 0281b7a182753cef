#include <gtest/gtest.h>

#include "peritherm/solutions/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

double order_of_imposed(Imposed imposed, PointPlacement points) {
  const Slab slab{1.0, 1.0};
  std::vector<double> spacings;
  std::vector<double> errors;
  for (const int cells : {40, 80, 160, 320}) {
    Problem problem = unit_body(1, cells, 4.0);
    problem.body.points = points;
    problem.initial.temperature = 1.0;
    set_all_faces(problem, held_at(0.0, imposed));
    problem.time.integrator = RungeKuttaLegendre{1e-7};
    March run(problem);
    run.advance_to(0.1);
    spacings.push_back(1.0 / cells);
    errors.push_back(run.relative_error([&](const Point& x) { return slab_with_held_ends(slab, x[0], 0.1); }));
  }
  return order_of_convergence(spacings, errors);
}

TEST(BoundaryLayer, constant_fictitious_points_and_a_held_inner_layer_are_of_first_order) {
  for (const PointPlacement points : placements) {
    EXPECT_NEAR(order_of_imposed(Imposed::constant, points), 1.05, 0.15) << name_of(points);
    EXPECT_NEAR(order_of_imposed(Imposed::inner, points), 1.05, 0.15) << name_of(points);
  }
}

TEST(BoundaryLayer, a_held_inner_layer_keeps_its_temperature_and_nothing_else_does) {
  for (const PointPlacement points : placements) {
    Problem problem = unit_body(2, 16, 2.5);
    problem.body.points = points;
    HeldTemperature layer = held_at(Profile("10 + x + t"), Imposed::inner);
    layer.thickness = 0.2;
    set_face(problem, Face::y_min, layer);
    March run(problem);
    run.advance_to(0.5);
    const std::vector<double> values = run.temperatures();
    for (std::size_t n = 0; n < values.size(); ++n) {
      const Point x = run.position(n);
      if (x[1] < 0.2) {
        ASSERT_NEAR(values[n], 10.5 + x[0], rounding(3, 11.0));
      } else {
        ASSERT_GT(std::abs(values[n] - 10.5 - x[0]), 1e-3);
      }
    }
  }
}

TEST(BoundaryLayer, a_slot_insulates_however_thin) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : placements) {
      for (const InterfaceRule rule : {InterfaceRule::length_weighted_harmonic, InterfaceRule::arithmetic}) {
        Problem problem = unit_body(dimension, 8, 3.5);
        problem.body.points = points;
        problem.nonlocality.interface = rule;
        // One layer of points, far thinner than the horizon.
        const double place = points == PointPlacement::boundary ? 0.5 : 0.4375;
        Coordinates from(static_cast<std::size_t>(dimension), 0.0);
        Coordinates to(static_cast<std::size_t>(dimension), 1.0);
        from[0] = place - 0.01;
        to[0] = place + 0.01;
        problem.body.regions = {{"void", Box{from, to}}};
        problem.initial.temperature = Profile("100*(x > 0.45)");
        set_face(problem, Face::x_max, held_at(200.0));
        March run(problem);
        run.advance_to(1.0);
        const std::vector<double> values = run.temperatures();
        for (std::size_t n = 0; n < values.size(); ++n) {
          const double x = run.position(n)[0];
          if (x < from[0]) {
            ASSERT_NEAR(values[n], 0.0, rounding(100, 200.0)) << dimension << ", " << name_of(points);
          } else if (x > to[0]) {
            ASSERT_GT(values[n], 150.0) << dimension << ", " << name_of(points);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace peritherm
