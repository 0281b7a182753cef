#include "peritherm/studies/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "peritherm/studies/study_errors.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

TEST(Convergence, the_rate_of_a_power_is_its_exponent) {
  const std::vector<double> sizes{0.4, 0.2, 0.05};
  std::vector<double> errors;
  for (const double size : sizes) errors.push_back(3.0 * std::pow(size, 1.7));
  EXPECT_NEAR(fitted_rate(sizes, errors), 1.7, 1e-13);  // A few dozen roundings of logarithms of order one.
  EXPECT_NEAR(convergence_rate(sizes[0], errors[0], sizes[1], errors[1]), 1.7, 1e-13);
}

TEST(Convergence, runs_without_error_are_left_out_of_the_fit) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> sizes{0.4, 0.2, 0.1, 0.05};
  EXPECT_NEAR(fitted_rate(sizes, std::vector{16.0, none, 1.0, 0.0}), 2.0, 1e-13);
  EXPECT_TRUE(std::isnan(fitted_rate(sizes, std::vector{16.0, none, none, 0.0})));
  EXPECT_TRUE(std::isnan(convergence_rate(0.4, 16.0, 0.2, none)));
}

TEST(StudyNorm, measures_as_the_papers_do) {
  const std::vector<double> computed{1.5, 2.0}, reference{1.0, 4.0};
  EXPECT_DOUBLE_EQ(measure(StudyNorm::relative_l2, computed, reference), std::sqrt(4.25 / 17.0));
  EXPECT_DOUBLE_EQ(measure(StudyNorm::bobaru_2010, computed, reference), std::sqrt(0.25 + 0.25) / 2.0);
  EXPECT_DOUBLE_EQ(measure(StudyNorm::relative_rms, computed, reference), std::sqrt(0.25));
  EXPECT_DOUBLE_EQ(measure(StudyNorm::rms, computed, reference), std::sqrt(4.25 / 2.0));
  EXPECT_DOUBLE_EQ(measure(StudyNorm::maximum, computed, reference), 2.0);
}

TEST(StudyNorm, equal_temperatures_of_zero_differ_by_nothing) {
  const std::vector<double> computed{0.0, 1.5}, reference{0.0, 1.0};
  EXPECT_DOUBLE_EQ(measure(StudyNorm::relative_rms, computed, reference), std::sqrt(0.125));
}

}  // namespace
}  // namespace peritherm
