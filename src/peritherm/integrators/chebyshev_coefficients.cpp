#include "peritherm/integrators/chebyshev_coefficients.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

/// 2 e^(−z) I_k(z), the coefficients of e^(z (ξ − 1)), by Miller's backward recurrence.
std::vector<double> exponential_coefficients(double z) {
  // Beyond this index they fall faster than exp(−k²/2z) to below 1e-20.
  const auto count = static_cast<std::size_t>(40.0 + 10.0 * std::sqrt(z));
  std::vector<double> bessel(count + 2, 0.0);
  bessel[count] = 1e-280;
  double sum = 0.0;
  for (std::size_t k = count; k > 0; --k) {
    bessel[k - 1] = bessel[k + 1] + 2.0 * static_cast<double>(k) / z * bessel[k];
    sum += 2.0 * bessel[k];
    if (bessel[k - 1] < 1e250) continue;
    for (double& value : bessel) value *= 1e-250;
    sum *= 1e-250;
  }
  sum += bessel[0];
  bessel.resize(count + 1);
  for (double& value : bessel) value *= 2.0 / sum;
  return bessel;
}

}  // namespace

std::vector<std::vector<double>> propagator_coefficients(double rate, double time, int degree) {
  std::vector<double> previous = exponential_coefficients(0.5 * rate * time);
  std::vector<std::vector<double>> all;
  for (int j = 0; j <= degree; ++j) {
    // x g = h up to a constant, with x = rate (ξ − 1)/2: every difference of g is a sum of positive numbers.
    std::vector<double> next(previous.size(), 0.0);
    double difference = 0.0;
    for (std::size_t k = previous.size() - 1; k > 0; --k) {
      difference += 4.0 / rate * previous[k];
      next[k - 1] = next[k] + difference;
    }
    all.push_back(next);
    previous = std::move(next);
  }
  for (std::vector<double>& coefficients : all) {
    while (coefficients.size() > 2 && coefficients.back() < 1e-17 * coefficients.front()) coefficients.pop_back();
  }
  return all;
}

void truncate(std::vector<double>& coefficients, double error) {
  double rest = 0.0;
  std::size_t terms = coefficients.size();
  while (terms > 2 && rest + coefficients[terms - 1] <= error) rest += coefficients[--terms];
  coefficients.resize(terms);
  coefficients.back() += rest;
}

}  // namespace peritherm
