#include <gtest/gtest.h>

#include <numbers>

#include "support/divided_body.hpp"

namespace peritherm {
namespace {

const PartBackground nothing_around{"", no_material, 0.3};

PartRegion disc_of_rings(double radius, double spacing, const std::string& name) {
  PartRegion made;
  made.shape = Ball{{0.0, 0.0}, radius};
  made.name = name;
  made.spacing = spacing;
  made.points = PartPoints::rings;
  return made;
}

/// A box from (−1, −1) to (1, 1).
Grid ring_box() {
  Grid grid = unit_box(2, 20);
  grid.spacing = 0.1;
  grid.origin = {-1.0, -1.0, 0.0};
  return grid;
}

std::string ring_problems(const Grid& grid, const PartBackground& background, const std::vector<PartRegion>& regions) {
  try {
    divide_body(grid, background, regions);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(Rings, discs_have_the_numbers_of_points_of_the_reference_values_and_exact_areas) {
  for (const auto& [spacing, points] : {std::pair{0.1, 314u}, std::pair{0.05, 1257u}, std::pair{0.025, 5027u}}) {
    const DividedBody body = divide_body(ring_box(), nothing_around,
                                         {disc_of_rings(1.0, spacing, "shell"), disc_of_rings(0.5, spacing, "core")});
    ASSERT_EQ(body.parts.size(), 2u);
    EXPECT_EQ(body.parts[0].name, "shell");
    EXPECT_EQ(body.parts[0].size() + body.parts[1].size(), points);
    EXPECT_NEAR(volume_of(body.parts[0]), std::numbers::pi * 0.75, rounding(points, 1e-3));
    EXPECT_NEAR(volume_of(body.parts[1]), std::numbers::pi * 0.25, rounding(points, 1e-3));
    EXPECT_TRUE(body.parts[0].places.empty());
    expect_closed(body);
  }
}

TEST(Rings, surface_points_stand_every_one_and_a_half_spacings_with_normals_out_of_the_first_part) {
  const DividedBody body =
      divide_body(ring_box(), nothing_around, {disc_of_rings(1.0, 0.1, "shell"), disc_of_rings(0.5, 0.05, "core")});
  std::size_t between = 0, outside = 0;
  for (const SurfacePoint& point : body.surface) {
    const bool contact = point.second >= 0;
    ++(contact ? between : outside);
    EXPECT_NEAR(length(point.position), contact ? 0.5 : 1.0, rounding(1, 1.0));
    EXPECT_NEAR(dot(point.normal, point.position), contact ? -0.5 : 1.0, rounding(3, 1.0));
  }
  EXPECT_EQ(between, 21u);  // 2 π 0.5 / 0.15
  EXPECT_EQ(outside, 42u);
}

TEST(Rings, a_hole_in_the_middle_is_an_inner_surface) {
  PartRegion hole = disc_of_rings(0.3, 0.1, "");
  hole.material = no_material;
  const DividedBody body = divide_body(ring_box(), nothing_around, {disc_of_rings(1.0, 0.1, "tube"), hole});
  ASSERT_EQ(body.parts.size(), 1u);
  EXPECT_NEAR(volume_of(body.parts[0]), std::numbers::pi * 0.91, rounding(300, 1e-2));
  expect_closed(body);
}

TEST(Rings, what_cannot_be_made_of_rings_is_refused_all_at_once) {
  PartRegion square = disc_of_rings(0.5, 0.1, "square");
  square.shape = Box{{-0.2, -0.2}, {0.2, 0.2}};
  PartRegion aside = disc_of_rings(0.5, 0.1, "aside");
  aside.shape = Ball{{0.1, 0.0}, 0.2};
  PartRegion gridded = disc_of_rings(0.5, 0.1, "gridded");
  gridded.points = PartPoints::grid;
  const std::string problems =
      ring_problems(ring_box(), {"matrix", 0, 0.3}, {disc_of_rings(1.1, 0.1, "wide"), square, aside, gridded});
  for (const char* expected : {"void", "'wide' reaches out of the box", "'square' is no ball",
                               "'aside' does not have the centre", "'gridded' stands on a grid"}) {
    EXPECT_NE(problems.find(expected), std::string::npos) << expected << " in\n" << problems;
  }
  const std::string cubic = ring_problems(unit_box(3, 8), nothing_around, {disc_of_rings(0.4, 0.1, "ball")});
  EXPECT_NE(cubic.find("2-D"), std::string::npos) << cubic;
  const std::string covered =
      ring_problems(ring_box(), nothing_around, {disc_of_rings(0.5, 0.1, "inner"), disc_of_rings(1.0, 0.1, "outer")});
  EXPECT_NE(covered.find("'inner' has no points"), std::string::npos) << covered;
}

}  // namespace
}  // namespace peritherm
