#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/divided_body.hpp"

namespace peritherm {
namespace {

const PartBackground around_cut{"matrix", 0, 0.1};

PartRegion cut_region(Shape shape, MaterialIndex material = 1, const std::string& name = "inclusion") {
  PartRegion made;
  made.shape = std::move(shape);
  made.name = name;
  made.material = material;
  return made;
}

double area_between(const DividedBody& body, int first, int second) {
  double sum = 0.0;
  for (const SurfacePoint& point : body.surface) {
    if (point.first == first && point.second == second) sum += point.area;
  }
  return sum;
}

double area_of_face(const DividedBody& body, Face face) {
  double sum = 0.0;
  for (const SurfacePoint& point : body.surface) {
    if (point.face == static_cast<int>(face)) sum += point.area;
  }
  return sum;
}

double volume_of_all(const DividedBody& body) {
  double sum = 0.0;
  for (const SubDomain& part : body.parts) sum += volume_of(part);
  return sum;
}

/// How far from a ball of radius 0.3 in a box of so many cells volume, area and places of the surface are.
struct BallErrors {
  double volume, area, place;
};
BallErrors errors_of_ball(int dimension, int cells) {
  Ball ball{Coordinates(static_cast<std::size_t>(dimension), 0.5), 0.3};
  ball.centre[0] = 0.47;
  const DividedBody body = divide_body(unit_box(dimension, cells), around_cut, {cut_region(ball)});
  expect_closed(body);
  EXPECT_EQ(body.parts.size(), 2u);
  const double pi = std::numbers::pi, r = ball.radius;
  const double volume = dimension == 2 ? pi * r * r : 4.0 / 3.0 * pi * r * r * r;
  const double area = dimension == 2 ? 2.0 * pi * r : 4.0 * pi * r * r;
  double place = 0.0;
  for (const SurfacePoint& point : body.surface) {
    if (point.second == 1) place = std::max(place, std::abs(height_above(ball, point.position)));
  }
  return {volume - volume_of(body.parts[1]), area - area_between(body, 0, 1), place};
}

TEST(CutBodies, volume_and_surface_of_a_ball_are_right_to_second_order) {
  for (const auto& [dimension, cells] : {std::pair{2, 20}, std::pair{3, 12}}) {
    const BallErrors coarse = errors_of_ball(dimension, cells);
    const BallErrors fine = errors_of_ball(dimension, 2 * cells);
    EXPECT_NEAR(std::log2(coarse.volume / fine.volume), 2.0, 0.1);
    EXPECT_NEAR(std::log2(coarse.area / fine.area), 2.0, 0.2);
    // A piece that spans two cells, and is moved by what merging left, stays within the sagitta of such a chord.
    const double h = 1.0 / cells;
    EXPECT_LT(coarse.place, (2.0 * h) * (2.0 * h) / (8.0 * 0.3) * (dimension - 1));
    EXPECT_LT(fine.place, h * h / (8.0 * 0.3) * (dimension - 1));
  }
}

TEST(CutBodies, an_inclined_plane_is_exact) {
  for (int dimension = 2; dimension <= 3; ++dimension) {
    HalfSpace half{{0.6, 0.8}, 0.61};
    if (dimension == 3) half.normal.push_back(0.0);
    const DividedBody body = divide_body(unit_box(dimension, 16), around_cut, {cut_region(half)});
    ASSERT_EQ(body.parts.size(), 2u);
    expect_closed(body);
    // Corners cut off the square by 0.6 x + 0.8 y = 0.61: (0, 0.7625) and (1, 0.0125).
    EXPECT_NEAR(volume_of(body.parts[0]), 0.5 * (0.7625 + 0.0125), rounding(body.parts[0].size(), 1.0));
    EXPECT_NEAR(area_between(body, 0, 1), std::hypot(1.0, 0.75), rounding(body.surface.size(), 1.0));
    for (const SurfacePoint& point : body.surface) {
      if (point.second != 1) continue;
      EXPECT_NEAR(height_above(half, point.position), 0.0, rounding(10, 1.0));
      EXPECT_NEAR(point.normal[0], 0.6, rounding(100, 1.0));
    }
  }
}

TEST(CutBodies, faces_of_the_box_are_covered_whatever_is_cut) {
  const Polygon wedge{{{-0.1, 0.2}, {0.55, 0.31}, {1.2, 0.1}, {1.2, 0.77}, {-0.1, 0.63}}};
  for (int dimension = 2; dimension <= 3; ++dimension) {
    const DividedBody body = divide_body(unit_box(dimension, 16), around_cut, {cut_region(wedge)});
    EXPECT_EQ(body.parts.size(), 3u);
    for (int n = 0; n < 2 * dimension; ++n) {
      EXPECT_NEAR(area_of_face(body, static_cast<Face>(n)), 1.0, rounding(body.surface.size(), 1.0));
    }
    EXPECT_NEAR(volume_of_all(body), 1.0, rounding(unit_box(dimension, 16).size(), 1.0));
    expect_closed(body);
  }
}

TEST(CutBodies, surface_points_are_about_two_spacings_apart) {
  const double h = 1.0 / 40;
  const DividedBody body = divide_body(unit_box(2, 40), around_cut, {cut_region(Ball{{0.5, 0.5}, 0.3})});
  double count = 0.0;
  for (const SurfacePoint& point : body.surface) {
    if (point.second != 1) continue;
    ++count;
    EXPECT_GT(point.area, 0.9 * 1.4 * h);          // smaller ones merge with any
    EXPECT_LT(point.area, (3.6 + 0.9 * 1.4) * h);  // with which they make this at most
    for (const SurfacePoint& other : body.surface) {
      if (&other == &point || other.second != 1) continue;
      EXPECT_GT(length(difference(other.position, point.position)), h);
    }
  }
  EXPECT_NEAR(area_between(body, 0, 1) / count, 2.0 * h, 0.5 * h);
}

TEST(CutBodies, shapes_that_touch_leave_nothing_between_them) {
  // Neither the film's lower side nor the ball is along cells; both pairs of surfaces coincide.
  const HalfSpace substrate{{0.0, 1.0}, 0.333};
  const Box film{{0.0, 0.333}, {1.0, 0.75}};
  const DividedBody body = divide_body(unit_box(2, 15), {"void", no_material, 0.1},
                                       {cut_region(substrate, 1, "substrate"), cut_region(film, 2, "film")});
  ASSERT_EQ(body.parts.size(), 2u);
  EXPECT_NEAR(volume_of(body.parts[0]), 0.333, rounding(225, 1.0));
  EXPECT_NEAR(volume_of(body.parts[1]), 0.75 - 0.333, rounding(225, 1.0));
  EXPECT_NEAR(area_between(body, 0, 1), 1.0, rounding(15, 1.0));
  expect_closed(body);
}

TEST(CutBodies, many_shapes_close_around_every_part) {
  const DividedBody body = divide_body(unit_box(3, 16), around_cut,
                                       {cut_region(Cylinder{{0.5, 0.5, -0.1}, {0.5, 0.5, 1.1}, 0.4}, 1, "sleeve"),
                                        cut_region(Cylinder{{0.5, 0.5, -0.1}, {0.5, 0.5, 1.1}, 0.2}, 2, "core"),
                                        cut_region(Ball{{0.0, 0.0, 0.0}, 0.3}, no_material),
                                        cut_region(Box{{0.0, 0.0, 0.75}, {1.0, 1.0, 1.0}}, 3, "lid")});
  EXPECT_EQ(body.parts.size(), 4u);
  expect_closed(body);
}

TEST(CutBodies, two_inclusions_are_two_parts_with_their_own_volumes) {
  const DividedBody body = divide_body(unit_box(2, 32), around_cut,
                                       {cut_region(Ball{{0.3, 0.3}, 0.15}), cut_region(Ball{{0.7, 0.7}, 0.15})});
  ASSERT_EQ(body.parts.size(), 3u);
  EXPECT_NEAR(volume_of(body.parts[1]), volume_of(body.parts[2]), 1.0 / (32 * 32));
  expect_closed(body);
}

TEST(CutBodies, ends_of_a_rod_may_lie_anywhere_in_a_cell) {
  const DividedBody body = divide_body(unit_box(1, 20), around_cut, {cut_region(Box{{0.312}, {0.777}})});
  ASSERT_EQ(body.parts.size(), 3u);
  EXPECT_NEAR(volume_of(body.parts[1]), 0.777 - 0.312, rounding(20, 1.0));
  expect_closed(body);
}

TEST(CutBodies, what_is_thinner_than_a_cell_is_refused_with_its_place) {
  const Box slit{{0.1, 0.51}, {0.9, 0.53}};  // a fortieth, in cells of a twentieth
  try {
    divide_body(unit_box(2, 20), around_cut, {cut_region(slit, 1, "slit")});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.issues()[0].problem.find("'slit' is thinner than a cell"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace peritherm
