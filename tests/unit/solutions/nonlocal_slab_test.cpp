#include "peritherm/solutions/nonlocal_slab.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

/// ∫₀^z f by the trapezoidal rule on tanh-sinh nodes, which doubles its digits with each halving of the step.
template <class Function>
double integral_to(double z, const Function& f) {
  const double step = 1.0 / 64.0;
  double sum = 0.0;
  for (int k = -300; k <= 300; ++k) {
    const double sinh = 0.5 * std::numbers::pi * std::sinh(k * step);
    const double weight = 0.5 * std::numbers::pi * std::cosh(k * step) / (std::cosh(sinh) * std::cosh(sinh));
    sum += weight * f(0.5 * z * (1.0 + std::tanh(sinh)));
  }
  return 0.5 * z * step * sum;
}

double one_minus_cosine_over_square(double s) {
  const double half = s == 0.0 ? 1.0 : std::sin(0.5 * s) / (0.5 * s);
  return 0.5 * half * half;
}

TEST(NonlocalSlab, the_factor_is_its_integral) {
  for (const double z : {1e-8, 1e-3, 0.1, 1.0, 3.9, 3.999999, 4.0, 4.1, 7.0, 15.0}) {
    EXPECT_NEAR(nonlocal_factor(z), 2.0 / z * integral_to(z, one_minus_cosine_over_square), rounding(60, 1.0)) << z;
    const auto sinc = [](double s) { return s == 0.0 ? 1.0 : std::sin(s) / s; };
    EXPECT_NEAR(sine_integral(z), integral_to(z, sinc), rounding(60, 2.0)) << z;
  }
}

TEST(NonlocalSlab, the_sine_integral_has_its_tabulated_values) {
  // [abramowitz1964, table 5.1] and its limit.
  EXPECT_NEAR(sine_integral(1.0), 0.9460830704, 0.5e-10);
  EXPECT_NEAR(sine_integral(5.0), 1.5499312449, 0.5e-10);
  EXPECT_NEAR(sine_integral(10.0), 1.6583475942, 0.5e-10);
  EXPECT_EQ(sine_integral(-2.0), -sine_integral(2.0));
  EXPECT_EQ(sine_integral(1e300), 0.5 * std::numbers::pi);
}

TEST(NonlocalSlab, the_factor_begins_like_its_series_and_ends_like_its_tail) {
  // A = 1 − z²/36 + z⁴/1800 − …, B = −z/18 + z³/450 − …; for large z, z A → π − 2/z − 2 sin z/z².
  EXPECT_EQ(nonlocal_factor(0.0), 1.0);
  EXPECT_EQ(nonlocal_factor_slope(0.0), 0.0);
  for (const double z : {1e-160, 1e-9, 1e-4}) {
    EXPECT_DOUBLE_EQ(nonlocal_factor(z), 1.0 - z * z / 36.0);
    EXPECT_DOUBLE_EQ(nonlocal_factor_slope(z), -z / 18.0 + z * z * z / 450.0);
  }
  for (const double z : {1e4, 1e8, 1e16, 1e150}) {
    const double square = z * z;
    EXPECT_NEAR(z * nonlocal_factor(z), std::numbers::pi - 2.0 / z, 2.5 / square + rounding(10, std::numbers::pi)) << z;
    EXPECT_NEAR(square * nonlocal_factor_slope(z), (4.0 - 2.0 * std::cos(z)) / z - std::numbers::pi,
                2.5 / square + rounding(20, std::numbers::pi))
        << z;
  }
  EXPECT_EQ(nonlocal_factor(-3.0), nonlocal_factor(3.0));
  EXPECT_EQ(nonlocal_factor_slope(-7.0), -nonlocal_factor_slope(7.0));
}

TEST(NonlocalSlab, the_slope_of_the_factor_is_its_derivative_and_negative) {
  for (const double z : {0.05, 0.7, 3.0, 3.99, 4.01, 9.0, 40.0, 700.0}) {
    const double step = 1e-3 * std::min(1.0, z);
    const auto difference = [z](double h) { return (nonlocal_factor(z + h) - nonlocal_factor(z - h)) / (2.0 * h); };
    // Richardson's extrapolation leaves the step to the fourth power; derivatives of A are below 1.
    const double derivative = (4.0 * difference(0.5 * step) - difference(step)) / 3.0;
    EXPECT_NEAR(nonlocal_factor_slope(z), derivative, std::pow(step, 4) + rounding(10, 1.0) / step) << z;
    EXPECT_LT(nonlocal_factor_slope(z), 0.0);
  }
}

NonlocalSlab bar_of_2021(double horizon) { return {10.0, 10.0, horizon}; }

TEST(NonlocalSlab, has_its_known_values_in_the_middle) {
  struct Row {
    double horizon, early, middle, late;
  };
  for (const auto& [horizon, early, middle, late] :
       {Row{1.0, 91.64383283, 83.10038180, 77.27949332}, Row{0.5, 91.72716194, 83.10091927, 77.24364430},
        Row{0.25, 91.74778204, 83.10060339, 77.23430657}}) {
    EXPECT_NEAR(100.0 * nonlocal_slab_with_held_ends(bar_of_2021(horizon), 5.0, 0.3), early, 0.5e-8);
    EXPECT_NEAR(100.0 * nonlocal_slab_with_held_ends(bar_of_2021(horizon), 5.0, 0.42), middle, 0.5e-8);
    EXPECT_NEAR(100.0 * nonlocal_slab_with_held_ends(bar_of_2021(horizon), 5.0, 0.5), late, 0.5e-8);
  }
}

/// Its plain series in extended precision, at most 2e6 terms.
double by_plain_series(const NonlocalSlab& slab, double x, double t) {
  long double sum = 0.0L;
  for (int n = 1; n < 4'000'000; n += 2) {
    const double wave = n * std::numbers::pi / slab.length;
    const double exponent = slab.diffusivity * nonlocal_factor(wave * slab.horizon) * wave * wave * t;
    if (exponent > 45.0) break;
    sum += 4.0L / (n * std::numbers::pi_v<long double>)*std::sin(wave * x) * std::exp(-exponent);
  }
  return static_cast<double>(sum);
}

TEST(NonlocalSlab, early_times_agree_with_the_plain_series) {
  // t in units of δ²/α; the modes are taken alone from 1 on. A bar shorter than twice the horizon too.
  for (const double length : {10.0, 0.4}) {
    const NonlocalSlab slab{length, 10.0, 0.25};
    for (const double scaled_time : {0.01, 0.3, 1.0 - 1e-9, 1.0, 20.0}) {
      const double t = scaled_time * slab.horizon * slab.horizon / slab.diffusivity;
      for (const double x : {0.001, 0.1, 0.2}) {
        EXPECT_NEAR(nonlocal_slab_with_held_ends(slab, x, t), by_plain_series(slab, x, t), 1e-12) << x << ", " << t;
      }
      // Where a horizon ends the closed forms have their kink.
      if (length > 1.0) {
        EXPECT_NEAR(nonlocal_slab_with_held_ends(slab, 0.25, t), by_plain_series(slab, 0.25, t), 1e-12) << t;
      }
    }
  }
}

TEST(NonlocalSlab, a_long_bar_is_the_short_one_at_early_times) {
  // Bars beyond sixty horizons are cut at early times.
  const double t = 0.9 * 0.01 * 0.01 / 10.0;
  for (const double x : {0.002, 0.01, 0.05}) {
    EXPECT_NEAR(nonlocal_slab_with_held_ends({0.59, 10.0, 0.01}, x, t),
                nonlocal_slab_with_held_ends({10.0, 10.0, 0.01}, x, t), 1e-12);
  }
}

TEST(NonlocalSlab, begins_at_one_and_satisfies_its_equation_at_first) {
  // At t → 0 a point at depth d < δ loses α/δ ∫ 2/s² ds over the bonds that reach beyond the end, s from d to δ.
  const NonlocalSlab slab{10.0, 10.0, 1.0};
  EXPECT_EQ(nonlocal_slab_with_held_ends(slab, 0.5, 0.0), 1.0);
  EXPECT_EQ(nonlocal_slab_with_held_ends(slab, 0.0, 0.1), 0.0);
  const double t = 1e-7;
  const double rate = 10.0 * 2.0 * (1.0 / 0.5 - 1.0);
  // Up to terms of second order in the time, at most (rate + 2 α/(δ d))² t².
  EXPECT_NEAR(nonlocal_slab_with_held_ends(slab, 0.5, t), 1.0 - rate * t, 3600.0 * t * t + 1e-12);
}

TEST(NonlocalSlab, its_slope_over_the_horizon_changes_sign_at_the_known_times) {
  struct Row {
    double x, horizon, time;
  };
  for (const auto& [x, horizon, time] :
       {Row{1.1875, 0.1, 0.023574}, Row{1.1875, 0.25, 0.023942}, Row{1.1875, 0.5, 0.025173}, Row{1.1875, 1.0, 0.028934},
        Row{5.0, 0.1, 0.416676}, Row{5.0, 0.25, 0.417046}, Row{5.0, 0.5, 0.418366}, Row{5.0, 1.0, 0.423584}}) {
    EXPECT_LT(nonlocal_slab_slope_over_horizon(bar_of_2021(horizon), x, time - 0.5e-6), 0.0) << x << ", " << horizon;
    EXPECT_GT(nonlocal_slab_slope_over_horizon(bar_of_2021(horizon), x, time + 0.5e-6), 0.0) << x << ", " << horizon;
  }
}

TEST(NonlocalSlab, its_slope_over_the_horizon_has_its_known_values) {
  const auto slope = [](double horizon, double x, double t) {
    return 100.0 * nonlocal_slab_slope_over_horizon(bar_of_2021(horizon), x, t);
  };
  EXPECT_NEAR(slope(0.25, 1.1875, 0.02), -0.2574, 0.5e-4);
  EXPECT_NEAR(slope(0.25, 1.1875, 0.03), 0.2648, 0.5e-4);
  EXPECT_NEAR(slope(0.25, 1.1875, 0.1), 0.3764, 0.5e-4);
  EXPECT_NEAR(slope(0.25, 5.0, 0.3), -0.05486, 0.5e-5);
  EXPECT_NEAR(slope(0.25, 5.0, 0.42), 0.001086, 0.5e-6);
  EXPECT_NEAR(slope(0.25, 5.0, 0.5), 0.02510, 0.5e-5);
  EXPECT_NEAR(slope(1.0, 5.0, 0.42), -0.00522, 0.5e-5);
  // It is the derivative: third derivatives over the horizon are below 1 there.
  const double step = 1e-3;
  const double difference = nonlocal_slab_with_held_ends(bar_of_2021(0.5 + step), 5.0, 0.3) -
                            nonlocal_slab_with_held_ends(bar_of_2021(0.5 - step), 5.0, 0.3);
  EXPECT_NEAR(nonlocal_slab_slope_over_horizon(bar_of_2021(0.5), 5.0, 0.3), 0.5 * difference / step, step * step);
}

}  // namespace
}  // namespace peritherm
