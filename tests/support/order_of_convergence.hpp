#pragma once

#include <cassert>
#include <cmath>
#include <vector>

namespace peritherm {

/// Slope of log(error) over log(size) by least squares; sizes are spacings, horizons or steps.
inline double order_of_convergence(const std::vector<double>& sizes, const std::vector<double>& errors) {
  assert(sizes.size() == errors.size() && sizes.size() >= 2);
  double mean_size = 0.0;
  double mean_error = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    mean_size += std::log(sizes[k]) / static_cast<double>(sizes.size());
    mean_error += std::log(errors[k]) / static_cast<double>(sizes.size());
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const double deviation = std::log(sizes[k]) - mean_size;
    covariance += deviation * (std::log(errors[k]) - mean_error);
    variance += deviation * deviation;
  }
  return covariance / variance;
}

}  // namespace peritherm
