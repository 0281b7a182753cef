#include "peritherm/solutions/laplace_series.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace peritherm {

namespace {

/// 1 up to the middle of the series, 0 at its end, smooth between: so cut off, a series is wrong near kinks of f only,
/// within some 1e-4 of the period.
double fading(int term, int terms) {
  const double part = 2.0 * term / terms - 1.0;
  return part < 0.0 ? 1.0 : 0.5 * std::erfc(12.0 * part - 6.0);
}

}  // namespace

double invert_laplace_series(const LaplaceTransform& transform, double time, double tolerance, int terms) {
  constexpr int group = 64;
  const double period = 2.0 * time;
  const double damping = 18.0 / period;
  const double scale = std::exp(damping * time) / period;
  double sum = 0.5 * transform(damping).real();
  double recent = 0.0;
  for (int k = 1; k <= terms; ++k) {
    const std::complex<double> value = transform({damping, k * std::numbers::pi / period});
    // Re(value i^k).
    const std::array<double, 4> turned{value.real(), -value.imag(), -value.real(), value.imag()};
    sum += fading(k, terms) * turned[static_cast<std::size_t>(k % 4)];
    recent += std::abs(value);
    if (k % group != 0) continue;
    if (scale * recent < tolerance) break;
    recent = 0.0;
  }
  return scale * sum;
}

}  // namespace peritherm
