#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "peritherm/geometry/crack.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

using Outline = std::vector<std::vector<Point>>;

CrackSurface surface(std::vector<Coordinates> points, int dimension, double tip_speed) {
  Crack crack;
  crack.points = std::move(points);
  crack.start_time = 1.0;
  if (tip_speed > 0.0) crack.tip_speed = tip_speed;
  return CrackSurface(crack, dimension, 0.1);
}

TEST(CrackOutline, nothing_is_there_before_the_start) {
  EXPECT_EQ(surface({{0.0, 0.0}, {1.0, 0.0}}, 2, 0.0).outline(0.5), Outline{});
  EXPECT_EQ(surface({{0.0, 0.0}, {1.0, 0.0}}, 2, 0.5).outline(1.0), Outline{});
  EXPECT_EQ(surface({{0.3}}, 1, 0.0).outline(0.5), Outline{});
}

TEST(CrackOutline, a_standing_crack_is_there_as_a_whole_from_its_start) {
  EXPECT_EQ(surface({{0.0, 0.0}, {1.0, 0.0}}, 2, 0.0).outline(1.0), (Outline{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}));
  EXPECT_EQ(surface({{0.3}}, 1, 0.0).outline(1.0), (Outline{{{0.3, 0.0, 0.0}}}));
}

TEST(CrackOutline, a_growing_polyline_ends_at_its_tip) {
  const CrackSurface growing = surface({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, 2, 0.5);
  EXPECT_EQ(growing.outline(2.0), (Outline{{{0.0, 0.0, 0.0}, {0.5, 0.0, 0.0}}}));
  EXPECT_EQ(growing.outline(3.0), (Outline{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}));
  EXPECT_EQ(growing.outline(4.0), (Outline{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.5, 0.0}}}));
  EXPECT_EQ(growing.outline(9.0), (Outline{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}}));
}

TEST(CrackOutline, a_growing_polygon_ends_at_its_front) {
  const CrackSurface growing = surface({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}, 3, 0.5);
  EXPECT_EQ(growing.outline(2.0), (Outline{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.5, 0.0}, {0.0, 0.5, 0.0}}}));
  EXPECT_EQ(growing.outline(9.0).at(0).size(), 4u);
}

TEST(CrackOutline, a_growing_disc_is_a_circle_until_it_has_its_radius) {
  Crack penny;
  penny.disc = Disc{{1.0, 2.0, 3.0}, {1.0, 2.0, 2.0}, 0.5};
  penny.tip_speed = 0.1;
  const CrackSurface growing(penny, 3, 0.1);
  for (const auto& [time, radius] : {std::pair{2.0, 0.2}, std::pair{5.0, 0.5}, std::pair{50.0, 0.5}}) {
    const Outline outline = growing.outline(time);
    ASSERT_EQ(outline.at(0).size(), 64u);
    for (const Point& x : outline[0]) {
      EXPECT_NEAR(std::hypot(x[0] - 1.0, x[1] - 2.0, x[2] - 3.0), radius, rounding(8, 1.0));
      EXPECT_NEAR((x[0] - 1.0) + 2.0 * (x[1] - 2.0) + 2.0 * (x[2] - 3.0), 0.0, rounding(8, 10.0));
    }
  }
}

TEST(CrackTips, lie_at_both_ends_and_look_out_of_the_crack) {
  const std::vector<CrackTip> tips = surface({{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}}, 2, 0.0).tips(1.0);
  ASSERT_EQ(tips.size(), 2u);
  EXPECT_EQ(tips[0].end, 0);
  EXPECT_EQ(tips[0].position, (Point{0.0, 0.0, 0.0}));
  EXPECT_EQ(tips[0].direction, (Point{-1.0, 0.0, 0.0}));
  EXPECT_EQ(tips[1].end, 1);
  EXPECT_EQ(tips[1].position, (Point{1.0, 2.0, 0.0}));
  EXPECT_EQ(tips[1].direction, (Point{0.0, 1.0, 0.0}));
}

TEST(CrackTips, the_last_one_moves_while_the_crack_grows) {
  const CrackSurface growing = surface({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, 2, 0.5);
  EXPECT_TRUE(growing.tips(1.0).empty());
  EXPECT_EQ(growing.tips(2.0).at(1).position, (Point{0.5, 0.0, 0.0}));
  EXPECT_EQ(growing.tips(2.0).at(1).direction, (Point{1.0, 0.0, 0.0}));
  EXPECT_EQ(growing.tips(4.0).at(1).position, (Point{1.0, 0.5, 0.0}));
  EXPECT_EQ(growing.tips(4.0).at(1).direction, (Point{0.0, 1.0, 0.0}));
  EXPECT_EQ(growing.tips(4.0)[0].speed, 0.0);
  EXPECT_EQ(growing.tips(4.0)[1].speed, 0.5);
  EXPECT_EQ(growing.tips(9.0).at(1).speed, 0.0);
}

TEST(CrackTips, a_closed_polyline_has_none_once_it_has_closed) {
  const CrackSurface loop = surface({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 0.0}}, 2, 0.5);
  EXPECT_EQ(loop.tips(4.0).size(), 2u);
  EXPECT_TRUE(loop.tips(9.0).empty());
}

TEST(CrackTips, only_polylines_have_them) {
  EXPECT_TRUE(surface({{0.3}}, 1, 0.0).tips(1.0).empty());
  EXPECT_TRUE(surface({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}, 3, 0.0).tips(1.0).empty());
}

}  // namespace
}  // namespace peritherm
