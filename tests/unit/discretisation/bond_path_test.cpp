#include "peritherm/discretisation/bond_path.hpp"

#include <gtest/gtest.h>

namespace peritherm {
namespace {

/// Bar of ten cells of edge 1; a poor conductor from 3.5 to 6.5.
Body bar_with_segment(InterfaceRule rule) {
  Body body;
  body.grid.cells = {10, 1, 1};
  body.materials = {{10.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};
  body.regions = {{Box{{3.5}, {6.5}}, 1}};
  body.interface = rule;
  body.assign_materials();
  return body;
}

double conductivity_between(const Body& body, int first, int second) {
  BondPath path;
  BondTracer(body).trace(body.grid.position({first, 0, 0}), body.material_of[first], body.grid.position({second, 0, 0}),
                         body.material_of[second], path);
  return path.conductivity;
}

TEST(BondPath, a_point_on_an_interface_conducts_like_the_side_that_its_bond_goes_to) {
  const Body body = bar_with_segment(InterfaceRule::sided_harmonic);
  EXPECT_DOUBLE_EQ(conductivity_between(body, 3, 2), 10.0);
  EXPECT_DOUBLE_EQ(conductivity_between(body, 3, 4), 1.0);
  EXPECT_DOUBLE_EQ(conductivity_between(body, 2, 4), 20.0 / 11.0);
  EXPECT_DOUBLE_EQ(conductivity_between(body, 5, 4), 1.0);
  // Both ends inside the good conductor: what lies between does not matter.
  EXPECT_DOUBLE_EQ(conductivity_between(body, 2, 7), 10.0);
}

TEST(BondPath, a_point_on_an_interface_conducts_as_its_region_says_under_the_other_rules) {
  EXPECT_DOUBLE_EQ(conductivity_between(bar_with_segment(InterfaceRule::harmonic), 3, 2), 20.0 / 11.0);
  EXPECT_DOUBLE_EQ(conductivity_between(bar_with_segment(InterfaceRule::minimum), 3, 2), 1.0);
  EXPECT_DOUBLE_EQ(conductivity_between(bar_with_segment(InterfaceRule::length_weighted_harmonic), 3, 2), 10.0);
}

}  // namespace
}  // namespace peritherm
