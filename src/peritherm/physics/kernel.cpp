#include "peritherm/physics/kernel.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace peritherm {

double shape(const Kernel& kernel, double s) {
  const double inside = std::min(s, 1.0);
  return std::visit([&](const auto& form) -> double { return form(inside); }, kernel.form);
}

double moment_of_shape(const Kernel& kernel, int power) {
  // Composite Gauss quadrature: 5 points, exact for degree 9, on 64 panels.
  constexpr std::array<double, 3> nodes{0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  constexpr int panels = 64;
  constexpr double half = 0.5 / panels;
  const auto integrand = [&](double s) { return shape(kernel, s) * std::pow(s, power); };
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = (2 * panel + 1) * half;
    sum += weights[0] * integrand(middle);
    for (int k = 1; k < 3; ++k) {
      sum += weights[k] * (integrand(middle - half * nodes[k]) + integrand(middle + half * nodes[k]));
    }
  }
  return sum * half;
}

double micro_conductivity_amplitude(const Kernel& kernel, double conductivity, double horizon, int dimension) {
  constexpr std::array<double, 4> unit_sphere{0.0, 2.0, 2.0 * std::numbers::pi, 4.0 * std::numbers::pi};
  const int power = dimension + 1 - kernel.exponent;
  const double integral = unit_sphere[dimension] * moment_of_shape(kernel, power) * std::pow(horizon, power + 1);
  return 2.0 * dimension * conductivity / integral;
}

}  // namespace peritherm
