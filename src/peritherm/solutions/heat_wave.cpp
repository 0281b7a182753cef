#include "peritherm/solutions/heat_wave.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace peritherm {
namespace {

/// e^{−u/2} I₁(w/2)/w, w = √(u² − ξ²): a smooth function of u, 1/4 e^{−u/2} at w = 0.
double wake(double u, double xi) {
  const double w = std::sqrt(std::max(0.0, (u - xi) * (u + xi)));
  const double ratio = w < 1e-4 ? 0.25 * (1.0 + w * w / 32.0) : std::cyl_bessel_i(1.0, 0.5 * w) / w;
  return std::exp(-0.5 * u) * ratio;
}

}  // namespace

double heat_wave(double xi, double theta) {
  if (theta < xi) return 0.0;
  // Gauss's rule of ten points on pieces of at most 1, on which the integrand is all but a polynomial.
  constexpr std::array<double, 5> nodes{0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                        0.9739065285171717};
  constexpr std::array<double, 5> weights{0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                          0.1494513491505806, 0.0666713443086881};
  const int pieces = static_cast<int>(std::ceil(theta - xi)) + 1;
  const double half = 0.5 * (theta - xi) / pieces;
  double integral = 0.0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = xi + (2 * piece + 1) * half;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      integral += half * weights[k] * (wake(middle - half * nodes[k], xi) + wake(middle + half * nodes[k], xi));
    }
  }
  return std::exp(-0.5 * xi) + 0.5 * xi * integral;
}

double DiscInGradient::slope() const {
  return 2.0 / (1.0 + conductivity_inside / conductivity_outside + resistance * conductivity_inside / radius);
}

double DiscInGradient::dipole() const {
  return radius * radius * (1.0 - slope() * conductivity_inside / conductivity_outside);
}

double DiscInGradient::temperature(double x, double y) const {
  const double squared = x * x + y * y;
  return squared < radius * radius ? slope() * x : x * (1.0 + dipole() / squared);
}

double RingsInContact::heat_per_angle() const {
  return (inner - outer) /
         (std::log(contact_radius / inner_radius) / conductivity_inside + resistance / contact_radius +
          std::log(outer_radius / contact_radius) / conductivity_outside);
}

double RingsInContact::temperature_inside(double radius) const {
  return inner - heat_per_angle() / conductivity_inside * std::log(radius / inner_radius);
}

double RingsInContact::temperature_outside(double radius) const {
  return outer + heat_per_angle() / conductivity_outside * std::log(outer_radius / radius);
}

}  // namespace peritherm
