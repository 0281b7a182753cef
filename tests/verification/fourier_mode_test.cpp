#include <gtest/gtest.h>

#include <numbers>

#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr GridIndex wave{3, 2, 1};  ///< half waves along each axis

double mode(const Point& x, int dimension) {
  double product = 1.0;
  for (int axis = 0; axis < dimension; ++axis) product *= std::cos(std::numbers::pi * wave[axis] * x[axis]);
  return product;
}

/// Σ G (1 − cos k·ξ) / C; the stencil's symmetry leaves the product of cosines of each axis.
double decay_rate(const Assembly& assembly) {
  const Grid& grid = assembly.geometry.body.grid;
  double sum = 0.0;
  for (const StencilEntry& entry : assembly.geometry.stencil.entries) {
    Point offset{};
    for (int axis = 0; axis < 3; ++axis) offset[axis] = entry.offset[axis] * grid.spacing;
    sum += entry.conductance * (1.0 - mode(offset, grid.dimension));
  }
  return sum / grid.cell_volume();
}

void expect_exact_decay(int dimension, PointPlacement points, const Kernel& kernel, BackendName backend) {
  Problem problem = unit_body(dimension, dimension == 3 ? 8 : 16, 2.6);
  problem.body.points = points;
  problem.nonlocality.kernel = kernel;
  problem.numerics.backend = backend;
  const char* expressions[] = {"cos(3*pi*x)", "cos(3*pi*x)*cos(2*pi*y)", "cos(3*pi*x)*cos(2*pi*y)*cos(pi*z)"};
  problem.initial.temperature = Profile(std::string(expressions[dimension - 1]));
  constexpr int steps = 400;
  constexpr double end = 0.01;
  problem.time.integrator = RungeKutta4{end / steps, 0.9};
  March run(problem);
  const double rate = decay_rate(run.assembly());
  run.advance_to(end);
  // RK4 misses exp(z) by z⁵/120 a step; below it, every step adds the roundings of one row.
  const double time_error = steps * std::pow(rate * end / steps, 5) / 120.0;
  const std::size_t bonds = run.assembly().geometry.stencil.entries.size();
  const double tolerance = 1.1 * time_error + rounding(bonds * steps, 1.0);
  const std::vector<double> values = run.temperatures();
  for (std::size_t n = 0; n < values.size(); ++n) {
    ASSERT_NEAR(values[n], std::exp(-rate * end) * mode(run.position(n), dimension), tolerance) << "point " << n;
  }
}

TEST(FourierMode, decays_at_its_exact_semi_discrete_rate_in_every_dimension) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : {PointPlacement::centres, PointPlacement::boundary}) {
      SCOPED_TRACE(std::to_string(dimension) + "-D, " + std::string(name_of(points)));
      expect_exact_decay(dimension, points, Kernel{LinearKernel{}, 2}, BackendName::stencil);
      expect_exact_decay(dimension, points, Kernel{ConstantKernel{}, 1}, BackendName::bond);
      expect_exact_decay(dimension, points, Kernel{GaussianKernel{}, 0}, BackendName::stencil);
    }
  }
}

}  // namespace
}  // namespace peritherm
