#pragma once

#include <vector>

namespace peritherm {

/// Temperatures, fluxes axis by axis, and the heat of each account; or their rates.
struct FieldPair {
  std::vector<double> temperature;
  std::vector<std::vector<double>> flux;
  std::vector<double> accounts;
};

/// result = a x + b y; it may be one of them.
void combine(double a, const std::vector<double>& x, double b, const std::vector<double>& y,
             std::vector<double>& result);
void combine(double a, const FieldPair& x, double b, const FieldPair& y, FieldPair& result);

}  // namespace peritherm
