#include "peritherm/integrators/chebyshev_coefficients.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peritherm {
namespace {

/// φ_{j+1}(z) from its series near 0 and from its recurrence elsewhere.
double phi(int j, double z) {
  if (std::abs(z) < 1.0) {
    double term = 1.0, sum = 0.0;
    for (int k = 1; k <= j + 1; ++k) term /= k;
    for (int k = j + 2; k < j + 30; ++k) {
      sum += term;
      term *= z / k;
    }
    return sum;
  }
  double value = std::expm1(z) / z, factorial = 1.0;
  for (int k = 1; k <= j; ++k) {
    factorial *= k;
    value = (value - 1.0 / factorial) / z;
  }
  return value;
}

double series(const std::vector<double>& coefficients, double xi) {
  double sum = 0.0;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    sum += (k == 0 ? 0.5 : 1.0) * coefficients[k] * std::cos(static_cast<double>(k) * std::acos(xi));
  }
  return sum;
}

TEST(ChebyshevCoefficients, reproduce_the_functions_to_rounding) {
  for (const double decay : {1e-30, 1e-9, 1e-3, 0.5, 30.0, 816.0, 1.35e4, 1e6}) {
    const double rate = 3.0, time = decay / rate;
    const auto coefficients = propagator_coefficients(rate, time, 2);
    for (int j = 0; j < 3; ++j) {
      for (int n = 0; n <= 10; ++n) {
        const double xi = 1.0 - 0.2 * n;
        const double exact = std::pow(time, j + 1) * phi(j, 0.5 * decay * (xi - 1.0));
        // Each of sqrt(decay) terms and cosines of large arguments adds a rounding.
        const double allowed = 1e-15 * (10.0 + std::sqrt(decay)) * std::pow(time, j + 1);
        EXPECT_NEAR(series(coefficients[static_cast<std::size_t>(j)], xi), exact, allowed)
            << decay << ' ' << j << ' ' << n;
      }
    }
  }
}

TEST(ChebyshevCoefficients, fall_and_stay_positive) {
  for (const auto& coefficients : propagator_coefficients(2.0, 1e4, 2)) {
    for (std::size_t k = 1; k < coefficients.size(); ++k) {
      EXPECT_GT(coefficients[k], 0.0);
      EXPECT_LT(coefficients[k], coefficients[k - 1]);
    }
  }
}

TEST(ChebyshevCoefficients, truncation_errs_as_little_as_asked_for_and_not_at_all_where_nothing_decays) {
  const std::vector<double> all = propagator_coefficients(1.0, 1e3, 0).front();
  for (const double error : {1.0, 1e-3, 1e-9}) {
    std::vector<double> kept = all;
    truncate(kept, error);
    EXPECT_LT(kept.size(), all.size());
    EXPECT_NEAR(series(kept, 1.0), 1e3, 1e-14 * 1e3 * std::sqrt(1e3));
    for (int n = 1; n <= 10; ++n) EXPECT_NEAR(series(kept, 1.0 - 0.2 * n), series(all, 1.0 - 0.2 * n), 2.0 * error);
  }
}

}  // namespace
}  // namespace peritherm
