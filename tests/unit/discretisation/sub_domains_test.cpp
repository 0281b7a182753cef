#include "peritherm/discretisation/sub_domains.hpp"

#include <gtest/gtest.h>

#include "support/divided_body.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

const PartBackground matrix{"matrix", 0, 0.3};

PartRegion region(const std::string& name, MaterialIndex material, Shape shape) {
  PartRegion made;
  made.shape = std::move(shape);
  made.name = name;
  made.material = material;
  return made;
}

TEST(SubDomains, a_body_without_regions_is_one_part_with_a_surface_point_per_face_of_a_cell) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    const Grid grid = unit_box(dimension, 4);
    const DividedBody body = divide_body(grid, matrix, {});
    ASSERT_EQ(body.parts.size(), 1u);
    EXPECT_EQ(body.parts[0].name, "matrix");
    EXPECT_EQ(body.parts[0].size(), grid.size());
    EXPECT_EQ(body.surface.size(), dimension == 1 ? 2u : dimension == 2 ? 16u : 96u);
    for (const SurfacePoint& point : body.surface) EXPECT_GE(point.face, 0);
    expect_closed(body);
  }
}

TEST(SubDomains, points_of_a_grid_stand_in_the_centres_of_cells_with_equal_volumes) {
  const Grid grid = unit_box(2, 4);
  const DividedBody body = divide_body(grid, matrix, {region("film", 1, Box{{0.0, 0.75}, {1.0, 1.0}})});
  ASSERT_EQ(body.parts.size(), 2u);
  EXPECT_EQ(body.parts[1].name, "film");
  EXPECT_EQ(body.parts[1].material, 1);
  EXPECT_EQ(body.parts[1].horizon, 0.3);
  ASSERT_EQ(body.parts[1].size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(body.parts[1].volumes[i], grid.cell_volume());
    EXPECT_EQ(body.parts[1].positions[i], grid.position(body.parts[1].places[i]));
  }
}

TEST(SubDomains, parts_meet_at_the_faces_between_their_cells) {
  const DividedBody body =
      divide_body(unit_box(3, 4), matrix, {region("block", 1, Box{{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}})});
  ASSERT_EQ(body.parts.size(), 2u);
  double area = 0.0;
  for (const SurfacePoint& point : body.surface) {
    if (point.second < 0) continue;
    EXPECT_EQ(point.first, 0);
    EXPECT_EQ(point.second, 1);
    EXPECT_EQ(point.face, -1);
    // Out of the matrix, so towards the middle of the block.
    double towards = 0.0;
    for (int axis = 0; axis < 3; ++axis) towards += (0.5 - point.position[axis]) * point.normal[axis];
    EXPECT_DOUBLE_EQ(towards, 0.25);
    area += point.area;
  }
  EXPECT_NEAR(area, 6 * 0.25, rounding(24, 1.5));
  expect_closed(body);
}

TEST(SubDomains, pieces_that_do_not_hang_together_are_parts_of_their_own) {
  const DividedBody body = divide_body(
      unit_box(2, 8), matrix,
      {region("fibre", 1, Box{{0.125, 0.125}, {0.375, 0.375}}), region("fibre", 1, Box{{0.625, 0.625}, {0.875, 0.875}}),
       region("wire", 2, Box{{0.625, 0.125}, {0.875, 0.375}})});
  ASSERT_EQ(body.parts.size(), 4u);
  EXPECT_EQ(body.parts[1].name, "fibre 1");
  EXPECT_EQ(body.parts[2].name, "wire");
  EXPECT_EQ(body.parts[3].name, "fibre 2");
  expect_closed(body);
}

TEST(SubDomains, regions_of_one_name_and_material_that_touch_are_one_part) {
  const DividedBody body = divide_body(
      unit_box(2, 8), matrix,
      {region("fibre", 1, Box{{0.25, 0.25}, {0.5, 0.5}}), region("fibre", 1, Box{{0.5, 0.25}, {0.75, 0.5}})});
  ASSERT_EQ(body.parts.size(), 2u);
  EXPECT_EQ(body.parts[1].size(), 8u);
  expect_closed(body);
}

TEST(SubDomains, a_layer_across_the_body_divides_it) {
  const DividedBody body = divide_body(unit_box(1, 10), matrix, {region("film", 1, Box{{0.4}, {0.6}})});
  ASSERT_EQ(body.parts.size(), 3u);
  EXPECT_EQ(body.parts[0].name, "matrix 1");
  EXPECT_EQ(body.parts[1].name, "film");
  EXPECT_EQ(body.parts[2].name, "matrix 2");
  EXPECT_EQ(body.surface.size(), 4u);
  expect_closed(body);
}

TEST(SubDomains, what_is_cut_away_leaves_a_surface_that_is_no_face_of_the_box) {
  const DividedBody body =
      divide_body(unit_box(2, 8), matrix, {region("", no_material, Box{{0.25, 0.25}, {0.375, 0.75}})});
  ASSERT_EQ(body.parts.size(), 1u);
  std::size_t around = 0;
  for (const SurfacePoint& point : body.surface) around += point.second < 0 && point.face < 0;
  EXPECT_EQ(around, 10u);
  expect_closed(body);
}

TEST(SubDomains, a_region_without_points_is_refused_by_name) {
  try {
    divide_body(unit_box(2, 4), matrix, {region("far", 1, Box{{2.0, 2.0}, {3.0, 3.0}})});
    FAIL();
  } catch (const Error& error) {
    ASSERT_EQ(error.issues().size(), 1u);
    EXPECT_NE(error.issues()[0].problem.find("'far' has no points"), std::string::npos);
  }
}

}  // namespace
}  // namespace peritherm
