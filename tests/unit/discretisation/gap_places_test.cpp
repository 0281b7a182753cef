#include "peritherm/discretisation/gap_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

double sum_of(const GapPlace::Weights& weights, const Grid& grid, const Point& slope, double shift) {
  double sum = 0.0;
  for (const auto& [number, weight] : weights) {
    const Point x = grid.position(grid.index(number));
    sum += weight * (shift + slope[0] * x[0] + slope[1] * x[1] + slope[2] * x[2]);
  }
  return sum;
}

struct Parted {
  int dimension;
  std::vector<Coordinates> points;
  Point normal;  ///< to the upper side
};

TEST(GapPlaces, know_planes_on_either_side) {
  const Parted bodies[] = {{1, {{0.43}}, {1, 0, 0}},
                           {2, {{0.0, 0.5}, {1.0, 0.5}}, {0, 1, 0}},
                           {2, {{0.0, 0.31}, {1.0, 0.57}}, {-0.26, 1, 0}},
                           {3, {{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}}, {0, 0, 1}}};
  const Point slopes[] = {{1.0, -2.0, 0.5}, {3.0, 0.7, -1.0}};
  for (const auto& [dimension, points, normal] : bodies) {
    Problem problem = unit_body(dimension, dimension == 3 ? 6 : 10, dimension == 3 ? 1.5 : 2.5);
    Crack& crack = problem.cracks.emplace_back();
    crack.points = points;
    crack.gap = GapRadiation{{1.0, 1.0}, {}, 0.0};
    const Geometry geometry = make_geometry(problem);
    const Grid& grid = geometry.body.grid;
    const std::vector<GapPlace> places = find_gap_places(geometry.body, geometry.body.faces.points());
    ASSERT_EQ(places.size(), geometry.body.faces.points().size());
    for (const GapPlace& place : places) {
      ASSERT_GT(std::min(place.above.size(), place.below.size()), static_cast<std::size_t>(dimension));
      for (const auto& [weights, side] : {std::pair(&place.above, 1.0), std::pair(&place.below, -1.0)}) {
        for (const auto& [number, weight] : *weights) {
          const Point x = grid.position(grid.index(number));
          double height = 0.0;
          for (int axis = 0; axis < dimension; ++axis) height += normal[axis] * (x[axis] - place.position[axis]);
          EXPECT_GE(side * height, -1e-9);
        }
        for (const Point& slope : slopes) {
          const Point& x = place.position;
          const double right = 2.0 + slope[0] * x[0] + slope[1] * x[1] + slope[2] * x[2];
          EXPECT_NEAR(sum_of(*weights, grid, slope, 2.0), right, rounding(1000, 5.0));
        }
      }
    }
  }
}

TEST(GapPlaces, look_at_no_side_of_another_crack) {
  Problem problem = unit_body(2, 20, 3.0);
  problem.cracks.emplace_back().points = {{0.0, 0.5}, {1.0, 0.5}};
  problem.cracks.front().gap = GapRadiation{{1.0, 1.0}, {}, 0.0};
  problem.cracks.emplace_back().points = {{0.5, 0.0}, {0.5, 1.0}};
  const Geometry geometry = make_geometry(problem);
  const Grid& grid = geometry.body.grid;
  for (const GapPlace& place : find_gap_places(geometry.body, geometry.body.faces.points())) {
    for (const GapPlace::Weights* weights : {&place.above, &place.below}) {
      for (const auto& [number, weight] : *weights)
        EXPECT_EQ(grid.position(grid.index(number))[0] > 0.5, place.position[0] > 0.5);
    }
  }
}

TEST(GapPlaces, are_none_without_such_gaps) {
  Problem problem = unit_body(2, 20, 3.0);
  problem.cracks.emplace_back().points = {{0.2, 0.5}, {0.8, 0.5}};
  const Geometry geometry = make_geometry(problem);
  EXPECT_TRUE(find_gap_places(geometry.body, geometry.body.faces.points()).empty());
}

}  // namespace
}  // namespace peritherm
