#include "peritherm/base/text.hpp"

#include <gtest/gtest.h>

namespace peritherm {
namespace {

TEST(Text, lines_of_tables_fall_apart_at_every_comma) {
  using Entries = std::vector<std::string_view>;
  EXPECT_EQ(split_at_commas("1, 2 ,\t3\r"), (Entries{"1", "2", "3"}));
  EXPECT_EQ(split_at_commas("1,,"), (Entries{"1", "", ""}));
  EXPECT_EQ(split_at_commas(""), (Entries{""}));
}

TEST(Text, only_a_whole_text_is_a_finite_number) {
  EXPECT_EQ(finite_number("+2.5e3"), 2500.0);
  EXPECT_EQ(finite_number("-0.5"), -0.5);
  for (const char* text : {"", "+", "+-1", "-+1", "1 m", "1,5", "nan", "inf", "1e999"}) {
    EXPECT_FALSE(finite_number(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace peritherm
