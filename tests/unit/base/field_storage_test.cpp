#include "peritherm/base/field_storage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace peritherm {
namespace {

TEST(FieldStorage, a_new_field_is_zero_and_begins_at_a_cache_line) {
  // The largest of them is kept in large pages.
  for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, std::size_t{3000000}}) {
    const FieldStorage field(size);
    ASSERT_EQ(field.size(), size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.data()) % 64, 0U);
    EXPECT_TRUE(std::all_of(field.begin(), field.end(), [](double value) { return value == 0.0; }));
  }
}

TEST(FieldStorage, a_copy_is_a_field_of_its_own) {
  FieldStorage field(5);
  field[3] = 2.0;
  FieldStorage copy = field;
  field[3] = 1.0;
  EXPECT_EQ(copy[3], 2.0);
  copy = field;
  EXPECT_EQ(copy[3], 1.0);
  EXPECT_EQ(static_cast<std::vector<double>>(copy), (std::vector<double>{0.0, 0.0, 0.0, 1.0, 0.0}));
}

TEST(FieldStorage, nothing_takes_no_memory) {
  EXPECT_TRUE(FieldStorage().empty());
  EXPECT_EQ(FieldStorage(FieldStorage(0)).data(), nullptr);
}

}  // namespace
}  // namespace peritherm
