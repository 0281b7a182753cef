#include "peritherm/geometry/polyline.hpp"

#include <gtest/gtest.h>

namespace peritherm {
namespace {

TEST(Polyline, needs_no_corners_on_straight_ways) {
  std::vector<Point> corners;
  for (int k = 0; k <= 100; ++k) corners.push_back({0.3 * k, 0.1 * k, 0.0});
  const std::vector<Point> needed = simplified(corners, 1e-9);
  ASSERT_EQ(needed.size(), 2U);
  EXPECT_EQ(needed[0], corners.front());
  EXPECT_EQ(needed[1], corners.back());
}

TEST(Polyline, keeps_corners_that_lie_farther_off) {
  const std::vector<Point> corners{{0, 0, 0}, {1, 0.01, 0}, {2, 0, 0}, {2, 1, 0}, {0.5, 0, 0}};
  EXPECT_EQ(simplified(corners, 0.02), (std::vector<Point>{corners[0], corners[2], corners[3], corners[4]}));
  EXPECT_EQ(simplified(corners, 0.005), corners);
}

TEST(Polyline, keeps_what_is_closed) {
  const std::vector<Point> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  EXPECT_EQ(simplified(square, 0.1), square);
  EXPECT_EQ(simplified({square[0]}, 0.1).size(), 1U);
}

}  // namespace
}  // namespace peritherm
