#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "peritherm/solutions/classical.hpp"

namespace peritherm {
namespace {

using Complex = std::complex<double>;

/// Carlson's R_F(x, y, 1) by duplication, for x and y in the lower half-plane or on the positive axis.
Complex carlson_rf(Complex x, Complex y) {
  Complex z = 1.0;
  const Complex start = (x + y + z) / 3.0;
  const double spread = std::max({std::abs(start - x), std::abs(start - y), std::abs(start - z)});
  Complex mean = start;
  const Complex difference_x = start - x;
  const Complex difference_y = start - y;
  double quarter = 1.0;
  // The remainder of the series below is of the order of (spread / mean)⁶.
  while (quarter * spread > 1e-3 * std::abs(mean)) {
    const Complex lambda = std::sqrt(x) * std::sqrt(y) + std::sqrt(y) * std::sqrt(z) + std::sqrt(z) * std::sqrt(x);
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
    mean = 0.25 * (mean + lambda);
    quarter *= 0.25;
  }
  const Complex u = quarter * difference_x / mean;
  const Complex v = quarter * difference_y / mean;
  const Complex e2 = u * v - (u + v) * (u + v);
  const Complex e3 = -u * v * (u + v);
  return (1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0) / std::sqrt(mean);
}

/// Complete elliptic integral K of the parameter m = k², by the arithmetic-geometric mean.
double complete_integral(double parameter) {
  double a = 1.0;
  double b = std::sqrt(1.0 - parameter);
  while (std::abs(a - b) > 1e-15 * a) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 0.5 * std::numbers::pi / a;
}

struct Jacobi {
  double sn, cn, dn;
};

/// Jacobi's functions for k² = 1/2, by descending Landen steps [abramowitz1964, section 16.4].
Jacobi jacobi_of_half(double u) {
  constexpr int steps = 6;
  double a = 1.0;
  double b = std::numbers::sqrt2 / 2.0;
  double ratios[steps];
  for (double& ratio : ratios) {
    const double mean = 0.5 * (a + b);
    ratio = 0.5 * (a - b) / mean;
    b = std::sqrt(a * b);
    a = mean;
  }
  double phase = std::ldexp(a * u, steps);
  for (int k = steps - 1; k >= 0; --k) phase = 0.5 * (phase + std::asin(ratios[k] * std::sin(phase)));
  const double sn = std::sin(phase);
  return {sn, std::cos(phase), std::sqrt(1.0 - 0.5 * sn * sn)};
}

/// The image of x + iy under sn²(K z), k² = 1/2: 0, 1, 1 + i, i go to 0, 1, 2, ∞ and the square to a half-plane.
Complex half_plane_of(double x, double y) {
  const double quarter_period = complete_integral(0.5);
  const auto [s, c, d] = jacobi_of_half(quarter_period * x);
  const auto [s1, c1, d1] = jacobi_of_half(quarter_period * y);
  const Complex sn = Complex(s * d1, c * d * s1 * c1) / (c1 * c1 + 0.5 * s * s * s1 * s1);
  const Complex image = sn * sn;
  return {image.real(), std::max(0.0, image.imag())};
}

/// Where the tip of the slit goes.
double tip_image(double half_length) { return half_plane_of(half_length, 0.0).real(); }

/// k² of the rectangle whose upper side is the held one and whose lower side is the gap beside the slit.
double parameter_of(double tip) { return (1.0 - tip) / (2.0 - tip); }

}  // namespace

double slit_in_gradient(double half_length, double x, double y) {
  const Complex root = std::sqrt(Complex(x - half_length, y)) * std::sqrt(Complex(x + half_length, y));
  return root.imag();
}

double slit_in_square(double half_length, double x, double y) {
  if (std::abs(y) >= 1.0) return std::copysign(1.0, y);
  const double tip = tip_image(half_length);
  const double parameter = parameter_of(tip);
  const Complex image = (half_plane_of(std::abs(x), std::abs(y)) - tip) / (1.0 - tip);
  // F(√s; k) = √s R_F(1 − s, 1 − k² s, 1) maps the half-plane back to a rectangle of height K(1 − k²).
  const Complex place = std::sqrt(image) * carlson_rf(1.0 - image, 1.0 - parameter * image);
  return std::copysign(place.imag() / complete_integral(1.0 - parameter), y);
}

double slit_in_square_conductance(double half_length) {
  const double parameter = parameter_of(tip_image(half_length));
  return complete_integral(parameter) / complete_integral(1.0 - parameter);
}

}  // namespace peritherm
