#include "peritherm/solutions/heat_wave.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peritherm {
namespace {

TEST(HeatWave, the_known_value_and_the_front_are_met) {
  EXPECT_NEAR(heat_wave(0.5, 0.7), 0.78810, 0.5e-5);
  EXPECT_DOUBLE_EQ(heat_wave(0.0, 0.7), 1.0);
  EXPECT_DOUBLE_EQ(heat_wave(0.7, 0.7 - 1e-9), 0.0);
  EXPECT_NEAR(heat_wave(0.7, 0.7 + 1e-12), std::exp(-0.35), 1e-11);
}

TEST(HeatWave, the_wake_satisfies_the_equation_of_telegraphy) {
  const double h = 1e-3;
  for (const double theta : {0.9, 3.0, 12.0}) {
    for (const double xi : {0.2, 0.6}) {
      const double middle = heat_wave(xi, theta);
      const double before = heat_wave(xi, theta - h);
      const double after = heat_wave(xi, theta + h);
      const double second = (after - 2.0 * middle + before) / (h * h);
      const double curvature = (heat_wave(xi + h, theta) - 2.0 * middle + heat_wave(xi - h, theta)) / (h * h);
      // Fourth derivatives are below 1, times h²/12; rounding 4e-16/h².
      EXPECT_NEAR(second + (after - before) / (2.0 * h), curvature, 2e-9 + 4e-7) << xi << ", " << theta;
    }
  }
}

TEST(HeatWave, late_waves_are_diffusion) {
  // T = erfc(ξ/√(4θ)) + O(1/θ).
  EXPECT_NEAR(heat_wave(20.0, 600.0), std::erfc(20.0 / std::sqrt(2400.0)), 1.0 / 600.0);
  EXPECT_TRUE(std::isfinite(heat_wave(0.1, 600.0)));
}

TEST(DiscInGradient, the_contact_keeps_the_flux_and_lets_the_temperature_jump) {
  const DiscInGradient disc{0.3, 5.0, 2.0, 0.04};
  const double h = 1e-6;
  for (const double angle : {0.0, 0.6, 2.0}) {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    const auto at = [&](double radius) { return disc.temperature(radius * cosine, radius * sine); };
    const double inside = -5.0 * (at(0.3 - h) - at(0.3 - 2.0 * h)) / h;
    const double outside = -2.0 * (at(0.3 + 2.0 * h) - at(0.3 + h)) / h;
    // Differences of first order: h times curvatures below 20.
    EXPECT_NEAR(inside, outside, 1e-4);
    EXPECT_NEAR(at(0.3 - h) - at(0.3 + h), 0.04 * outside, 1e-5);
  }
  EXPECT_NEAR(disc.temperature(1e4, 7.0), 1e4, 1e-4);
  EXPECT_DOUBLE_EQ((DiscInGradient{0.3, 2.0, 2.0, 0.0}).slope(), 1.0);
}

TEST(RingsInContact, the_heat_is_the_same_everywhere) {
  const RingsInContact rings{0.1, 0.3, 0.7, 5.0, 2.0, 0.04, 90.0, 20.0};
  const double heat = rings.heat_per_angle();
  EXPECT_DOUBLE_EQ(rings.temperature_inside(0.1), 90.0);
  EXPECT_DOUBLE_EQ(rings.temperature_outside(0.7), 20.0);
  EXPECT_NEAR(rings.temperature_inside(0.3) - rings.temperature_outside(0.3), 0.04 * heat / 0.3, 1e-12);
  const double h = 1e-5;
  const double inside = (rings.temperature_inside(0.2 + h) - rings.temperature_inside(0.2 - h)) / (2.0 * h);
  const double outside = (rings.temperature_outside(0.5 + h) - rings.temperature_outside(0.5 - h)) / (2.0 * h);
  EXPECT_NEAR(-5.0 * 0.2 * inside, heat, 1e-5);
  EXPECT_NEAR(-2.0 * 0.5 * outside, heat, 1e-5);
}

}  // namespace
}  // namespace peritherm
