#include <gtest/gtest.h>

#include <numbers>

#include "peritherm/solutions/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

TEST(PrescribedFlux, a_bar_heated_at_one_end_converges_with_order_two) {
  const Slab slab{1.0, 2.0 / 3.0};
  for (const PointPlacement points : placements) {
    std::vector<double> spacings;
    std::vector<double> errors;
    for (const int cells : {20, 40, 80, 160}) {
      Problem problem = unit_body(1, cells, 4.0);
      problem.body.points = points;
      problem.materials["body"] = {2.0, 1.5, 2.0};
      set_face(problem, Face::x_min, held_at(20.0));
      set_face(problem, Face::x_max, PrescribedFlux{2.0 * 30.0});
      problem.time.integrator = RungeKuttaLegendre{1e-8};
      March run(problem);
      run.advance_to(0.2);
      spacings.push_back(1.0 / cells);
      errors.push_back(run.relative_error(
          [&](const Point& x) { return slab_with_prescribed_gradient(slab, 20.0, 30.0, x[0], 0.2); }));
    }
    EXPECT_NEAR(order_of_convergence(spacings, errors), 2.0, 0.1) << name_of(points);
  }
}

TEST(PrescribedFlux, brings_in_exactly_its_heat) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : placements) {
      Problem problem = unit_body(dimension, 8, 2.6);
      problem.body.points = points;
      set_all_faces(problem, PrescribedFlux{5.0});
      March run(problem);
      run.advance_to(0.3);
      const double expected = 5.0 * 2.0 * dimension * 0.3;
      const std::size_t sums = run.assembly().geometry.stencil.entries.size() * run.count().evaluations;
      EXPECT_NEAR(run.stored_heat(), expected, rounding(sums, expected)) << dimension << ", " << name_of(points);
    }
  }
}

TEST(PrescribedFlux, that_changes_in_time_brings_in_its_integral) {
  Problem problem = unit_body(2, 8, 2.6);
  set_face(problem, Face::y_max, PrescribedFlux{Profile("100*x*t*t*t")});
  problem.time.integrator = RungeKutta4{1e-3, 0.9};
  March run(problem);
  run.advance_to(0.2);
  // Mean over x is 50, and Simpson's rule is exact for cubes.
  const double expected = 50.0 * std::pow(0.2, 4) / 4.0;
  EXPECT_NEAR(run.stored_heat(), expected, rounding(200 * 4 * 30, expected));
}

TEST(HeatSource, a_uniform_source_warms_an_insulated_body_linearly) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : placements) {
      Problem problem = unit_body(dimension, 8, 2.6);
      problem.body.points = points;
      problem.materials["body"] = {3.0, 2.0, 5.0};
      problem.initial.temperature = 7.0;
      problem.sources.push_back({40.0, std::nullopt});
      March run(problem);
      run.advance_to(0.5);
      const std::size_t sums = run.assembly().geometry.stencil.entries.size() * run.count().evaluations;
      for (const double value : run.temperatures()) {
        ASSERT_NEAR(value, 7.0 + 40.0 / 10.0 * 0.5, rounding(sums, 9.0)) << dimension << ", " << name_of(points);
      }
    }
  }
}

/// T = exp(-t) Π cos(π x_a), insulated: ∂T/∂t − ∇²T = (d π² − 1) T.
double manufactured_error(int dimension, int cells, PointPlacement points) {
  Problem problem = unit_body(dimension, cells, 2.5);
  problem.body.points = points;
  const char* shapes[] = {"cos(pi*x)", "cos(pi*x)*cos(pi*y)", "cos(pi*x)*cos(pi*y)*cos(pi*z)"};
  const std::string shape = shapes[dimension - 1];
  problem.initial.temperature = Profile(shape);
  problem.sources.push_back({Profile("(" + std::to_string(dimension) + "*pi^2 - 1)*exp(-t)*" + shape), std::nullopt});
  problem.time.integrator = RungeKuttaLegendre{1e-6};
  March run(problem);
  const double end = 0.3;
  run.advance_to(end);
  return run.relative_error([&](const Point& x) {
    double product = std::exp(-end);
    for (int axis = 0; axis < dimension; ++axis) product *= std::cos(std::numbers::pi * x[axis]);
    return product;
  });
}

TEST(HeatSource, a_manufactured_solution_converges_with_order_two) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : placements) {
      std::vector<double> spacings;
      std::vector<double> errors;
      for (const int cells : {8, 16, 32}) {
        spacings.push_back(1.0 / cells);
        errors.push_back(manufactured_error(dimension, cells, points));
      }
      EXPECT_NEAR(order_of_convergence(spacings, errors), 2.0, 0.1) << dimension << ", " << name_of(points);
    }
  }
}

}  // namespace
}  // namespace peritherm
