#include "peritherm/base/compensated_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace peritherm {
namespace {

TEST(CompensatedSum, is_exact_to_one_rounding_however_many_terms_it_has) {
  CompensatedSum sum;
  double plain = 0.0;
  for (int n = 0; n < 1'000'000; ++n) {
    sum.add(0.1);
    plain += 0.1;
  }
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(sum.value(), 1e5, epsilon * 1e5);
  EXPECT_GT(std::abs(plain - 1e5), 1000 * epsilon * 1e5);
}

TEST(CompensatedSum, keeps_small_terms_beside_large_ones_that_cancel) {
  CompensatedSum sum;
  for (const double term : {1.0, 1e100, 1.0, -1e100}) sum.add(term);
  EXPECT_EQ(sum.value(), 2.0);
}

}  // namespace
}  // namespace peritherm
