#include "peritherm/reduction/exponential_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace peritherm {
namespace {

/// ∫ over (−1, 1) by the rule of Gauss and Legendre with 5 nodes on each of so many panels, in long double.
template <class Integrand>
long double integrate_panels(const Integrand& integrand, int panels) {
  constexpr long double nodes[] = {0.0L, 0.538469310105683091036314420700208805L,
                                   0.906179845938663992797626878299392966L};
  constexpr long double weights[] = {0.568888888888888888888888888888888889L, 0.478628670499366468041291514835638193L,
                                     0.236926885056189087514264040719917363L};
  long double sum = 0.0L;
  const long double half = 1.0L / panels;
  for (int n = 0; n < panels; ++n) {
    const long double middle = -1.0L + (2 * n + 1) * half;
    sum += half * weights[0] * integrand(middle);
    for (int k = 1; k < 3; ++k) {
      sum += half * weights[k] * (integrand(middle - half * nodes[k]) + integrand(middle + half * nodes[k]));
    }
  }
  return sum;
}

TEST(ExponentialMoments, agree_with_quadrature_for_any_decay) {
  for (const double decay : {0.0, 1e-14, 1e-6, 0.01, 0.3, 0.999, 1.001, 2.0, 7.0, 19.9, 20.1, 40.0, 100.0, 400.0}) {
    const ExponentialMoments moments = exponential_moments(decay, input_degree);
    const long double z = 0.5L * decay;
    const int panels = 60 + static_cast<int>(4.0 * decay);
    EXPECT_DOUBLE_EQ(moments.decay, std::exp(-decay));
    for (int k = 0; k <= input_degree; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const auto final = [&](long double s) {
        return std::exp(-z * (1.0L - s)) * std::pow(s, static_cast<long double>(k));
      };
      const auto integral = [&](long double s) {
        const long double mean = z == 0.0L ? 1.0L - s : -std::expm1(-z * (1.0L - s)) / z;
        return mean * std::pow(s, static_cast<long double>(k));
      };
      const long double right = integrate_panels(final, panels), right_integral = integrate_panels(integral, panels);
      // Roundings relative to the integrals of absolute values: odd powers nearly cancel themselves.
      const double scale = moments.final[static_cast<std::size_t>(k / 2 * 2)];
      EXPECT_NEAR(moments.final[at], static_cast<double>(right), 1e-14 * scale) << decay << " " << k;
      EXPECT_NEAR(moments.integral[at], static_cast<double>(right_integral), 4e-15 / (1.0 + 0.5 * decay))
          << decay << " " << k;
    }
  }
}

TEST(ExponentialMoments, stay_finite_where_nothing_is_left_of_the_start) {
  for (const double decay : {1e3, 1e6, 1e12, 1e300}) {
    const ExponentialMoments moments = exponential_moments(decay, input_degree);
    EXPECT_EQ(moments.decay, 0.0);
    for (std::size_t k = 0; k <= input_degree; ++k) {
      // The modes follow their inputs: ∫ exp(−z (1 − s)) s^k ds → 1/z.
      EXPECT_NEAR(moments.final[k] * 0.5 * decay, 1.0, 2.0 * input_degree / decay + 1e-15);
      const double power = k % 2 == 0 ? 2.0 / static_cast<double>(k + 1) : 0.0;
      EXPECT_NEAR(moments.integral[k] * 0.5 * decay, power, 2.1 / decay + 1e-15);
    }
  }
}

TEST(ExponentialMoments, leave_degrees_alone_that_nobody_asks_for) {
  const ExponentialMoments moments = exponential_moments(0.7, 2);
  EXPECT_GT(moments.final[2], 0.0);
  for (std::size_t k = 3; k <= input_degree; ++k) EXPECT_EQ(moments.final[k], 0.0);
}

TEST(MomentTable, is_what_each_rate_has_however_often_it_is_asked) {
  const std::vector<double> rates{0.0, 0.3, 40.0};
  MomentTable table(rates);
  // More lengths than it keeps, each asked for twice, at two degrees.
  for (int number = 0; number < 48; ++number) {
    const double length = 1.0 + number % 12;
    const int degree = number % 24 < 12 ? 0 : 8;
    const auto moments = table.at(length, degree);
    ASSERT_EQ(moments.size(), rates.size());
    for (std::size_t n = 0; n < rates.size(); ++n) {
      const ExponentialMoments alone = exponential_moments(rates[n] * length, degree);
      EXPECT_EQ(moments[n].decay, alone.decay);
      EXPECT_EQ(moments[n].final, alone.final);
      EXPECT_EQ(moments[n].integral, alone.integral);
    }
    EXPECT_EQ(table.at(length, degree).data(), moments.data());
  }
}

}  // namespace
}  // namespace peritherm
