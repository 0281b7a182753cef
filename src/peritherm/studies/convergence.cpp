#include "peritherm/studies/convergence.hpp"

#include <cmath>
#include <limits>

namespace peritherm {
namespace {

bool is_usable(double error) { return std::isfinite(error) && error > 0.0; }

}  // namespace

double convergence_rate(double size, double error, double next_size, double next_error) {
  if (!is_usable(error) || !is_usable(next_error)) return std::numeric_limits<double>::quiet_NaN();
  return std::log(next_error / error) / std::log(next_size / size);
}

double fitted_rate(std::span<const double> sizes, std::span<const double> errors) {
  double count = 0.0, mean_x = 0.0, mean_y = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!is_usable(errors[i])) continue;
    count += 1.0;
    mean_x += std::log(sizes[i]);
    mean_y += std::log(errors[i]);
  }
  if (count < 2.0) return std::numeric_limits<double>::quiet_NaN();
  mean_x /= count;
  mean_y /= count;
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!is_usable(errors[i])) continue;
    const double x = std::log(sizes[i]) - mean_x;
    xx += x * x;
    xy += x * (std::log(errors[i]) - mean_y);
  }
  return xy / xx;
}

}  // namespace peritherm
