#include "peritherm/physics/interface.hpp"

#include <gtest/gtest.h>

namespace peritherm {
namespace {

TEST(Interface, each_rule_has_its_mean) {
  EXPECT_DOUBLE_EQ(bond_conductivity(InterfaceRule::minimum, 1.0, 3.0), 1.0);
  EXPECT_DOUBLE_EQ(bond_conductivity(InterfaceRule::harmonic, 1.0, 3.0), 1.5);
  EXPECT_DOUBLE_EQ(bond_conductivity(InterfaceRule::arithmetic, 1.0, 3.0), 2.0);
}

TEST(Interface, every_rule_is_symmetric_to_the_bit) {
  for (const auto& [rule, name] : EnumNames<InterfaceRule>::values) {
    EXPECT_EQ(bond_conductivity(rule, 0.0114, 1.14), bond_conductivity(rule, 1.14, 0.0114)) << name;
  }
}

TEST(Interface, every_rule_leaves_one_material_as_it_is) {
  for (const auto& [rule, name] : EnumNames<InterfaceRule>::values) {
    EXPECT_DOUBLE_EQ(bond_conductivity(rule, 1.14, 1.14), 1.14) << name;
  }
}

TEST(Interface, a_bond_half_in_each_material_is_two_resistors_in_series) {
  const double in_series = 1.0 / (0.5 / 2.0 + 0.5 / 7.0);
  EXPECT_DOUBLE_EQ(bond_conductivity(InterfaceRule::length_weighted_harmonic, 2.0, 7.0), in_series);
}

}  // namespace
}  // namespace peritherm
