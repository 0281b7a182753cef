#include "peritherm/geometry/region.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

const Shape box = Box{{0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}};
const Shape ball = Ball{{1.0, 1.0, 0.0}, 0.5};
const Shape rod = Cylinder{{0.0, 0.0, 0.0}, {0.0, 0.0, 2.0}, 0.5};
const Shape strip = Cylinder{{0.0, 0.0}, {3.0, 4.0}, 1.0};
const Shape below = HalfSpace{{0.0, 2.0, 0.0}, 0.5};
const Shape notched = Polygon{{{0.0, 0.0}, {2.0, -1.0}, {1.0, 0.0}, {2.0, 1.0}}};

std::vector<double> crossings(const Shape& shape, const Point& a, const Point& b) {
  std::vector<double> shares;
  append_crossings(shape, a, b, shares);
  std::sort(shares.begin(), shares.end());
  return shares;
}

void expect_crossings(const Shape& shape, const Point& a, const Point& b, const std::vector<double>& expected) {
  const std::vector<double> found = crossings(shape, a, b);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], rounding(8, 1.0));
}

TEST(Region, surfaces_belong_to_their_shapes) {
  EXPECT_TRUE(contains(box, {2.0, 1.0, 0.0}, 0.0));
  EXPECT_TRUE(contains(ball, {1.5, 1.0, 0.0}, 0.0));
  EXPECT_TRUE(contains(rod, {0.5, 0.0, 2.0}, 0.0));
  EXPECT_TRUE(contains(below, {7.0, 0.5, -3.0}, 0.0));
  EXPECT_TRUE(contains(notched, {1.0, 0.5, 0.0}, 0.0));
}

TEST(Region, slack_takes_in_points_just_outside_and_no_others) {
  const std::vector<std::pair<Shape, Point>> just_outside{
      {box, {2.01, 0.5, 0.5}},        {ball, {1.0, 1.51, 0.0}},  {rod, {0.0, 0.51, 1.0}},     {rod, {0.0, 0.0, 2.01}},
      {strip, {-0.006, -0.008, 0.0}}, {below, {0.0, 0.51, 0.0}}, {notched, {-0.01, 0.0, 0.0}}};
  for (const auto& [shape, point] : just_outside) {
    EXPECT_FALSE(contains(shape, point, 0.0)) << shape.index();
    EXPECT_FALSE(contains(shape, point, 0.009)) << shape.index();
    EXPECT_TRUE(contains(shape, point, 0.011)) << shape.index();
  }
}

TEST(Region, the_offset_of_a_half_space_is_a_distance_whatever_the_length_of_its_normal) {
  const Shape oblique = HalfSpace{{30.0, 40.0}, 1.0};
  EXPECT_TRUE(contains(oblique, {0.59, 0.79, 0.0}, 0.0));
  EXPECT_FALSE(contains(oblique, {0.61, 0.81, 0.0}, 0.0));
}

TEST(Region, a_cylinder_in_the_plane_is_a_strip_with_square_ends) {
  EXPECT_TRUE(contains(strip, {-0.7, 0.6, 0.0}, 0.0));
  EXPECT_FALSE(contains(strip, {-0.7, -0.2, 0.0}, 0.0));
  EXPECT_FALSE(contains(strip, {3.7, 4.2, 0.0}, 0.0));
}

TEST(Region, a_polygon_is_a_prism_along_z) { EXPECT_TRUE(contains(notched, {0.5, 0.0, 1e6}, 0.0)); }

TEST(Region, a_ball_in_one_dimension_is_an_interval) {
  const Shape interval = Ball{{3.0}, 1.0};
  EXPECT_TRUE(contains(interval, {2.0, 0.0, 0.0}, 0.0));
  EXPECT_FALSE(contains(interval, {4.1, 0.0, 0.0}, 0.0));
  expect_crossings(interval, {0.0, 0.0, 0.0}, {8.0, 0.0, 0.0}, {0.25, 0.5});
}

TEST(Region, a_way_through_a_shape_crosses_its_surface_twice) {
  expect_crossings(box, {-1.0, 0.5, 0.5}, {3.0, 0.5, 0.5}, {0.25, 0.75});
  expect_crossings(ball, {0.0, 1.0, 0.0}, {2.0, 1.0, 0.0}, {0.25, 0.75});
  expect_crossings(rod, {-1.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {0.25, 0.75});
  expect_crossings(rod, {0.1, 0.1, -1.0}, {0.1, 0.1, 3.0}, {0.25, 0.75});
  expect_crossings(notched, {-1.0, 0.25, 0.0}, {3.0, 0.25, 0.0}, {0.375, 0.5625});
}

TEST(Region, a_way_into_a_shape_crosses_its_surface_once) {
  expect_crossings(below, {0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.25});
  expect_crossings(box, {1.0, 0.5, 0.5}, {5.0, 0.5, 0.5}, {0.25});
}

TEST(Region, a_way_that_misses_or_runs_beside_a_surface_crosses_nothing) {
  expect_crossings(box, {-1.0, 3.0, 0.5}, {3.0, 3.0, 0.5}, {});
  expect_crossings(ball, {0.0, 2.0, 0.0}, {2.0, 2.0, 0.0}, {});
  expect_crossings(rod, {2.0, 0.0, 0.0}, {2.0, 0.0, 3.0}, {});
  expect_crossings(below, {0.0, 0.25, 0.0}, {1.0, 0.25, 0.0}, {});
  expect_crossings(notched, {3.0, -1.0, 0.0}, {3.0, 1.0, 0.0}, {});
}

rc::Gen<Point> any_point() {
  return rc::gen::map(rc::gen::container<std::array<int, 3>>(rc::gen::inRange(-200, 301)), [](const auto& parts) {
    return Point{parts[0] * 0.01 + 0.001, parts[1] * 0.01 + 0.002, parts[2] * 0.01 + 0.003};
  });
}

RC_GTEST_PROP(Region, between_two_neighbouring_crossings_a_way_stays_on_one_side, ()) {
  const Shape shape = *rc::gen::element(box, ball, rod, strip, below, notched);
  const Point a = *any_point();
  const Point b = *any_point();
  std::vector<double> shares = crossings(shape, a, b);
  shares.insert(shares.begin(), 0.0);
  shares.push_back(1.0);
  for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
    if (shares[k + 1] - shares[k] < 1e-6) continue;
    const auto inside_at = [&](double part) {
      const double u = shares[k] + part * (shares[k + 1] - shares[k]);
      return contains(shape, {a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1]), a[2] + u * (b[2] - a[2])}, 0.0);
    };
    for (const double part : {0.1, 0.3, 0.7, 0.9}) RC_ASSERT(inside_at(part) == inside_at(0.5));
  }
}

struct FaultyShape {
  Shape shape;
  int dimension;
  std::string words;
};

TEST(Region, faults_are_named) {
  const double nan = std::nan("");
  const std::vector<FaultyShape> cases{
      {Box{{0.0}, {1.0, 1.0}}, 2, "'from' has 1 coordinates. Give 2"},
      {Box{{0.0, 0.0}, {1.0, 0.0}}, 2, "along y. Give the lower corner first"},
      {Box{{0.0, nan}, {1.0, 1.0}}, 2, "'from' is not finite"},
      {Ball{{0.0, 0.0, 0.0}, 1.0}, 2, "'centre' has 3 coordinates. Give 2"},
      {Ball{{0.0, 0.0}, 0.0}, 2, "'radius' must be positive"},
      {Cylinder{{0.0}, {1.0}, 1.0}, 1, "Use a box in 1-D"},
      {Cylinder{{0.0, 1.0}, {0.0, 1.0}, 1.0}, 2, "the same point"},
      {Cylinder{{0.0, 1.0}, {0.0, 2.0}, -1.0}, 2, "'radius' must be positive"},
      {HalfSpace{{0.0, 0.0}, 1.0}, 2, "'normal' has no direction"},
      {HalfSpace{{0.0, 1.0}, nan}, 2, "'offset' is not finite"},
      {Polygon{{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}, 1, "Use a box in 1-D"},
      {Polygon{{{0.0, 0.0}, {1.0, 0.0}}}, 2, "fewer than three corners"},
      {Polygon{{{0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0}}}, 3, "two entries, x and y"},
      {Polygon{{{0.0, 0.0}, {1.0, 0.0}, {0.0, nan}}}, 2, "not finite"},
      {Polygon{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 0.0}}}, 2, "repeats the first"},
      {Polygon{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}, 2, "the same point"},
      {Polygon{{{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}}, 2, "no area"},
      {Polygon{{{0.0, 0.0}, {2.0, 1.0}, {2.0, 0.0}, {0.0, 2.0}}}, 2, "meet or cross"}};
  for (const auto& [shape, dimension, words] : cases) {
    EXPECT_NE(find_fault(shape, dimension).find(words), std::string::npos) << "got: " << find_fault(shape, dimension);
  }
}

TEST(Region, sound_shapes_have_no_fault) {
  for (const Shape& shape : {box, ball, rod, notched, below}) EXPECT_EQ(find_fault(shape, 3), "");
  EXPECT_EQ(find_fault(strip, 2), "");
  EXPECT_EQ(find_fault(Box{{0.0}, {1.0}}, 1), "");
}

}  // namespace
}  // namespace peritherm
