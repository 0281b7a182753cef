#include "peritherm/geometry/plane_polygon.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

using Corners = std::vector<std::array<double, 2>>;

const Corners arrow{{0.0, 0.0}, {2.0, -1.0}, {1.0, 0.0}, {2.0, 1.0}};

TEST(PlanePolygon, a_notch_is_outside) {
  EXPECT_TRUE(plane_polygon_contains(arrow, 0.5, 0.0, 0.0));
  EXPECT_FALSE(plane_polygon_contains(arrow, 1.5, 0.0, 0.0));
  EXPECT_TRUE(plane_polygon_contains(arrow, 1.5, 0.6, 0.0));
}

TEST(PlanePolygon, edges_and_corners_belong_to_it) {
  EXPECT_TRUE(plane_polygon_contains(arrow, 1.0, 0.5, 0.0));
  for (const auto& [x, y] : arrow) EXPECT_TRUE(plane_polygon_contains(arrow, x, y, 0.0));
}

TEST(PlanePolygon, slack_widens_it_all_around) {
  EXPECT_FALSE(plane_polygon_contains(arrow, -0.01, 0.0, 0.0));
  EXPECT_TRUE(plane_polygon_contains(arrow, -0.01, 0.0, 0.02));
  EXPECT_TRUE(plane_polygon_contains(arrow, 1.01, 0.0, 0.02));
}

TEST(PlanePolygon, a_row_through_corners_changes_sides_only_where_the_outline_does) {
  const Corners diamond{{0.0, 0.0}, {1.0, -1.0}, {2.0, 0.0}, {1.0, 1.0}};
  EXPECT_FALSE(plane_polygon_contains(diamond, -0.5, 0.0, 0.0));
  EXPECT_TRUE(plane_polygon_contains(diamond, 0.5, 0.0, 0.0));
  EXPECT_FALSE(plane_polygon_contains(diamond, 2.5, 0.0, 0.0));
  EXPECT_FALSE(plane_polygon_contains(diamond, 0.0, 1.0, 0.0));
}

TEST(PlanePolygon, the_area_is_positive_counter_clockwise_and_the_same_far_from_the_origin) {
  EXPECT_DOUBLE_EQ(twice_signed_area(arrow), 2.0);
  EXPECT_DOUBLE_EQ(twice_signed_area(Corners(arrow.rbegin(), arrow.rend())), -2.0);
  Corners far = arrow;
  for (auto& corner : far) corner[0] += 1024.0;
  EXPECT_EQ(twice_signed_area(far), 2.0);
}

TEST(PlanePolygon, outlines_that_cross_touch_or_fold_back_are_found) {
  EXPECT_FALSE(crosses_itself(arrow));
  EXPECT_TRUE(crosses_itself(Corners{{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}));
  EXPECT_TRUE(crosses_itself(Corners{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}));
  EXPECT_TRUE(crosses_itself(Corners{{0.0, 0.0}, {2.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}));
}

TEST(PlanePolygon, the_distance_from_an_edge_ends_at_its_corners) {
  const std::array<double, 2> first{0.0, 0.0};
  const std::array<double, 2> second{4.0, 0.0};
  EXPECT_EQ(distance_from_edge(first, second, 2.0, -3.0), 3.0);
  EXPECT_EQ(distance_from_edge(first, second, 7.0, 4.0), 5.0);
  EXPECT_EQ(distance_from_edge(first, first, 3.0, 4.0), 5.0);
}

}  // namespace
}  // namespace peritherm
