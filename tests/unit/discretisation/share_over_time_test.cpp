#include "peritherm/discretisation/share_over_time.hpp"

#include <gtest/gtest.h>

#include <array>

#include "peritherm/discretisation/cut_schedule.hpp"

namespace peritherm {
namespace {

constexpr std::array<ShareKnot, 4> knots{{{1.0, 0.5}, {3.0, 1.5}, {3.0, 0.0}, {4.0, 0.25}}};

TEST(ShareOverTime, is_linear_between_knots_and_jumps_where_two_meet) {
  EXPECT_EQ(share_at(knots, 0.0, Side::after), 0.5);
  EXPECT_EQ(share_at(knots, 1.0, Side::before), 0.5);
  EXPECT_EQ(share_at(knots, 2.0, Side::after), 1.0);
  EXPECT_EQ(share_at(knots, 3.0, Side::before), 1.5);
  EXPECT_EQ(share_at(knots, 3.0, Side::after), 0.0);
  EXPECT_EQ(share_at(knots, 3.5, Side::before), 0.125);
  EXPECT_EQ(share_at(knots, 9.0, Side::before), 0.25);
}

/// A bond whose faces change as above and that another crack cuts by half at 2.
BondPath changing_path() {
  BondPath path;
  path.face_share = knots[0].share;
  path.faces.assign(knots.begin(), knots.end());
  path.crossings.push_back({2.0, 0.5, true, false, 1});
  return path;
}

TEST(ShareOverTime, is_averaged_over_steps_of_any_length) {
  CutSchedule schedule;
  schedule.add(0, 10.0, 2.0, changing_path());
  schedule.sort();
  std::vector<double> conductance{10.0 + 2.0 * standing_share(changing_path())};
  // The share: 0.5 up to 1, from there to 2 rising to 1, then 0.5 to 0.75 up to 3, then 0 to 0.125 up to 4.
  const auto mean = [&](double from, double to) {
    schedule.average_over(from, to, conductance);
    return (conductance[0] - 10.0) / 2.0;
  };
  EXPECT_NEAR(mean(0.0, 1.0), 0.5, 1e-14);
  EXPECT_NEAR(mean(1.0, 2.0), 0.75, 1e-14);
  EXPECT_NEAR(mean(1.5, 2.5), 0.5 * (0.875 + 0.5625), 1e-14);
  EXPECT_NEAR(mean(0.0, 5.0), (0.5 + 0.75 + 0.625 + 0.0625 + 0.125) / 5.0, 1e-14);
  EXPECT_NEAR(mean(2.5, 2.5), 0.625, 1e-14);
  EXPECT_NEAR(mean(3.0, 3.0), 0.0, 1e-14);
  EXPECT_NEAR(mean(7.0, 8.0), 0.125, 1e-14);
  // And back: a step that was refused is tried again.
  EXPECT_NEAR(mean(0.5, 1.0), 0.5, 1e-14);
}

TEST(ShareOverTime, tells_when_it_changes_and_how_high_it_comes) {
  CutSchedule schedule;
  schedule.add(0, 10.0, 2.0, changing_path());
  schedule.sort();
  EXPECT_FALSE(schedule.changes_within(0.0, 1.0));
  EXPECT_TRUE(schedule.changes_within(0.9, 1.1));
  EXPECT_TRUE(schedule.changes_within(1.4, 1.5));
  EXPECT_TRUE(schedule.changes_within(2.5, 3.5));
  EXPECT_FALSE(schedule.changes_within(4.0, 9.0));
  EXPECT_EQ(schedule.peaks(std::vector<double>{11.0})[0], 12.0);
}

TEST(ShareOverTime, of_a_crack_that_closes_is_what_it_did_last) {
  BondPath path;
  path.crossings = {{0.0, 0.25, false, false, 8},
                    {0.0, 0.5, false, false, 16},
                    {1.0, 1.0, true, false, 8},
                    {2.0, 0.25, true, false, 8}};
  std::vector<ShareRamp> changes;
  append_changes(path, changes);
  EXPECT_EQ(standing_share(path), 0.125);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].after, 0.5);
  EXPECT_EQ(changes[1].before, 0.5);
  EXPECT_EQ(changes[1].after, 0.125);
}

}  // namespace
}  // namespace peritherm
