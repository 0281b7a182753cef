#include <gtest/gtest.h>

#include "peritherm/solutions/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

TEST(Convection, a_body_without_inner_resistance_cools_as_a_lump) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : placements) {
      Problem problem = unit_body(dimension, 8, 2.5);
      problem.body.points = points;
      const double conductivity = 1e4;
      problem.materials["body"].conductivity = conductivity;
      problem.initial.temperature = 100.0;
      set_all_faces(problem, Convection{1.0, 20.0});
      problem.time.integrator = RungeKuttaLegendre{1e-6};
      March run(problem);
      const double time = 0.2;
      run.advance_to(time);
      // Inner resistance and that of the layer that takes up the heat are a Biot number each, in each direction; errors
      // per step add up.
      const double tolerance =
          80.0 * (2.0 * dimension / conductivity + 1e-6 * static_cast<double>(run.count().accepted));
      const double expected = lumped_convection(100.0, 20.0, 2.0 * dimension, time);
      for (const double value : run.temperatures()) ASSERT_NEAR(value, expected, tolerance) << dimension;
    }
  }
}

TEST(Convection, the_linear_profile_of_a_slab_is_steady) {
  // Held at 300 at x = 0, convection at x = 1 to 100: resistances 1/k and 1/h in series.
  const double flux = (300.0 - 100.0) / (1.0 / 2.0 + 1.0 / 5.0);
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : placements) {
      Problem problem = unit_body(dimension, 8, 2.5);
      problem.body.points = points;
      problem.materials["body"].conductivity = 2.0;
      problem.initial.temperature = Profile("300 - " + std::to_string(flux) + "/2*x");
      set_face(problem, Face::x_min, held_at(300.0));
      set_face(problem, Face::x_max, Convection{5.0, 100.0});
      March run(problem);
      // The flux above is written with six decimals; it and roundings move the rate by at most Σ G/C.
      const double fastest = run.assembly().system->fastest_rate();
      const double scale = 300.0 * fastest;
      for (const double rate : run.rates()) ASSERT_NEAR(rate, 0.0, 1e-6 * fastest + rounding(100, scale));
      const std::vector<double> heat = run.heat_rates();
      EXPECT_NEAR(heat[0], flux, 1e-6 * fastest + rounding(100, scale));
      EXPECT_NEAR(heat[1], -flux, 1e-6 * fastest + rounding(100, scale));
    }
  }
}

/// Root of β tan β = biot in (nπ, nπ + π/2), by bisection.
double robin_root(int n, double biot) {
  double low = n * std::acos(-1.0);
  double high = low + 0.5 * std::acos(-1.0);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (middle * std::tan(middle) < biot ? low : high) = middle;
  }
  return low;
}

/// Slab of length and diffusivity 1, insulated at 0, convection to 0 at 1, start 1 [carslaw1959, section 3.11].
double cooling_slab(double biot, double x, double t) {
  double sum = 0.0;
  for (int n = 0; n < 30; ++n) {
    const double root = robin_root(n, biot);
    sum += 4.0 * std::sin(root) / (2.0 * root + std::sin(2.0 * root)) * std::cos(root * x) * std::exp(-root * root * t);
  }
  return sum;
}

TEST(Convection, a_bar_that_cools_at_one_end_converges_with_order_two) {
  for (const PointPlacement points : placements) {
    std::vector<double> spacings;
    std::vector<double> errors;
    for (const int cells : {20, 40, 80, 160}) {
      Problem problem = unit_body(1, cells, 3.0);
      problem.body.points = points;
      problem.initial.temperature = 1.0;
      set_face(problem, Face::x_max, Convection{3.0, 0.0});
      problem.time.integrator = RungeKuttaLegendre{1e-8};
      March run(problem);
      run.advance_to(0.2);
      spacings.push_back(1.0 / cells);
      errors.push_back(run.relative_error([](const Point& x) { return cooling_slab(3.0, x[0], 0.2); }));
    }
    EXPECT_NEAR(order_of_convergence(spacings, errors), 2.0, 0.1) << name_of(points);
  }
}

}  // namespace
}  // namespace peritherm
