#include "peritherm/geometry/crack.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double spacing = 0.1;
constexpr double nudge_length = 1e-6 * spacing;

Crack along(std::vector<Coordinates> points) {
  Crack crack;
  crack.points = std::move(points);
  return crack;
}

Crack growing(Crack crack, double start_time, double tip_speed) {
  crack.start_time = start_time;
  crack.tip_speed = tip_speed;
  return crack;
}

Crack penny() {
  Crack crack;
  crack.disc = Disc{{0.0, 0.0, 1.0}, {0.0, 0.0, 2.0}, 0.5};
  return crack;
}

Point nudged(const CrackSurface& surface, Point x) {
  Point shift{};
  surface.nudge(x, shift);
  for (int axis = 0; axis < 3; ++axis) x[axis] += shift[axis];
  return x;
}

std::optional<double> time_between(const CrackSurface& surface, const Point& a, const Point& b) {
  return surface.crossing_time(nudged(surface, a), nudged(surface, b));
}

bool cuts(const CrackSurface& surface, const Point& a, const Point& b) {
  return time_between(surface, a, b).has_value();
}

const Crack row = along({{-0.5, 0.0}, {0.5, 0.0}});
const Crack square = along({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}});

TEST(Crack, in_one_dimension_a_point_on_the_crack_belongs_to_its_right) {
  const CrackSurface surface(along({{0.3}}), 1, spacing);
  EXPECT_NEAR(nudged(surface, {3 * 0.1, 0.0, 0.0})[0] - 0.3, nudge_length, rounding(4, 1.0));
  EXPECT_TRUE(cuts(surface, {0.2, 0.0, 0.0}, {0.3, 0.0, 0.0}));
  EXPECT_TRUE(cuts(surface, {0.2, 0.0, 0.0}, {0.4, 0.0, 0.0}));
  EXPECT_FALSE(cuts(surface, {0.3, 0.0, 0.0}, {0.4, 0.0, 0.0}));
  EXPECT_FALSE(cuts(surface, {0.1, 0.0, 0.0}, {0.2, 0.0, 0.0}));
}

TEST(Crack, a_point_on_the_crack_belongs_to_its_left_side) {
  const CrackSurface surface(row, 2, spacing);
  EXPECT_DOUBLE_EQ(nudged(surface, {0.2, 0.0, 0.0})[1], nudge_length);
  const CrackSurface reversed(along({{0.5, 0.0}, {-0.5, 0.0}}), 2, spacing);
  EXPECT_DOUBLE_EQ(nudged(reversed, {0.2, 0.0, 0.0})[1], -nudge_length);
}

TEST(Crack, points_off_the_crack_stay_where_they_are) {
  const CrackSurface surface(row, 2, spacing);
  for (const Point& x : {Point{0.2, 1e-8, 0.0}, Point{0.6, 0.0, 0.0}, Point{0.2, -0.1, 0.0}}) {
    EXPECT_EQ(nudged(surface, x), x);
  }
}

TEST(Crack, every_bond_that_leaves_a_row_of_points_on_the_crack_to_the_right_is_cut) {
  const CrackSurface surface(row, 2, spacing);
  for (const double noise : {0.0, 1e-16, -1e-16}) {
    EXPECT_TRUE(cuts(surface, {0.2, noise, 0.0}, {0.2, -0.1, 0.0}));
    EXPECT_TRUE(cuts(surface, {0.2, 0.1, 0.0}, {0.3, -0.1, 0.0}));
    EXPECT_FALSE(cuts(surface, {0.2, noise, 0.0}, {0.2, 0.1, 0.0}));
    EXPECT_FALSE(cuts(surface, {0.2, noise, 0.0}, {0.3, -noise, 0.0}));
  }
}

TEST(Crack, a_bond_along_the_line_of_the_crack_is_not_cut) {
  const CrackSurface surface(row, 2, spacing);
  EXPECT_FALSE(cuts(surface, {0.4, 0.0, 0.0}, {0.6, 0.0, 0.0}));
  EXPECT_FALSE(cuts(surface, {-0.6, 1e-17, 0.0}, {0.6, -1e-17, 0.0}));
}

TEST(Crack, a_bond_through_the_tip_or_beyond_it_is_whole) {
  const CrackSurface surface(row, 2, spacing);
  EXPECT_FALSE(cuts(surface, {0.4, -0.1, 0.0}, {0.6, 0.1, 0.0}));
  EXPECT_FALSE(cuts(surface, {-0.5, -0.1, 0.0}, {-0.5, 0.1, 0.0}));
  EXPECT_TRUE(cuts(surface, {0.39, -0.1, 0.0}, {0.59, 0.1, 0.0}));
  EXPECT_FALSE(cuts(surface, {0.41, -0.1, 0.0}, {0.61, 0.1, 0.0}));
  EXPECT_FALSE(cuts(surface, {0.6, 0.0, 0.0}, {0.4, -0.2, 0.0}));
}

TEST(Crack, the_crossing_point_decides_when_a_growing_crack_cuts) {
  const CrackSurface surface(growing(row, 2.0, 0.25), 2, spacing);
  EXPECT_DOUBLE_EQ(*time_between(surface, {0.0, -0.1, 0.0}, {0.0, 0.1, 0.0}), 2.0 + 0.5 / 0.25);
  EXPECT_DOUBLE_EQ(*time_between(surface, {0.3, 0.1, 0.0}, {0.2, -0.1, 0.0}), 2.0 + 0.75 / 0.25);
}

TEST(Crack, growth_follows_the_length_of_a_polyline) {
  const CrackSurface surface(growing(along({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}), 0.0, 2.0), 2, spacing);
  EXPECT_DOUBLE_EQ(*time_between(surface, {0.9, 0.5, 0.0}, {1.1, 0.5, 0.0}), 0.75);
}

TEST(Crack, a_bond_across_two_segments_is_cut_when_the_tip_passes_first) {
  const CrackSurface surface(growing(along({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}), 0.0, 1.0), 2, spacing);
  EXPECT_DOUBLE_EQ(*time_between(surface, {0.5, -0.1, 0.0}, {0.5, 1.1, 0.0}), 0.5);
}

TEST(Crack, a_standing_crack_cuts_at_its_start_time) {
  Crack late = row;
  late.start_time = 3.0;
  const CrackSurface surface(late, 2, spacing);
  EXPECT_EQ(time_between(surface, {0.3, 0.1, 0.0}, {0.2, -0.1, 0.0}), 3.0);
  EXPECT_TRUE(surface.changes_in_time());
  EXPECT_FALSE(CrackSurface(row, 2, spacing).changes_in_time());
}

// Bonds of horizon 6.5 dx (reach 7 dx) on 61² points of [-1, 1]² that cracks cut.
long cut_bonds(const std::vector<Crack>& cracks) {
  constexpr int n = 60;
  const auto at = [](int i, int j) { return Point{-1.0 + 2.0 * i / n, -1.0 + 2.0 * j / n, 0.0}; };
  std::vector<CrackSurface> surfaces;
  for (const Crack& crack : cracks) surfaces.emplace_back(crack, 2, 2.0 / n);
  long count = 0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int di = 0; di <= 6; ++di) {
        for (int dj = di == 0 ? 1 : -6; dj <= 6; ++dj) {
          if (di * di + dj * dj >= 49 || i + di > n || j + dj < 0 || j + dj > n) continue;
          for (const CrackSurface& surface : surfaces) {
            if (!cuts(surface, at(i, j), at(i + di, j + dj))) continue;
            ++count;
            break;
          }
        }
      }
    }
  }
  return count;
}

// Counted by an independent program.
TEST(Crack, the_known_numbers_of_bonds_are_cut) {
  EXPECT_EQ(cut_bonds({along({{-0.500001, 1e-6}, {0.500001, 1e-6}})}), 6325);
  EXPECT_EQ(cut_bonds({along({{-0.655, -0.25480762113533156}, {-0.355, 0.26480762113533157}}),
                       along({{0.655, -0.25480762113533156}, {0.355, 0.26480762113533157}})}),
            7458);
  EXPECT_EQ(cut_bonds({along({{-0.5, -0.496}, {0.5, 0.504}}), along({{0.5, -0.496}, {-0.5, 0.504}})}), 17079);
}

RC_GTEST_PROP(Crack, a_polyline_through_points_of_the_grid_leaks_nowhere, ()) {
  constexpr int width = 8;
  const auto heights = *rc::gen::container<std::array<int, 3>>(rc::gen::inRange(2, 7));
  const std::array<double, 4> places{-1.0, 3.0, 5.0, width + 1.0};
  const std::array<double, 4> levels{1.0 * heights[0], 1.0 * heights[1], 1.0 * heights[2], 1.0 * heights[2]};
  std::vector<Coordinates> corners;
  for (int k = 0; k < 4; ++k) corners.push_back({places[k] * spacing, levels[k] * spacing});
  const CrackSurface surface(along(corners), 2, spacing);
  const auto is_above = [&](int i, int j) {
    const int k = i < 3 ? 0 : (i < 5 ? 1 : 2);
    const double slope = (levels[k + 1] - levels[k]) / (places[k + 1] - places[k]);
    return j >= levels[k] + slope * (i - places[k]) - 1e-9;
  };
  for (int i = 0; i <= width; ++i) {
    for (int j = 0; j <= width; ++j) {
      for (int p = 0; p <= width; ++p) {
        for (int q = 0; q <= width; ++q) {
          if (is_above(i, j) == is_above(p, q)) continue;
          RC_ASSERT(cuts(surface, {i * spacing, j * spacing, 0.0}, {p * spacing, q * spacing, 0.0}));
        }
      }
    }
  }
}

TEST(Crack, a_closed_polyline_separates_inside_from_outside_and_keeps_its_own_points) {
  const CrackSurface surface(along({{0.2, 0.2}, {0.6, 0.2}, {0.6, 0.6}, {0.2, 0.6}, {0.2, 0.2}}), 2, spacing);
  const auto is_inside = [](int i, int j) { return i >= 2 && i <= 6 && j >= 2 && j <= 6; };
  for (int inside = 0; inside < 81; ++inside) {
    for (int outside = 0; outside < 81; ++outside) {
      if (!is_inside(inside % 9, inside / 9) || is_inside(outside % 9, outside / 9)) continue;
      EXPECT_TRUE(cuts(surface, {inside % 9 * spacing, inside / 9 * spacing, 0.0},
                       {outside % 9 * spacing, outside / 9 * spacing, 0.0}));
    }
  }
}

TEST(Crack, a_point_on_a_plane_crack_belongs_to_the_side_of_its_normal) {
  const CrackSurface surface(square, 3, spacing);
  EXPECT_DOUBLE_EQ(nudged(surface, {0.5, 0.5, 0.0})[2], nudge_length);
  EXPECT_DOUBLE_EQ(nudged(surface, {1.0, 0.5, 0.0})[2], nudge_length);
  EXPECT_EQ(nudged(surface, {1.1, 0.5, 0.0})[2], 0.0);
  const CrackSurface disc(penny(), 3, spacing);
  EXPECT_DOUBLE_EQ(nudged(disc, {0.0, 0.5, 1.0})[2], 1.0 + nudge_length);
  EXPECT_EQ(nudged(disc, {0.4, 0.4, 1.0})[2], 1.0);
}

TEST(Crack, a_plane_crack_cuts_the_bonds_through_it_and_its_edge_only) {
  const CrackSurface surface(square, 3, spacing);
  EXPECT_TRUE(cuts(surface, {0.5, 0.5, -0.1}, {0.5, 0.5, 0.0}));
  EXPECT_TRUE(cuts(surface, {0.9, 0.5, -0.1}, {1.1, 0.5, 0.1}));
  EXPECT_FALSE(cuts(surface, {1.0, 0.5, -0.1}, {1.1, 0.5, 0.1}));
  EXPECT_FALSE(cuts(surface, {0.5, 0.5, 0.0}, {0.5, 0.6, 0.1}));
  EXPECT_FALSE(cuts(surface, {0.9, 0.5, 0.0}, {1.2, 0.5, 0.0}));
}

TEST(Crack, a_notched_plane_crack_leaves_the_bonds_through_its_notch) {
  const CrackSurface surface(along({{0.0, 0.0, 0.0}, {2.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 1.0, 0.0}}), 3, spacing);
  EXPECT_TRUE(cuts(surface, {0.5, 0.0, -0.1}, {0.5, 0.0, 0.1}));
  EXPECT_FALSE(cuts(surface, {1.5, 0.0, -0.1}, {1.5, 0.0, 0.1}));
}

TEST(Crack, a_plane_crack_grows_from_its_first_edge_and_a_disc_from_its_centre) {
  const CrackSurface front(growing(square, 1.0, 0.5), 3, spacing);
  EXPECT_DOUBLE_EQ(*time_between(front, {0.2, 0.25, -0.1}, {0.2, 0.25, 0.1}), 1.5);
  const CrackSurface disc(growing(penny(), 1.0, 0.5), 3, spacing);
  EXPECT_DOUBLE_EQ(*time_between(disc, {0.3, 0.4, 0.9}, {0.3, 0.4, 1.1}), 2.0);
  EXPECT_FALSE(cuts(disc, {0.4, 0.4, 0.9}, {0.4, 0.4, 1.1}));
}

RC_GTEST_PROP(Crack, both_directions_of_a_bond_give_the_same_bits, ()) {
  const auto coordinate = rc::gen::map(rc::gen::inRange(-1000, 1001), [](int part) { return part * 0.00137; });
  const Point a{*coordinate, *coordinate, *coordinate};
  const Point b{*coordinate, *coordinate, *coordinate};
  const CrackSurface surface(
      growing(along({{-0.9, -0.8, 0.1}, {0.9, -0.8, -0.1}, {0.9, 0.8, 0.0}, {-0.9, 0.8, 0.2}}), 0.1, 0.7), 3, spacing);
  RC_ASSERT(surface.crossing_time(a, b) == surface.crossing_time(b, a));
  const CrackSurface line(growing(along({{-0.9, -0.8}, {0.3, 0.1}, {0.7, -0.2}}), 0.1, 0.7), 2, spacing);
  RC_ASSERT(line.crossing_time({a[0], a[1], 0.0}, {b[0], b[1], 0.0}) ==
            line.crossing_time({b[0], b[1], 0.0}, {a[0], a[1], 0.0}));
}

TEST(Crack, bounds_enclose_the_crack) {
  EXPECT_EQ(CrackSurface(row, 2, spacing).bounds(), (std::array<Point, 2>{{{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}}}));
  EXPECT_EQ(CrackSurface(penny(), 3, spacing).bounds(), (std::array<Point, 2>{{{-0.5, -0.5, 1.0}, {0.5, 0.5, 1.0}}}));
}

TEST(Crack, tells_how_far_it_has_grown_when_it_reaches_a_place) {
  const CrackSurface bent(along({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}), 2, spacing);
  EXPECT_DOUBLE_EQ(bent.full_length(), 2.0);
  EXPECT_DOUBLE_EQ(bent.length_to({0.3, 0.2, 0.0}), 0.3);
  EXPECT_DOUBLE_EQ(bent.length_to({1.2, 0.4, 0.0}), 1.4);
  EXPECT_DOUBLE_EQ(bent.length_to({1.1, 1.5, 0.0}), 2.5);
  EXPECT_DOUBLE_EQ(bent.length_to({-0.5, 0.1, 0.0}), -0.5);
  const CrackSurface plane(along({{0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}}), 3, spacing);
  EXPECT_DOUBLE_EQ(plane.full_length(), 3.0);
  EXPECT_DOUBLE_EQ(plane.length_to({0.7, 1.25, 0.4}), 1.25);
}

TEST(Crack, shorter_than_a_spacing_is_only_cut) {
  Crack crack = along({{0.0, 0.0}, {0.09, 0.0}});
  crack.faces = Faces::mirror;
  EXPECT_TRUE(CrackSurface(crack, 2, spacing).is_too_short_to_mirror());
  EXPECT_FALSE(CrackSurface(crack, 2, spacing).mirrors());
  crack.points[1] = {0.2, 0.0};
  EXPECT_TRUE(CrackSurface(crack, 2, spacing).mirrors());
}

}  // namespace
}  // namespace peritherm
