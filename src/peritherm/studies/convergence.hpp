#pragma once

#include <span>
#include <string>
#include <vector>

namespace peritherm {

/// Errors against what was varied, everything else being equal, and how quickly they fall.
struct ConvergenceSeries {
  std::string axis;      ///< "horizon", "horizon ratio", "spacing", "time step"
  std::string quantity;  ///< the norm, or the probe whose difference it is
  std::string name;      ///< the curve: variant and what else is varied, at its value; empty: there is one only
  double time = 0.0;     ///< [s]
  std::vector<double> parameters;  ///< δ [m], m, Δx [m] or Δt [s]
  std::vector<double> errors;      ///< NaN where a run failed or is the reference itself
  std::vector<double> rates;       ///< between neighbours: one fewer than errors; NaN if one of them is missing
  double rate = 0.0;               ///< least squares over all; NaN with fewer than two errors
};

/// p of error ~ size^p between two errors. Sizes are δ, Δx or Δt; for a ratio m it is 1/m.
double convergence_rate(double size, double error, double next_size, double next_error);

/// The slope of log error over log size by least squares; entries that are not finite and positive are left out; NaN
/// with fewer than two.
double fitted_rate(std::span<const double> sizes, std::span<const double> errors);

}  // namespace peritherm
