#include "peritherm/output/colour_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peritherm {
namespace {

/// CIELAB lightness, 0 to 100.
double lightness(const Colour& colour) { return 116.0 * std::cbrt(luminance(colour)) - 16.0; }

TEST(ColourMap, equal_steps_of_value_are_equal_steps_of_lightness) {
  for (const ColourMap& map : {ColourMap::heat(0.0, 1.0), ColourMap::flux(0.0, 1.0), ColourMap::damage(0.0, 1.0)}) {
    const double whole = lightness(map(1.0)) - lightness(map(0.0));
    for (int k = 0; k <= 16; ++k) {
      // Channels are rounded to 1/255, which moves the lightness by up to a third of a unit, at both ends too.
      EXPECT_NEAR(lightness(map(k / 16.0)) - lightness(map(0.0)), whole * k / 16.0, 1.0);
    }
  }
}

TEST(ColourMap, zero_is_white_and_opposite_values_are_equally_far_from_it) {
  const ColourMap map = ColourMap::diverging(-50.0, 100.0);
  EXPECT_GT(lightness(map(0.0)), 97.0);
  EXPECT_GT(map(-50.0).blue, map(-50.0).red);
  EXPECT_GT(map(100.0).red, map(100.0).blue);
  EXPECT_GT(lightness(map(-50.0)), lightness(map(100.0))) << "half as far from zero";
}

TEST(ColourMap, values_beyond_the_ends_have_the_colours_of_the_ends) {
  const ColourMap map = ColourMap::heat(10.0, 20.0);
  EXPECT_EQ(pixel_of(map(-5.0)), pixel_of(map(10.0)));
  EXPECT_EQ(pixel_of(map(25.0)), pixel_of(map(20.0)));
  EXPECT_NE(pixel_of(map(12.0)), pixel_of(map(10.0)));
}

TEST(ColourMap, pixels_and_colours_are_inverse) { EXPECT_EQ(pixel_of(colour_of(0x12ab9f)), 0x12ab9fU); }

}  // namespace
}  // namespace peritherm
