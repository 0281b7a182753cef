#include "peritherm/discretisation/grid.hpp"

#include <gtest/gtest.h>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

Grid brick(int dimension, PointPlacement placement) {
  Grid grid;
  grid.dimension = dimension;
  grid.spacing = 0.1;
  grid.cells = {4, dimension > 1 ? 3 : 1, dimension > 2 ? 2 : 1};
  grid.origin = {-1.0, dimension > 1 ? 2.0 : 0.0, dimension > 2 ? 5.0 : 0.0};
  grid.placement = placement;
  return grid;
}

TEST(Grid, points_in_centres_are_as_many_as_cells) {
  EXPECT_EQ(brick(1, PointPlacement::centres).size(), 4u);
  EXPECT_EQ(brick(2, PointPlacement::centres).size(), 12u);
  EXPECT_EQ(brick(3, PointPlacement::centres).size(), 24u);
}

TEST(Grid, points_on_the_boundary_are_one_more_along_each_used_axis) {
  EXPECT_EQ(brick(1, PointPlacement::boundary).size(), 5u);
  EXPECT_EQ(brick(2, PointPlacement::boundary).size(), 20u);
  EXPECT_EQ(brick(3, PointPlacement::boundary).size(), 60u);
}

TEST(Grid, numbers_run_along_x_first_and_lead_back_to_their_index) {
  const Grid grid = brick(3, PointPlacement::boundary);
  EXPECT_EQ(grid.number({1, 0, 0}), 1u);
  EXPECT_EQ(grid.number({0, 1, 0}), 5u);
  EXPECT_EQ(grid.number({0, 0, 1}), 20u);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_TRUE(grid.contains(grid.index(i)));
    EXPECT_EQ(grid.number(grid.index(i)), i);
  }
}

TEST(Grid, first_points_stand_half_a_spacing_inside_or_on_the_boundary) {
  const Point centre = brick(3, PointPlacement::centres).position({0, 0, 0});
  const Point corner = brick(3, PointPlacement::boundary).position({0, 0, 0});
  EXPECT_DOUBLE_EQ(centre[0], -0.95);
  EXPECT_DOUBLE_EQ(centre[2], 5.05);
  EXPECT_EQ(corner, (Point{-1.0, 2.0, 5.0}));
}

TEST(Grid, unused_coordinates_are_zero) {
  EXPECT_EQ(brick(1, PointPlacement::centres).position({2, 0, 0})[1], 0.0);
  EXPECT_EQ(brick(2, PointPlacement::centres).position({2, 1, 0})[2], 0.0);
}

TEST(Grid, indices_outside_the_box_are_fictitious_points) {
  const Grid grid = brick(2, PointPlacement::centres);
  EXPECT_FALSE(grid.contains({-1, 0, 0}));
  EXPECT_FALSE(grid.contains({4, 0, 0}));
  EXPECT_FALSE(grid.contains({0, 0, 1}));
  EXPECT_DOUBLE_EQ(grid.position({-1, 0, 0})[0], -1.05);
}

TEST(Grid, volumes_of_the_points_add_up_to_the_box) {
  for (const PointPlacement placement : {PointPlacement::centres, PointPlacement::boundary}) {
    for (int dimension = 1; dimension <= 3; ++dimension) {
      const Grid grid = brick(dimension, placement);
      double sum = 0.0;
      for (std::size_t i = 0; i < grid.size(); ++i) sum += grid.volume_share(grid.index(i)) * grid.cell_volume();
      double box = 1.0;
      for (int axis = 0; axis < dimension; ++axis) box *= grid.length(axis);
      EXPECT_NEAR(sum, box, rounding(grid.size(), box));
    }
  }
}

TEST(Grid, points_on_faces_edges_and_corners_have_half_quarter_and_eighth_volumes) {
  const Grid grid = brick(3, PointPlacement::boundary);
  EXPECT_EQ(grid.volume_share({1, 1, 1}), 1.0);
  EXPECT_EQ(grid.volume_share({0, 1, 1}), 0.5);
  EXPECT_EQ(grid.volume_share({0, 3, 1}), 0.25);
  EXPECT_EQ(grid.volume_share({4, 3, 2}), 0.125);
}

}  // namespace
}  // namespace peritherm
