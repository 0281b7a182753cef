#include "peritherm/studies/study_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace peritherm {
namespace {

constexpr double lost = std::numeric_limits<double>::quiet_NaN();

TEST(StudyErrors, no_norm_hides_what_is_no_number) {
  const std::vector<double> reference{1.0, 2.0, 3.0};
  for (const auto& [norm, name] : EnumNames<StudyNorm>::values) {
    // At the first, a middle and the last place: a maximum that begins anew after it would pass over the first ones.
    for (std::size_t place = 0; place < 3; ++place) {
      std::vector<double> computed{1.5, 2.5, 3.5};
      computed[place] = lost;
      EXPECT_TRUE(std::isnan(measure(norm, computed, reference))) << name << ' ' << place;
    }
  }
  EXPECT_EQ(measure(StudyNorm::maximum, std::vector{1.5, 2.0, 2.0}, reference), 1.0);
}

TEST(StudyErrors, only_what_is_cut_away_in_both_solutions_is_left_out) {
  Solution first, second;
  first.temperatures = {{1.0, lost, 2.0}};
  second.temperatures = {{1.25, lost, 2.0}};
  EXPECT_EQ(largest_difference(first, second), 0.25);
  second.temperatures[0][0] = lost;
  EXPECT_TRUE(std::isnan(largest_difference(first, second)));
  EXPECT_TRUE(std::isnan(largest_difference(second, first)));
}

}  // namespace
}  // namespace peritherm
