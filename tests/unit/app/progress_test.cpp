#include "progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace peritherm::app {
namespace {

Progress half_way() {
  Progress progress;
  progress.time = 3.75;
  progress.end = 7.5;
  progress.count.accepted = 1204;
  progress.count.evaluations = 8000;
  progress.wall = 10.0;
  return progress;
}

TEST(Progress, the_line_names_time_steps_speed_and_time_left) {
  const std::string line = progress_line(half_way(), 120);
  for (const char* part : {" 50 %", "3.75 s of 7.5 s", "1 204 steps", "800 evaluations/s", "10 s left"}) {
    EXPECT_NE(line.find(part), std::string::npos) << part << " is missing in " << line;
  }
}

TEST(Progress, half_of_the_bar_is_filled_half_way) {
  const std::string line = progress_line(half_way(), 200);
  EXPECT_EQ(std::count(line.begin(), line.end(), '#'), std::count(line.begin(), line.end(), '-'));
  EXPECT_GT(std::count(line.begin(), line.end(), '#'), 0);
}

TEST(Progress, the_line_never_fills_the_terminal) {
  for (int width = 1; width < 150; ++width) {
    EXPECT_LT(progress_line(half_way(), width).size(), static_cast<std::size_t>(std::max(width, 1)));
  }
}

TEST(Progress, a_silent_display_prints_nothing) {
  std::ostringstream out;
  ProgressDisplay display(out, ProgressDisplay::Style::silent);
  display.show(half_way());
  display.close();
  EXPECT_EQ(out.str(), "");
}

TEST(Progress, a_live_display_redraws_at_most_ten_times_a_second) {
  std::ostringstream out;
  ProgressDisplay display(out, ProgressDisplay::Style::live);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 1000; ++i) display.show(half_way());
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  const std::string text = out.str();
  const auto redrawn = std::count(text.begin(), text.end(), '\r');
  EXPECT_GE(redrawn, 1);
  EXPECT_LE(static_cast<double>(redrawn), 1.0 + spent.count() / 0.1);
}

TEST(Progress, a_plain_display_prints_a_line_for_every_tenth_of_the_run) {
  std::ostringstream out;
  ProgressDisplay display(out, ProgressDisplay::Style::plain);
  Progress progress = half_way();
  for (int percent = 0; percent <= 100; ++percent) {
    progress.time = progress.end * percent / 100.0;
    display.show(progress);
  }
  const std::string text = out.str();
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_GE(lines, 9) << "rounding may shift the tenth line beyond the end";
  EXPECT_LE(lines, 10);
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

}  // namespace
}  // namespace peritherm::app
