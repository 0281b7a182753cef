#include "peritherm/two_field/load_jumps.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peritherm {
namespace {

std::vector<LoadJump> jumps_of(const std::function<double(double)>& load, double from = 0.0, double to = 1.0) {
  return find_load_jumps([&load](double time) { return std::vector<double>{7.0, load(time)}; }, from, to, 64);
}

TEST(LoadJumps, are_narrowed_down_to_their_neighbours) {
  const auto jumps = jumps_of([](double t) { return t < 0.4321 ? 1.0 : 1.5; });
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_LT(jumps[0].before, 0.4321);
  EXPECT_GE(jumps[0].after, 0.4321);
  EXPECT_LT(jumps[0].after - jumps[0].before, 2e-12);
}

TEST(LoadJumps, are_all_found_in_their_order) {
  const auto jumps = jumps_of([](double t) { return (t >= 0.501 && t < 0.534 ? 3.0 : 0.0) + (t > 0.9 ? 1e-3 : 0.0); });
  ASSERT_EQ(jumps.size(), 3U);
  EXPECT_NEAR(jumps[0].after, 0.501, 2e-12);
  EXPECT_NEAR(jumps[1].after, 0.534, 2e-12);
  EXPECT_NEAR(jumps[2].before, 0.9, 2e-12);
}

TEST(LoadJumps, two_between_the_same_looks_are_found_if_they_do_not_cancel) {
  const auto jumps = jumps_of([](double t) { return (t > 0.5001 ? 3.0 : 0.0) + (t > 0.5002 ? 1.0 : 0.0); });
  ASSERT_EQ(jumps.size(), 2U);
  EXPECT_NEAR(jumps[0].after, 0.5001, 2e-12);
  EXPECT_NEAR(jumps[1].after, 0.5002, 2e-12);
}

TEST(LoadJumps, at_an_end_belong_to_the_side_where_they_are_seen) {
  const auto at_end = jumps_of([](double t) { return t < 1.0 ? 0.0 : 1.0; });
  ASSERT_EQ(at_end.size(), 1U);
  EXPECT_EQ(at_end[0].after, 1.0);
  const auto at_start = jumps_of([](double t) { return t > 0.0 ? 1.0 : 0.0; });
  ASSERT_EQ(at_start.size(), 1U);
  EXPECT_EQ(at_start[0].before, 0.0);
  EXPECT_LT(at_start[0].after, 2e-12);
}

TEST(LoadJumps, are_no_kinks_and_no_steep_or_swinging_loads) {
  EXPECT_TRUE(jumps_of([](double t) { return std::max(0.0, t - 0.3); }).empty());
  EXPECT_TRUE(jumps_of([](double t) { return std::sqrt(std::abs(t - 0.3)); }).empty());
  EXPECT_TRUE(jumps_of([](double t) { return std::tanh(1e6 * (t - 0.3)); }).empty());
  EXPECT_TRUE(jumps_of([](double t) { return std::sin(1e4 * t); }).empty());
  EXPECT_TRUE(jumps_of([](double t) { return std::exp(-1e4 * t); }).empty());
}

TEST(LoadJumps, ends_of_rest_are_found_where_asked_for) {
  const auto ends_of = [](const std::function<double(double)>& load) {
    return find_load_jumps([&load](double time) { return std::vector<double>{load(time)}; }, 0.0, 1.0, 64,
                           LoadSearch::jumps_and_ends_of_rest);
  };
  const auto kink = ends_of([](double t) { return std::max(0.0, t - 0.3); });
  ASSERT_EQ(kink.size(), 1U);
  EXPECT_NEAR(kink[0].before, 0.3, 2e-5) << "a thousandth of what changes between two looks";
  const auto pulse = ends_of([](double t) { return std::exp(-std::pow((t - 0.5) / 0.01, 2)); });
  ASSERT_FALSE(pulse.empty());
  EXPECT_LT(std::exp(-std::pow((pulse[0].after - 0.5) / 0.01, 2)), 1e-6) << "before anything happens";
  EXPECT_EQ(ends_of([](double t) { return t < 0.4 ? 0.0 : 1.0; }).size(), 1U) << "a jump counts once";
  EXPECT_TRUE(ends_of([](double t) { return std::sin(1.0 + t); }).empty());
}

TEST(LoadJumps, rounding_is_none) {
  EXPECT_TRUE(jumps_of([](double t) { return 300.0 + std::sin(t) * std::sin(t) + std::cos(t) * std::cos(t); }).empty());
  EXPECT_TRUE(find_load_jumps(nullptr, 0.0, 1.0, 16).empty());
}

TEST(LoadJumps, keep_their_digits_late_in_a_march) {
  const auto jumps = jumps_of([](double t) { return t < 1000.5 ? 0.0 : 1.0; }, 1000.0, 1001.0);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_NEAR(jumps[0].after, 1000.5, 1e-11);
}

}  // namespace
}  // namespace peritherm
