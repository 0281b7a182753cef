#include <gtest/gtest.h>

#include <cmath>

#include "peritherm/geometry/region.hpp"
#include "peritherm/geometry/vector.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double edge_slack = 1e-6;

void expect_outward_normal(const Shape& shape, const Point& place, const Point& outwards, const Point& expected) {
  const Point normal = surface_normal(shape, place, outwards, edge_slack);
  EXPECT_LE(length(difference(normal, expected)), rounding(4, 1.0)) << shape.index();
}

void expect_normal(const Shape& shape, const Point& place, const Point& expected) {
  expect_outward_normal(shape, place, expected, expected);
}

TEST(SurfaceNormal, points_out_of_every_shape) {
  expect_normal(Box{{0.0, 0.0}, {2.0, 1.0}}, {0.0, 0.3, 0.0}, {-1.0, 0.0, 0.0});
  expect_normal(Box{{0.0, 0.0}, {2.0, 1.0}}, {1.7, 1.0, 0.0}, {0.0, 1.0, 0.0});
  expect_normal(Box{{2.0}, {3.0}}, {3.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  expect_normal(Ball{{1.0, 1.0, 1.0}, 0.5}, {1.3, 1.0, 1.4}, {0.6, 0.0, 0.8});
  expect_normal(Cylinder{{0.0, 0.0, 0.0}, {0.0, 0.0, 2.0}, 0.5}, {0.3, -0.4, 1.0}, {0.6, -0.8, 0.0});
  expect_normal(Cylinder{{0.0, 0.0, 0.0}, {0.0, 0.0, 2.0}, 0.5}, {0.1, 0.2, 2.0}, {0.0, 0.0, 1.0});
  expect_normal(Cylinder{{0.0, 0.0}, {3.0, 4.0}, 1.0}, {2.3, 1.4, 0.0}, {0.8, -0.6, 0.0});
  expect_normal(HalfSpace{{30.0, 40.0}, 1.0}, {0.6, 0.8, 0.0}, {0.6, 0.8, 0.0});
}

TEST(SurfaceNormal, of_a_polygon_points_outwards_whichever_way_its_corners_run) {
  const Polygon triangle{{{0.0, 0.0}, {4.0, 0.0}, {0.0, 3.0}}};
  const Polygon turned{{{0.0, 0.0}, {0.0, 3.0}, {4.0, 0.0}}};
  for (const Shape& shape : {Shape(triangle), Shape(turned)}) {
    expect_normal(shape, {1.0, 0.0, 0.0}, {0.0, -1.0, 0.0});
    expect_normal(shape, {2.0, 1.5, 0.0}, {0.6, 0.8, 0.0});
  }
}

TEST(SurfaceNormal, at_an_edge_lies_half_way_between_those_of_the_faces) {
  const double half = std::sqrt(0.5);
  expect_normal(Box{{0.0, 0.0}, {2.0, 1.0}}, {2.0, 0.0, 0.0}, {half, -half, 0.0});
  expect_normal(Polygon{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}}}, {2.0, 0.0, 0.0}, {half, -half, 0.0});
  expect_normal(Cylinder{{0.0, 0.0}, {0.0, 2.0}, 0.5}, {0.5, 2.0, 0.0}, {half, half, 0.0});
  // Rounding decides nothing there.
  expect_normal(Box{{0.0, 0.0}, {2.0, 1.0}}, {2.0, 1e-12, 0.0}, {half, -half, 0.0});
}

TEST(SurfaceNormal, leaves_out_faces_that_are_grazed_or_entered) {
  const Shape square = Box{{0.0, 0.0}, {2.0, 1.0}};
  expect_outward_normal(square, {2.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  expect_outward_normal(square, {2.0, 0.0, 0.0}, {0.0, -0.1, 0.0}, {0.0, -1.0, 0.0});
  expect_outward_normal(square, {2.0, 0.0, 0.0}, {0.2, 0.3, 0.0}, {1.0, 0.0, 0.0});
  expect_outward_normal(square, {2.0, 0.5, 0.0}, {0.0, 1.0, 0.0}, {});
  expect_outward_normal(square, {2.0, 0.5, 0.0}, {-1.0, 0.0, 0.0}, {});
}

TEST(SurfaceNormal, is_nothing_where_no_direction_is_outwards) {
  expect_outward_normal(Ball{{1.0, 1.0}, 0.5}, {1.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {});
}

}  // namespace
}  // namespace peritherm
