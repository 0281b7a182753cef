#include "peritherm/system/spectral_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace peritherm {
namespace {

constexpr double expected_shortfall = 0.02;
constexpr double more_steps = 10.0;  // the expectation is one over all starts: this one may be poor
constexpr double margin = 0.03;

/// Numbers between −1 and 1 that look random and are the same everywhere.
double mixed(std::size_t n) {
  auto h = static_cast<std::uint64_t>(n) + 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>(h >> 11) * 0x1.0p-52 - 1.0;
}

/// Largest eigenvalue of a symmetric tridiagonal matrix, by bisection on the signs of its leading minors.
double largest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  double low = 0.0, high = 0.0;
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    const double sides = (k > 0 ? beside[k - 1] : 0.0) + (k + 1 < diagonal.size() ? beside[k] : 0.0);
    high = std::max(high, diagonal[k] + sides);
  }
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    bool above = true;  // of all eigenvalues
    double pivot = 1.0;
    for (std::size_t k = 0; k < diagonal.size() && above; ++k) {
      pivot = middle - diagonal[k] - (k > 0 ? beside[k - 1] * beside[k - 1] / pivot : 0.0);
      above = pivot > 0.0;
    }
    (above ? high : low) = middle;
  }
  return high;
}

void add(double weight, const std::vector<double>& values, std::vector<double>& to) {
  const auto count = static_cast<std::ptrdiff_t>(to.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) to[n] += weight * values[n];
}

void scale(double factor, std::vector<double>& values) {
  const auto count = static_cast<std::ptrdiff_t>(values.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) values[n] *= factor;
}

}  // namespace

double fastest_rate_after(ThermalSystem& system, std::size_t steps) {
  std::vector<double> before(system.size(), 0.0), now(system.size()), next(system.size(), 0.0);
  for (std::size_t n = 0; n < now.size(); ++n) now[n] = mixed(n);
  // One evaluation leaves 0 where nothing is free.
  system.combine_linear(-1, now, 1.0, {}, next);
  std::swap(now, next);
  // Entries outside open faces are never written: what they hold would grow from step to step.
  std::fill(next.begin(), next.end(), 0.0);
  std::vector<double> diagonal, beside;
  double size = std::sqrt(system.heat_product(now, now));
  for (std::size_t k = 0; k < steps && size > 0.0; ++k) {
    scale(1.0 / size, now);
    const Term terms[] = {{k > 0 ? -size : 0.0, before.data()}};
    system.combine_linear(-1, now, -1.0, terms, next);
    diagonal.push_back(system.heat_product(now, next));
    add(-diagonal.back(), now, next);
    size = std::sqrt(system.heat_product(next, next));
    beside.push_back(size);
    std::swap(before, now);
    std::swap(now, next);
    if (size <= 1e-12 * diagonal.front()) break;
  }
  return diagonal.empty() ? 0.0 : largest_eigenvalue(diagonal, beside);
}

double estimate_fastest_rate(ThermalSystem& system, std::size_t free_points) {
  if (free_points == 0) return 0.0;
  const auto points = static_cast<double>(free_points);
  const double wanted = more_steps + std::log(points) * std::sqrt(0.103 / expected_shortfall);
  return fastest_rate_after(system, static_cast<std::size_t>(std::min(wanted, points))) / (1.0 - margin);
}

}  // namespace peritherm
