#include <gtest/gtest.h>

#include "peritherm/papers/galadima_models.hpp"
#include "peritherm/papers/galadima_values.hpp"

namespace peritherm {
namespace {

namespace condensed_values = galadima_values;

TrialBody condensed_bar_body(int exponent) {
  static PaperRuns runs(PaperRuns::Settings{});
  const std::vector<double> times(condensed_values::bar_times.begin(), condensed_values::bar_times.end());
  return {galadima_bar({exponent, 3.0, Calibration::discrete}), times, false, runs};
}

StaticCondensation condensed_bar_method(int every, CondensedCapacity capacity) {
  StaticCondensation method;
  method.retained = every_point(every);
  method.capacity = capacity;
  method.start = ModelStart::sampled;
  method.drop = 0.0;
  return method;
}

/// Shares, their sums and capacities of all choices hold to rounding.
TEST(CondensedBar, keeps_constants_and_heat) {
  ReportTable table{"", {}};
  TrialBody body = condensed_bar_body(2);
  for (const int every : {2, 5, 10})
    add_shape_rows(table, body.reduce("", condensed_bar_method(every, CondensedCapacity::consistent)));
  EXPECT_EQ(verdict_of({"", {table}, "", 0.0}).failed, 0U);
  EXPECT_EQ(table.rows.size(), 9U);
}

TEST(CondensedBar, begins_where_its_points_are_by_either_way_to_a_sampled_start) {
  TrialBody body = condensed_bar_body(2);
  StaticCondensation method = condensed_bar_method(5, CondensedCapacity::consistent);
  const TriedModel sampled = body.reduce("", method);
  method.start = ModelStart::projected;
  const TriedModel changed = body.judge("", with_sampled_start(body.reduce("", method).reduction));
  for (std::size_t k = 0; k < sampled.at_retained.size(); ++k)
    EXPECT_NEAR(changed.at_retained[k], sampled.at_retained[k], 1e-12) << k;
}

}  // namespace
}  // namespace peritherm
