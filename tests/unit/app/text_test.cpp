#include "text.hpp"

#include <gtest/gtest.h>

namespace peritherm::app {
namespace {

TEST(Text, digits_stand_in_groups_of_three) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1 000");
  EXPECT_EQ(grouped(14641), "14 641");
  EXPECT_EQ(grouped(1234567), "1 234 567");
}

TEST(Text, one_thing_is_singular) {
  EXPECT_EQ(counted(1, "point", "points"), "1 point");
  EXPECT_EQ(counted(0, "point", "points"), "0 points");
  EXPECT_EQ(counted(14641, "point", "points"), "14 641 points");
}

TEST(Text, memory_has_binary_prefixes) {
  EXPECT_EQ(bytes_text(0), "0 B");
  EXPECT_EQ(bytes_text(1023), "1023 B");
  EXPECT_EQ(bytes_text(1024), "1.0 KiB");
  EXPECT_EQ(bytes_text(1288490189), "1.2 GiB");
  EXPECT_EQ(bytes_text(1048575), "1.0 MiB");
}

TEST(Text, quantities_have_prefixes_of_the_si) {
  EXPECT_EQ(quantity(0.0, "s"), "0 s");
  EXPECT_EQ(quantity(7.5, "s"), "7.5 s");
  EXPECT_EQ(quantity(0.0010833333, "m"), "1.083 mm");
  EXPECT_EQ(quantity(1.6e-7, "m"), "160 nm");
  EXPECT_EQ(quantity(0.001, "m"), "1 mm");
  EXPECT_EQ(quantity(-2500.0, "W"), "-2.5 kW");
}

TEST(Text, a_quantity_is_rounded_before_its_prefix_is_chosen) { EXPECT_EQ(quantity(999.96, "m"), "1 km"); }

TEST(Text, quantities_beyond_the_prefixes_keep_their_power_of_ten) {
  EXPECT_EQ(quantity(1e-12, "s"), "1e-12 s");
  EXPECT_EQ(quantity(2e15, "s"), "2e+15 s");
}

TEST(Text, a_time_to_wait_has_two_units_at_most) {
  EXPECT_EQ(duration_text(0.0), "less than 0.1 s");
  EXPECT_EQ(duration_text(0.42), "0.4 s");
  EXPECT_EQ(duration_text(59.9), "1 min 0 s");
  EXPECT_EQ(duration_text(200.0), "3 min 20 s");
  EXPECT_EQ(duration_text(7500.0), "2 h 5 min");
  EXPECT_EQ(duration_text(273600.0), "3 d 4 h");
  EXPECT_EQ(duration_text(-1.0), "unknown");
}

TEST(Text, a_series_of_files_is_one_entry) {
  const std::vector<std::string> lines =
      summarised_files({"out/pictures/temperature_0001.png", "out/probes.csv", "out/pictures/temperature_0000.png",
                        "out/pictures/damage_0000.png", "out/probes.csv"});
  const std::vector<std::string> expected{"out/probes.csv", "out/pictures/damage_0000.png",
                                          "out/pictures/temperature_0000.png … temperature_0001.png (2 files)"};
  EXPECT_EQ(lines, expected);
}

}  // namespace
}  // namespace peritherm::app
