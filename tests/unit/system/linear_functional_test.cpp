#include "peritherm/system/linear_functional.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr std::size_t size = 60000;

/// Weights in long rows and short ones, many of them alike, with gaps between.
std::vector<double> weights() {
  std::vector<double> all(size, 0.0);
  for (std::size_t n = 0; n < size; ++n) {
    const bool in_long_row = n > 1000 && n < 40000;
    const bool in_short_row = n > 41000 && n % 50 < 6;
    if (in_long_row) all[n] = 0.25;
    if (in_short_row) all[n] = 1.0 + static_cast<double>(n % 50);
  }
  return all;
}

std::vector<double> field() {
  std::vector<double> values(size);
  for (std::size_t n = 0; n < size; ++n) values[n] = std::sin(0.37 * static_cast<double>(n));
  return values;
}

LinearFunctional functional() {
  const std::vector<double> all = weights();
  LinearFunctional result;
  result.append(0, std::span(all).first(500));
  result.append(500, std::span(all).subspan(500));
  result.finish();
  return result;
}

TEST(LinearFunctional, it_is_the_weighted_sum) {
  const std::vector<double> all = weights(), values = field();
  double sum = 0.0, scale = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    sum += all[n] * values[n];
    scale = std::max(scale, all[n]);
  }
  EXPECT_NEAR(functional()(values), sum, rounding(size, scale));
}

TEST(LinearFunctional, threads_change_no_bit) {
  const LinearFunctional sum = functional();
  const std::vector<double> values = field();
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const double alone = sum(values);
  omp_set_num_threads(3);
  EXPECT_EQ(sum(values), alone);
  omp_set_num_threads(before);
}

TEST(LinearFunctional, rows_that_are_alike_share_their_weights) {
  // A strip takes 16 bytes; without sharing, the weights of the short rows alone would take 18 kB.
  EXPECT_LT(functional().bytes(), 16U * 420U + 8U * 2100U + 100U);
}

TEST(LinearFunctional, one_without_weights_is_zero) {
  LinearFunctional nothing;
  nothing.append(0, std::vector<double>(10, 0.0));
  nothing.finish();
  EXPECT_TRUE(nothing.empty());
  EXPECT_EQ(nothing(field()), 0.0);
}

}  // namespace
}  // namespace peritherm
