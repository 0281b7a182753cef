#include "peritherm/solutions/nonlocal_slab.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace peritherm {
namespace {

using Wave = std::complex<double>;

constexpr double straight = std::numbers::pi;

/// Power series are used below, the continued fraction and what comes from it from here on.
constexpr double series_end = 4.0;

/// e^{iz} E₁(iz) = f-part of the sine integral, by Lentz's algorithm for the continued fraction
/// 1/(1 + iz − 1/(3 + iz − 4/(5 + iz − …))).
Wave exponential_integral_fraction(double z) {
  Wave b(1.0, z);
  Wave c(1.0 / std::numeric_limits<double>::min(), 0.0);
  Wave d = 1.0 / b;
  Wave value = d;
  for (int i = 1; i < 400; ++i) {
    const double a = -static_cast<double>(i) * i;
    b += 2.0;
    d = 1.0 / (a * d + b);
    c = b + a / c;
    const Wave factor = c * d;
    value *= factor;
    if (std::abs(factor - 1.0) < 2e-16) break;
  }
  return value;
}

/// Σ (−1)^n 2 z^{2n} / ((2n + 2)! (2n + 1)).
double factor_series(double z) {
  double power = 1.0;
  double sum = 0.0;
  for (int n = 0; n < 40 && std::abs(power) > 1e-18; ++n) {
    sum += power / (2 * n + 1);
    power *= -z * z / ((2 * n + 3) * (2 * n + 4));
  }
  return sum;
}

/// Σ (−1)^n 4n z^{2n−1} / ((2n + 2)! (2n + 1)).
double slope_series(double z) {
  double power = -z / 12.0;
  double sum = 0.0;
  for (int n = 1; n < 40 && std::abs(power) > 1e-18 * std::abs(z); ++n) {
    sum += power * 2.0 * n / (2 * n + 1);
    power *= -z * z / ((2 * n + 3) * (2 * n + 4));
  }
  return sum;
}

/// λ δ²/α = z² A(z).
double scaled_rate(double z) { return z * z * nonlocal_factor(z); }

/// The same less its tail πz − 2, which is −2 sin z / z + O(1/z²).
double rate_beyond_tail(double z) {
  if (z < series_end) return scaled_rate(z) - straight * z + 2.0;
  const Wave tail = Wave(std::cos(z), -std::sin(z)) * exponential_integral_fraction(z);
  return 2.0 * z * tail.imag() + 2.0 * std::cos(z);
}

/// Dilogarithm Σ w^n / n² for |w| ≤ 1, by its series of Bernoulli numbers B_{2n} / (2n + 1)! in −log(1 − w).
Wave dilogarithm(Wave w) {
  constexpr double coefficients[] = {1.0 / 36.0,
                                     -1.0 / 3600.0,
                                     1.0 / 211680.0,
                                     -1.0 / 10886400.0,
                                     1.0 / 526901760.0,
                                     -691.0 / 16999766784000.0,
                                     1.0 / 1120863744000.0,
                                     -3617.0 / 181400588328960000.0,
                                     43867.0 / 97072790126247936000.0,
                                     -174611.0 / 16860010916664115200000.0};
  if (w == Wave(1.0)) return straight * straight / 6.0;
  const bool reflected = w.real() > 0.5;
  const Wave u = reflected ? -std::log(w) : -std::log(1.0 - w);
  Wave sum = u - 0.25 * u * u;
  Wave power = u;
  for (const double coefficient : coefficients) {
    power *= u * u;
    sum += coefficient * power;
  }
  return reflected ? straight * straight / 6.0 - std::log(w) * std::log(1.0 - w) - sum : sum;
}

/// Σ_{n odd} q^n cos(nφ) / n².
double odd_cosine_sum(double q, double phase) {
  const Wave w = std::polar(q, phase);
  return 0.5 * (dilogarithm(w) - dilogarithm(-w)).real();
}

/// Terms n, n + 2, … of the modes as they stand. `weight` multiplies each of them.
template <class Weight>
double sum_of_modes(const NonlocalSlab& slab, double x, double scaled_time, const Weight& weight) {
  const double step = straight * slab.horizon / slab.length;
  double sum = 0.0;
  for (int n = 1; n < 20'000'000; n += 2) {
    const double exponent = scaled_time * scaled_rate(n * step);
    if (exponent > 40.0 + scaled_time * scaled_rate(step)) break;
    sum += 4.0 / (n * straight) * weight(n * step) * std::sin(n * straight * x / slab.length) * std::exp(-exponent);
  }
  return sum;
}

/// With the tails of the rates and their first correction summed in closed form: Σ_{n odd} q^n sin(nφ)/n is half an
/// arctangent and Σ_{n odd} q^n sin(nφ) sin(nζ)/n² a difference of dilogarithms. What is left falls like 1/n³.
double sum_beyond_tail(const NonlocalSlab& slab, double x, double scaled_time) {
  const double step = straight * slab.horizon / slab.length;
  const double phase = straight * x / slab.length;
  const double decay = scaled_time * straight * step;  // q = exp(−decay)
  const double q = std::exp(-decay);
  const double all = std::exp(2.0 * scaled_time);
  double sum = 2.0 / straight * std::atan2(2.0 * q * std::sin(phase), -std::expm1(-2.0 * decay));
  sum += 4.0 * scaled_time / (straight * step) * (odd_cosine_sum(q, phase - step) - odd_cosine_sum(q, phase + step));
  const double tail = 8.0 * scaled_time / (step * step);
  for (int n = 1; tail * std::exp(-decay * n) > 1e-12 * n * n; n += 2) {
    const double z = n * step;
    const double rest = std::expm1(-scaled_time * rate_beyond_tail(z)) - 2.0 * scaled_time * std::sin(z) / z;
    sum += 4.0 / (n * straight) * std::sin(n * phase) * std::exp(-decay * n) * rest;
  }
  return all * sum;
}

}  // namespace

double sine_integral(double z) {
  const double size = std::abs(z);
  if (size < series_end) {
    double power = z;
    double sum = 0.0;
    for (int n = 1; n < 60 && std::abs(power) > 1e-18 * size; n += 2) {
      sum += power / n;
      power *= -z * z / ((n + 1) * (n + 2));
    }
    return sum;
  }
  if (std::isinf(size)) return std::copysign(0.5 * straight, z);
  const Wave tail = Wave(std::cos(size), -std::sin(size)) * exponential_integral_fraction(size);
  return std::copysign(0.5 * straight + tail.imag(), z);
}

double nonlocal_factor(double z) {
  const double size = std::abs(z);
  if (size < series_end) return factor_series(size);
  if (std::isinf(size)) return 0.0;
  const double half = std::sin(0.5 * size);
  return 2.0 * (sine_integral(size) - 2.0 * half * half / size) / size;
}

double nonlocal_factor_slope(double z) {
  const double size = std::abs(z);
  if (size < series_end) return slope_series(z);
  if (std::isinf(size)) return 0.0;
  const double half = std::sin(0.5 * size);
  const double slope = (4.0 * half * half / (size * size) - nonlocal_factor(size)) / size;
  return z < 0.0 ? -slope : slope;
}

double nonlocal_slab_with_held_ends(const NonlocalSlab& slab, double x, double t) {
  const double scaled_time = slab.diffusivity * t / (slab.horizon * slab.horizon);
  const double from_end = std::min(x, slab.length - x);
  if (from_end <= 0.0) return 0.0;
  if (scaled_time >= 1.0) return sum_of_modes(slab, x, scaled_time, [](double) { return 1.0; });
  NonlocalSlab near = slab;
  // In so short a time nothing is felt thirty horizons away: exp(−30 (log 15 − 1)) is 1e-22.
  near.length = std::min(slab.length, 60.0 * slab.horizon);
  if (scaled_time * straight * straight * near.horizon < 1e-16 * near.length) return 1.0;
  return sum_beyond_tail(near, std::min(from_end, 0.5 * near.length), scaled_time);
}

double nonlocal_slab_slope_over_horizon(const NonlocalSlab& slab, double x, double t) {
  const double scaled_time = slab.diffusivity * t / (slab.horizon * slab.horizon);
  const auto weight = [scaled_time, &slab](double z) {
    return -scaled_time * z * z * z * nonlocal_factor_slope(z) / slab.horizon;
  };
  return sum_of_modes(slab, x, scaled_time, weight);
}

}  // namespace peritherm
