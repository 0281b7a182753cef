#include "peritherm/base/larger.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace peritherm {
namespace {

TEST(Larger, keeps_what_is_no_number) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(larger(1.0, 2.0), 2.0);
  EXPECT_EQ(larger(2.0, 1.0), 2.0);
  EXPECT_TRUE(std::isnan(larger(none, 1.0)));
  EXPECT_TRUE(std::isnan(larger(1.0, none)));
}

}  // namespace
}  // namespace peritherm
