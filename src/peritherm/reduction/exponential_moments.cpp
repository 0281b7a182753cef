#include "peritherm/reduction/exponential_moments.hpp"

#include <cmath>
#include <limits>

namespace peritherm {
namespace {

constexpr int degrees = input_degree + 1;
/// Below: series in z = decay / 2; above: recurrence in the degree, which loses nothing while degree < z.
constexpr double series_end = 10.0;
constexpr double integral_series_end = 0.5;
constexpr int integral_terms = 20;

/// ∫_{−1}^{1} s^k ds.
constexpr double power_integral(int k) { return k % 2 == 0 ? 2.0 / (k + 1) : 0.0; }

/// moments[k][n] = ∫ s^k (1 − s)^(n+1) ds / (n+1)! over (−1, 1), by parts.
using IntegralSeries = std::array<std::array<double, integral_terms>, degrees>;
IntegralSeries make_integral_series() {
  constexpr int most = integral_terms + degrees + 1;
  std::array<long double, most + 1> before{}, now{};
  IntegralSeries series{};
  for (int k = 0; k < degrees; ++k) {
    for (int q = 0; q < most - k; ++q) {
      const long double edge = std::ldexp(k % 2 == 0 ? 1.0L : -1.0L, q + 1);
      now[static_cast<std::size_t>(q)] = (k * before[static_cast<std::size_t>(q + 1)] + edge) / (q + 1);
    }
    long double factorial = 1.0L;
    for (int n = 0; n < integral_terms; ++n) {
      factorial *= n + 1;
      series[static_cast<std::size_t>(k)][static_cast<std::size_t>(n)] =
          static_cast<double>(now[static_cast<std::size_t>(n + 1)] / factorial);
    }
    before = now;
  }
  return series;
}

/// 1/n; a product costs a fraction of a division.
constexpr int series_terms = 200;
constexpr std::array<double, series_terms + degrees + 1> make_reciprocals() {
  std::array<double, series_terms + degrees + 1> values{};
  for (std::size_t n = 1; n < values.size(); ++n) values[n] = 1.0 / static_cast<double>(n);
  return values;
}
constexpr auto reciprocals = make_reciprocals();

/// ∫ exp(−z (1 − s)) s^k ds = exp(−z) Σ_n z^n/n! ∫ s^(n+k) ds: all terms of one sign.
void sum_final_series(double z, int degree, ExponentialMoments& moments) {
  std::array<double, degrees> sums{};
  double term = 1.0;
  for (int n = 0; n < series_terms; ++n) {
    for (int k = n % 2; k <= degree; k += 2) {
      sums[static_cast<std::size_t>(k)] += term * reciprocals[static_cast<std::size_t>(n + k + 1)];
    }
    term *= z * reciprocals[static_cast<std::size_t>(n + 1)];
    // Of the sums of odd degree the first term is z/(k + 2), so what is left out is compared with that.
    if (n > 1 && n > z &&
        std::abs(term) <= 0.01 * std::numeric_limits<double>::epsilon() * std::min(1.0, std::abs(z))) {
      break;
    }
  }
  const double scale = 2.0 * std::exp(-z);
  for (int k = 0; k <= degree; ++k) {
    moments.final[static_cast<std::size_t>(k)] = scale * sums[static_cast<std::size_t>(k)];
  }
}

/// By parts: z J_k = 1 − (−1)^k exp(−2z) − k J_{k−1}.
void recur_final(double z, int degree, ExponentialMoments& moments) {
  double before = 0.0;
  for (int k = 0; k <= degree; ++k) {
    before = (1.0 - (k % 2 == 0 ? moments.decay : -moments.decay) - k * before) / z;
    moments.final[static_cast<std::size_t>(k)] = before;
  }
}

/// ∫ s^k (1 − exp(−z (1 − s)))/z ds.
void fill_integrals(double z, int degree, ExponentialMoments& moments) {
  static const IntegralSeries series = make_integral_series();
  for (int k = 0; k <= degree; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (z > integral_series_end) {
      moments.integral[at] = (power_integral(k) - moments.final[at]) / z;
      continue;
    }
    double sum = 0.0;
    for (int n = integral_terms - 1; n >= 0; --n) sum = sum * -z + series[at][static_cast<std::size_t>(n)];
    moments.integral[at] = sum;
  }
}

}  // namespace

ExponentialMoments exponential_moments(double decay, int degree) {
  ExponentialMoments moments;
  const double z = 0.5 * decay;
  moments.decay = std::exp(-decay);
  moments.mean_decay = decay == 0.0 ? 1.0 : -std::expm1(-decay) / decay;
  if (z < series_end) {
    sum_final_series(z, degree, moments);
  } else {
    recur_final(z, degree, moments);
  }
  fill_integrals(z, degree, moments);
  return moments;
}

std::span<const ExponentialMoments> MomentTable::at(double length, int degree) {
  for (const Step& step : steps_) {
    if (step.length == length && step.degree == degree) return step.moments;
  }
  Step& step = steps_[next_];
  next_ = (next_ + 1) % steps_.size();
  step.length = length;
  step.degree = degree;
  step.moments.resize(rates_.size());
  for (std::size_t n = 0; n < rates_.size(); ++n) step.moments[n] = exponential_moments(rates_[n] * length, degree);
  return step.moments;
}

}  // namespace peritherm
