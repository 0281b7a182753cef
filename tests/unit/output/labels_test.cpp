#include "peritherm/output/labels.hpp"

#include <gtest/gtest.h>

namespace peritherm {
namespace {

std::vector<std::string> texts(const std::vector<Tick>& ticks) {
  std::vector<std::string> found;
  for (const Tick& tick : ticks) found.push_back(tick.text);
  return found;
}

TEST(Labels, ticks_are_round_and_hold_no_rounding_errors) {
  EXPECT_EQ(texts(make_ticks(0.0, 0.5, 5)), (std::vector<std::string>{"0.0", "0.1", "0.2", "0.3", "0.4", "0.5"}));
  EXPECT_EQ(texts(make_ticks(0.0, 1000.0, 4)), (std::vector<std::string>{"0", "250", "500", "750", "1000"}));
}

TEST(Labels, zero_between_negative_and_positive_ticks_has_no_sign) {
  EXPECT_EQ(texts(make_ticks(-0.3, 0.3, 6)),
            (std::vector<std::string>{"\u22120.3", "\u22120.2", "\u22120.1", "0.0", "0.1", "0.2", "0.3"}));
}

TEST(Labels, ticks_stand_in_the_unit_and_inside_the_ends) {
  const std::vector<Tick> ticks = make_ticks(-0.0101, 0.0099, 4, 1e-3);
  EXPECT_EQ(texts(ticks), (std::vector<std::string>{"\u221210", "\u22125", "0", "5"}));
  EXPECT_DOUBLE_EQ(ticks.front().value, -0.01);
}

TEST(Labels, an_empty_interval_has_no_ticks) { EXPECT_TRUE(make_ticks(1.0, 1.0, 5).empty()); }

TEST(Labels, the_unit_of_length_follows_the_size) {
  EXPECT_EQ(length_unit(2.0).symbol, "m");
  EXPECT_EQ(length_unit(0.02).symbol, "cm");
  EXPECT_EQ(length_unit(0.01).symbol, "mm");
  EXPECT_EQ(length_unit(100 * 1e-6).symbol, "\u00b5m");
  EXPECT_EQ(length_unit(5e-8).symbol, "nm");
}

TEST(Labels, times_have_a_readable_unit) {
  EXPECT_EQ(time_text(3.0), "t = 3 s");
  EXPECT_EQ(time_text(0.025), "t = 25 ms");
  EXPECT_EQ(time_text(0.1 + 0.2), "t = 0.3 s");
  EXPECT_EQ(time_text(0.0), "t = 0 s");
  EXPECT_EQ(time_text(36000.0), "t = 10 h");
}

TEST(Labels, numbers_are_short) {
  EXPECT_EQ(rounded_text(-0.0, 4), "0");
  EXPECT_EQ(rounded_text(0.30000000000000004, 6), "0.3");
  EXPECT_EQ(rounded_text(-2.5, 6), "\u22122.5");
  EXPECT_EQ(rounded_text(1200.0, 2), "1200");
  EXPECT_EQ(rounded_text(2e12, 3), "2\u00d710\u00b9\u00b2");
}

TEST(Labels, large_and_small_values_share_a_power_of_ten) {
  EXPECT_EQ(label_scale(-100.0, 50.0), 1.0);
  EXPECT_EQ(label_scale(0.0, 3.5e6), 1e6);
  EXPECT_EQ(power_of_ten_text(1e6), "10\u2076");
  EXPECT_EQ(power_of_ten_text(1e-9), "10\u207b\u2079");
}

TEST(Labels, numbers_of_files_have_at_least_four_digits) {
  EXPECT_EQ(four_digits(7), "0007");
  EXPECT_EQ(four_digits(12345), "12345");
}

}  // namespace
}  // namespace peritherm
