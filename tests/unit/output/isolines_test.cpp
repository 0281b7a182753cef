#include "peritherm/output/isolines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace peritherm {
namespace {

Samples sample(int columns, int rows, const std::function<double(int, int)>& value_at) {
  Samples samples{columns, rows, {}, {}};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) samples.values.push_back(value_at(i, j));
  }
  return samples;
}

TEST(Isolines, a_plane_has_one_straight_line_from_edge_to_edge) {
  const auto lines = find_isolines(sample(5, 4, [](int i, int) { return i; }), 1.25, 0.0);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].size(), 4U);
  for (const Place& place : lines[0]) EXPECT_DOUBLE_EQ(place.x, 1.25);
  EXPECT_DOUBLE_EQ(std::abs(lines[0].front().y - lines[0].back().y), 3.0);
}

TEST(Isolines, a_hill_has_one_closed_line_around_it) {
  const auto lines = find_isolines(sample(21, 21, [](int i, int j) { return std::hypot(i - 10, j - 10); }), 6.0, 0.0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  // Linear interpolation of the distance on a unit lattice is off by at most h² |f''| / 8 with f'' ≤ 1/r, r ≥ 5.
  for (const Place& place : lines[0]) EXPECT_NEAR(std::hypot(place.x - 10, place.y - 10), 6.0, 1.0 / (8.0 * 5.0));
}

TEST(Isolines, a_saddle_has_two_lines_that_do_not_meet) {
  const auto lines = find_isolines(sample(2, 2, [](int i, int j) { return i == j ? 1.0 : 0.0; }), 0.4, 0.0);
  ASSERT_EQ(lines.size(), 2U);
  // The middle, 0.5, lies above the level: each line cuts off one of the low corners (1, 0) and (0, 1).
  for (const Line& line : lines) {
    const bool at_first = line[0].x > 0.5 || line[0].y < 0.5;
    for (const Place& place : line) EXPECT_EQ(place.x - place.y > 0.0, at_first);
  }
}

TEST(Isolines, no_line_passes_a_hole_or_a_blocked_cell) {
  Samples samples = sample(3, 6, [](int i, int j) {
    return i == 0 && j == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(i);
  });
  samples.blocked.assign(2 * 5, false);
  samples.blocked[2 * 3] = true;
  const auto lines = find_isolines(samples, 0.5, 0.0);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].size() + lines[1].size(), 5U) << "rows 1 to 3 and rows 4 to 5";
}

TEST(Isolines, rounding_noise_on_a_plateau_makes_no_lines) {
  const auto noise = sample(9, 9, [](int i, int j) { return (i * 7 + j * 3) % 2 == 0 ? 1e-15 : -1e-15; });
  EXPECT_TRUE(find_isolines(noise, 0.0, 1e-6).empty());
  EXPECT_FALSE(find_isolines(noise, 0.0, 0.0).empty());
}

}  // namespace
}  // namespace peritherm
