#include "peritherm/output/interpolation.hpp"

#include <cmath>

#include "support/tolerance.hpp"
#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

double linear(const Point& x) { return 7.0 + 3.0 * x[0] - 2.0 * x[1] + 0.5 * x[2]; }

TEST(Interpolation, a_linear_field_is_met_exactly_everywhere_in_the_box) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (const PointPlacement placement : {PointPlacement::centres, PointPlacement::boundary}) {
      const GridIndex cells{4, dimension > 1 ? 3 : 1, dimension > 2 ? 5 : 1};
      const Grid grid{dimension, 0.5, cells, {-1.0, 2.0, 0.0}, placement};
      const SampleBody body(grid, linear);
      for (const double share : {0.0, 0.03, 0.31, 0.5, 0.77, 1.0}) {
        Point x{};
        for (int axis = 0; axis < dimension; ++axis) x[axis] = grid.origin[axis] + share * grid.length(axis);
        EXPECT_NEAR(interpolate(grid, body.temperature, x), linear(x), rounding(8, 20.0));
      }
    }
  }
}

TEST(Interpolation, a_single_layer_of_points_is_constant_across_it) {
  const Grid grid{2, 1.0, {3, 1, 1}, {}, PointPlacement::centres};
  const SampleBody body(grid, [](const Point& x) { return x[0]; });
  EXPECT_EQ(interpolate(grid, body.temperature, {1.5, 0.0, 0.0}), 1.5);
  EXPECT_EQ(interpolate(grid, body.temperature, {1.5, 1.0, 0.0}), 1.5);
}

TEST(Interpolation, beside_a_hole_the_nearest_point_that_exists_counts) {
  const Grid grid{2, 1.0, {2, 2, 1}, {}, PointPlacement::centres};
  const std::vector<double> field{1.0, not_a_number, 3.0, 4.0};
  EXPECT_EQ(interpolate(grid, field, {0.6, 0.7, 0.0}), 1.0);
  EXPECT_EQ(interpolate(grid, field, {1.4, 0.7, 0.0}), 4.0);
  EXPECT_EQ(interpolate(grid, field, {0.5, 1.0, 0.0}), 2.0) << "between two points that exist";
}

TEST(Interpolation, where_nothing_exists_there_is_no_value) {
  const Grid grid{1, 1.0, {2, 1, 1}, {}, PointPlacement::centres};
  EXPECT_TRUE(std::isnan(interpolate(grid, std::vector<double>{not_a_number, not_a_number}, {0.7, 0.0, 0.0})));
}

}  // namespace
}  // namespace peritherm
