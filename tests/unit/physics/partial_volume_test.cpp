#include "peritherm/physics/partial_volume.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double counting_error = 1e-11;  // what covered_volume promises

/// Σ of what counts over all neighbours, in cells.
double counted_sum(PartialVolumes rule, double ratio, int dimension) {
  const int limit = static_cast<int>(ratio + 1.5);
  double sum = 0.0;
  for (int z = dimension > 2 ? -limit : 0; z <= (dimension > 2 ? limit : 0); ++z) {
    for (int y = dimension > 1 ? -limit : 0; y <= (dimension > 1 ? limit : 0); ++y) {
      for (int x = -limit; x <= limit; ++x) {
        if (x != 0 || y != 0 || z != 0) sum += count_cell(rule, {x, y, z}, ratio, dimension).share;
      }
    }
  }
  return sum;
}

TEST(PartialVolume, whole_cells_count_up_to_the_edge_of_the_horizon) {
  EXPECT_EQ(count_cell(PartialVolumes::whole, {3, 0, 0}, 3.0, 1).share, 1.0);
  EXPECT_EQ(count_cell(PartialVolumes::whole, {3, 0, 0}, 2.99, 1).share, 0.0);
}

TEST(PartialVolume, a_point_on_the_edge_counts_in_spite_of_rounding) {
  const double rounded = 0.3 / (3 * 0.1) * 3.0;
  ASSERT_LT(rounded, 3.0);
  EXPECT_EQ(count_cell(PartialVolumes::whole, {3, 0, 0}, rounded, 1).share, 1.0);
  EXPECT_NEAR(count_cell(PartialVolumes::half, {3, 0, 0}, rounded, 1).share, 0.5, rounding(8, 3.0));
}

TEST(PartialVolume, halves_are_the_part_of_a_cell_within_the_horizon) {
  EXPECT_DOUBLE_EQ(count_cell(PartialVolumes::half, {3, 0, 0}, 3.0, 1).share, 0.5);
  EXPECT_NEAR(count_cell(PartialVolumes::half, {3, 0, 0}, 3.367, 1).share, 0.867, rounding(8, 3.0));
  EXPECT_EQ(count_cell(PartialVolumes::half, {4, 0, 0}, 3.367, 1).share, 0.0);
  EXPECT_EQ(count_cell(PartialVolumes::half, {2, 0, 0}, 3.367, 1).share, 1.0);
  // A quarter disc of radius 1 less the parts that lie in other cells.
  const double corner = count_cell(PartialVolumes::half, {1, 1, 0}, 1.0, 2).share;
  const double angle = std::acos(0.5) - std::asin(0.5);
  EXPECT_NEAR(corner, 0.5 * angle - 0.5 * (std::sqrt(0.75) - 0.5), counting_error);
}

TEST(PartialVolume, rules_that_take_the_distance_of_the_point_do_so) {
  for (const PartialVolumes rule :
       {PartialVolumes::whole, PartialVolumes::half, PartialVolumes::half_normalised, PartialVolumes::trapezoid}) {
    EXPECT_EQ(count_cell(rule, {2, 0, 0}, 3.0, 2).kernel_distance, 2.0) << name_of(rule);
  }
}

TEST(PartialVolume, a_cell_cut_by_the_horizon_counts_in_part_and_at_the_middle_of_that_part) {
  // The cell reaches from 2.5 to 3.5 and the horizon covers it up to 3.2: the middle is 2.85.
  const CountedCell inside = count_partial_area(3.0, 3.2);
  EXPECT_NEAR(inside.share, 0.7, rounding(4, 3.0));
  EXPECT_NEAR(inside.kernel_distance, 2.85, rounding(4, 3.0));
  const CountedCell outside = count_partial_area(3.0, 2.8);
  EXPECT_NEAR(outside.share, 0.3, rounding(4, 3.0));
  EXPECT_NEAR(outside.kernel_distance, 2.65, rounding(4, 3.0));
}

RC_GTEST_PROP(PartialVolume, partial_lengths_add_up_to_the_horizon_in_1d, ()) {
  const double ratio = *rc::gen::inRange(600, 9000) / 1000.0;
  // Both sides, and the point's own cell; shares below 1e-9 are dropped.
  RC_ASSERT(std::abs(counted_sum(PartialVolumes::partial_area, ratio, 1) + 1.0 - 2.0 * ratio) <=
            2e-9 + rounding(40, ratio));
}

RC_GTEST_PROP(PartialVolume, covered_parts_add_up_to_the_ball, ()) {
  const int dimension = *rc::gen::inRange(1, 4);
  const double ratio = *rc::gen::inRange(1000, dimension == 3 ? 2500 : 5000) / 1000.0;
  const double ball = ball_volume(ratio, dimension);
  const double own = covered_volume({}, ratio, dimension);
  const double cells = std::pow(2.0 * ratio + 3.0, dimension);
  const double tolerance = cells * (counting_error + least_share * (ratio == std::floor(ratio) ? 1.0 : 0.0));
  RC_ASSERT(std::abs(counted_sum(PartialVolumes::half, ratio, dimension) + own - ball) <= tolerance);
  RC_ASSERT(std::abs(counted_sum(PartialVolumes::half_normalised, ratio, dimension) - ball) <= 2.0 * tolerance);
  RC_ASSERT(std::abs(counted_sum(PartialVolumes::trapezoid, ratio, dimension) - ball) <= tolerance);
}

RC_GTEST_PROP(PartialVolume, nothing_is_covered_beyond_the_reach, ()) {
  const auto rule = *rc::gen::element(PartialVolumes::whole, PartialVolumes::half, PartialVolumes::half_normalised,
                                      PartialVolumes::trapezoid, PartialVolumes::partial_area);
  const double ratio = *rc::gen::inRange(1000, 9000) / 1000.0;
  const int beyond = static_cast<int>(std::floor(reach_of(rule, ratio))) + 1;
  RC_ASSERT(count_cell(rule, {beyond, 0, 0}, ratio, 2).share == 0.0);
}

RC_GTEST_PROP(PartialVolume, algorithm_1_never_evaluates_the_kernel_outside_the_horizon, ()) {
  const double ratio = *rc::gen::inRange(1000, 9000) / 1000.0;
  const double distance = *rc::gen::inRange(1000, 10000) / 1000.0;
  const CountedCell cell = count_partial_area(distance, ratio);
  RC_ASSERT(cell.share >= 0.0);
  RC_ASSERT(cell.share <= 1.0);
  if (cell.share > 0.0) RC_ASSERT(cell.kernel_distance <= ratio * (1.0 + rounding(4, 1.0)));
}

}  // namespace
}  // namespace peritherm
