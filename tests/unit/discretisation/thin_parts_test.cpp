#include <gtest/gtest.h>

#include "support/divided_body.hpp"

namespace peritherm {
namespace {

/// A film of so many cells on top of a body of 40, horizon three spacings.
DividedBody body_with_film(int dimension, int film) {
  const int cells = dimension == 3 ? 16 : 40;
  const Grid grid = unit_box(dimension, cells);
  Box box{Coordinates(static_cast<std::size_t>(dimension), 0.0), Coordinates(static_cast<std::size_t>(dimension), 1.0)};
  box.from.back() = 1.0 - film * grid.spacing;
  PartRegion region;
  region.shape = box;
  region.name = "film";
  region.material = 1;
  return divide_body(grid, {"substrate", 0, 3.0 * grid.spacing}, {region});
}

TEST(ThinParts, a_rod_must_be_four_horizons_long) {
  EXPECT_TRUE(find_thin_parts(body_with_film(1, 12)).empty());
  const std::vector<ThinPart> thin = find_thin_parts(body_with_film(1, 11));
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_EQ(thin[0].part, 1u);
  EXPECT_NEAR(thin[0].thickness, 11.0 / 40, rounding(11, 1.0));
  EXPECT_NEAR(thin[0].needed, 12.0 / 40, rounding(1, 1.0));
}

TEST(ThinParts, a_film_must_be_two_horizons_thick) {
  for (int dimension = 2; dimension <= 3; ++dimension) {
    EXPECT_TRUE(find_thin_parts(body_with_film(dimension, 6)).empty());
    const std::vector<ThinPart> thin = find_thin_parts(body_with_film(dimension, 4));
    ASSERT_EQ(thin.size(), 1u);
    EXPECT_EQ(thin[0].part, 1u);
    const double spacing = 1.0 / (dimension == 3 ? 16 : 40);
    EXPECT_NEAR(thin[0].thickness, 4.0 * spacing, rounding(10, 1.0));
    EXPECT_NEAR(thin[0].needed, 6.0 * spacing, rounding(1, 1.0));
  }
}

TEST(ThinParts, a_ball_is_as_thick_as_its_diameter) {
  PartRegion fibre;
  fibre.shape = Ball{{0.5, 0.5}, 0.1};
  fibre.name = "fibre";
  fibre.material = 1;
  fibre.horizon = 0.09;
  const DividedBody thick = divide_body(unit_box(2, 40), {"matrix", 0, 0.075}, {fibre});
  EXPECT_TRUE(find_thin_parts(thick).empty());
  fibre.horizon = 0.13;
  const DividedBody thin = divide_body(unit_box(2, 40), {"matrix", 0, 0.075}, {fibre});
  ASSERT_EQ(find_thin_parts(thin).size(), 1u);
  EXPECT_NEAR(find_thin_parts(thin)[0].thickness, 0.2, 1.0 / 40);
}

}  // namespace
}  // namespace peritherm
