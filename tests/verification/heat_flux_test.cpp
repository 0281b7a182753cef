#include <gtest/gtest.h>

#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

TEST(HeatFlux, of_a_linear_field_is_fouriers_at_points_whose_horizon_lies_inside) {
  const Point gradient{3.0, -2.0, 5.0};
  const char* fields[] = {"3*x", "3*x - 2*y", "3*x - 2*y + 5*z"};
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : {PointPlacement::centres, PointPlacement::boundary}) {
      for (const BackendName backend : {BackendName::stencil, BackendName::bond}) {
        Problem problem = unit_body(dimension, 8, 2.6);
        problem.body.points = points;
        problem.numerics.backend = backend;
        problem.materials["body"].conductivity = 4.0;
        problem.initial.temperature = Profile(std::string(fields[dimension - 1]));
        March run(problem);
        const int radius = run.assembly().geometry.stencil.radius;
        const std::vector<Point> flux = run.flux();
        std::size_t looked_at = 0;
        for (std::size_t n = 0; n < flux.size(); ++n) {
          const GridIndex p = run.grid().index(n);
          bool inside = true;
          for (int a = 0; a < dimension; ++a) inside = inside && p[a] >= radius && p[a] < run.grid().count(a) - radius;
          if (!inside) continue;
          ++looked_at;
          for (int a = 0; a < 3; ++a) {
            const double expected = a < dimension ? -4.0 * gradient[a] : 0.0;
            // Bonds across the gradient have a difference of a few roundings, a sixteenth cell in size.
            ASSERT_NEAR(flux[n][a], expected, rounding(100, 4.0 * 10.0 / run.grid().spacing)) << dimension;
          }
        }
        EXPECT_GT(looked_at, 0U);
      }
    }
  }
}

}  // namespace
}  // namespace peritherm
