#include "peritherm/physics/covered_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double volume_error = 1e-11;  // what the header promises

TEST(CoveredCell, a_cell_inside_counts_whole_and_one_outside_not_at_all) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    EXPECT_EQ(covered_volume({1, 0, 0}, 3.0, dimension), 1.0);
    EXPECT_EQ(covered_volume({4, 0, 0}, 3.0, dimension), 0.0);
    EXPECT_EQ(covered_volume({}, 0.9, dimension), 1.0);
  }
}

TEST(CoveredCell, a_cell_that_the_sphere_only_touches_counts_as_on_one_side) {
  EXPECT_EQ(covered_volume({1, 0, 0}, 1.5 * (1.0 - 1e-16), 1), 1.0);
  EXPECT_EQ(covered_volume({2, 0, 0}, 1.5 * (1.0 + 1e-16), 2), 0.0);
}

// The segment of a disc of radius 1 beyond x = 1/2, cut by nothing else within |y| < sqrt(3)/2: between |y| < 1/2 here.
TEST(CoveredCell, a_disc_covers_a_cell_on_an_axis_as_the_closed_form_says) {
  const double exact = std::asin(0.5) + 0.5 * std::sqrt(0.75) - 0.5;
  EXPECT_NEAR(covered_volume({1, 0, 0}, 1.0, 2), exact, volume_error);
}

TEST(CoveredCell, a_ball_inside_the_cell_of_the_origin_has_its_own_volume) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    EXPECT_NEAR(covered_volume({}, 0.4, dimension), ball_volume(0.4, dimension), volume_error);
  }
}

TEST(CoveredCell, integrals_over_a_segment_are_those_of_the_antiderivative) {
  const auto inverse_square = [](double s) { return 1.0 / (s * s); };
  for (int j = 1; j <= 5; ++j) {
    const double whole = 1.0 / (j - 0.5) - 1.0 / (j + 0.5);
    EXPECT_NEAR(integral_over_covered(inverse_square, {j, 0, 0}, 9.0, 1), whole, 1e-11 * whole);
    const double part = 1.0 / (j - 0.5) - 1.0 / (j + 0.2);
    EXPECT_NEAR(integral_over_covered(inverse_square, {-j, 0, 0}, j + 0.2, 1), part, 1e-11 * part);
  }
}

// ∫ 1/|x|² dA over the annulus from the circle inside a square of cells to a larger circle is 2π ln of the radii's
// ratio.
TEST(CoveredCell, integrals_over_all_cells_of_an_annulus_are_those_in_polar_coordinates) {
  const auto inverse_square = [](double s) { return 1.0 / (s * s); };
  double difference = 0.0;
  for (int y = -5; y <= 5; ++y) {
    for (int x = -5; x <= 5; ++x) {
      if (x == 0 && y == 0) continue;
      difference += integral_over_covered(inverse_square, {x, y, 0}, 4.3, 2) -
                    integral_over_covered(inverse_square, {x, y, 0}, 2.1, 2);
    }
  }
  EXPECT_NEAR(difference, 2.0 * std::numbers::pi * std::log(4.3 / 2.1), 121 * 1e-11);
}

TEST(CoveredCell, cells_that_differ_in_signs_and_order_of_axes_are_covered_alike) {
  const double one = covered_volume({1, 2, 0}, 2.3, 3);
  EXPECT_NEAR(covered_volume({0, -1, 2}, 2.3, 3), one, volume_error);
  EXPECT_NEAR(covered_volume({-2, 0, -1}, 2.3, 3), one, volume_error);
}

}  // namespace
}  // namespace peritherm
