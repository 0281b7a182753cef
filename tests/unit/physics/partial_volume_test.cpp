#include "peritherm/physics/partial_volume.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double spacing = 0.01;

TEST(PartialVolume, whole_cells_count_up_to_the_edge_of_the_horizon) {
  EXPECT_EQ(covered_cell(PartialVolumes::whole, 0.03, 0.03, spacing).share, 1.0);
  EXPECT_EQ(covered_cell(PartialVolumes::whole, 0.0301, 0.03, spacing).share, 0.0);
}

TEST(PartialVolume, a_point_on_the_edge_counts_in_spite_of_rounding) {
  const double rounded = 3 * 0.1;
  ASSERT_GT(rounded, 0.3);
  EXPECT_EQ(covered_cell(PartialVolumes::whole, rounded, 0.3, 0.1).share, 1.0);
  EXPECT_EQ(covered_cell(PartialVolumes::half, rounded, 0.3, 0.1).share, 0.5);
}

TEST(PartialVolume, half_cells_stand_only_on_the_edge) {
  EXPECT_EQ(covered_cell(PartialVolumes::half, 0.03, 0.03, spacing).share, 0.5);
  EXPECT_EQ(covered_cell(PartialVolumes::half, 0.0299, 0.03, spacing).share, 1.0);
  EXPECT_EQ(covered_cell(PartialVolumes::half, 0.0301, 0.03, spacing).share, 0.0);
}

TEST(PartialVolume, whole_and_half_cells_keep_the_distance_of_their_point) {
  EXPECT_EQ(covered_cell(PartialVolumes::whole, 0.02, 0.03, spacing).kernel_distance, 0.02);
  EXPECT_EQ(covered_cell(PartialVolumes::half, 0.03, 0.03, spacing).kernel_distance, 0.03);
}

TEST(PartialVolume, a_cell_cut_by_the_horizon_counts_in_part_and_at_the_middle_of_that_part) {
  // The cell reaches from 0.025 to 0.035 and the horizon covers it up to 0.032: the middle is 0.0285.
  const CoveredCell inside = covered_cell(PartialVolumes::partial_area, 0.03, 0.032, spacing);
  EXPECT_NEAR(inside.share, 0.7, rounding(4, 1.0));
  EXPECT_NEAR(inside.kernel_distance, 0.0285, rounding(4, 0.03));
  const CoveredCell outside = covered_cell(PartialVolumes::partial_area, 0.03, 0.028, spacing);
  EXPECT_NEAR(outside.share, 0.3, rounding(4, 1.0));
  EXPECT_NEAR(outside.kernel_distance, 0.0265, rounding(4, 0.03));
}

RC_GTEST_PROP(PartialVolume, partial_lengths_add_up_to_the_horizon_in_1d, ()) {
  const double ratio = *rc::gen::inRange(600, 9000) / 1000.0;
  double covered = 0.5;  // of the point's own cell
  for (int j = 1; j <= 10; ++j) {
    covered += covered_cell(PartialVolumes::partial_area, j * spacing, ratio * spacing, spacing).share;
  }
  // Shares below 1e-9 are dropped.
  RC_ASSERT(std::abs(covered - ratio) <= 1e-9 + rounding(20, ratio));
}

RC_GTEST_PROP(PartialVolume, nothing_is_covered_beyond_the_reach, ()) {
  const auto rule = *rc::gen::element(PartialVolumes::whole, PartialVolumes::half, PartialVolumes::partial_area);
  const double horizon = *rc::gen::inRange(1000, 9000) / 1000.0 * spacing;
  const double beyond = *rc::gen::inRange(1, 1000) / 1000.0 * spacing;
  RC_ASSERT(covered_cell(rule, reach(rule, horizon, spacing) + beyond, horizon, spacing).share == 0.0);
}

RC_GTEST_PROP(PartialVolume, the_kernel_is_never_evaluated_outside_the_horizon, ()) {
  const double horizon = *rc::gen::inRange(1000, 9000) / 1000.0 * spacing;
  const double distance = *rc::gen::inRange(1000, 10000) / 1000.0 * spacing;
  const CoveredCell cell = covered_cell(PartialVolumes::partial_area, distance, horizon, spacing);
  RC_ASSERT(cell.share >= 0.0);
  RC_ASSERT(cell.share <= 1.0);
  if (cell.share > 0.0) RC_ASSERT(cell.kernel_distance <= horizon * (1.0 + rounding(4, 1.0)));
}

}  // namespace
}  // namespace peritherm
