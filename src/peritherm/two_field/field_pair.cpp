#include "peritherm/two_field/field_pair.hpp"

#include <cstddef>

namespace peritherm {

void combine(double a, const std::vector<double>& x, double b, const std::vector<double>& y,
             std::vector<double>& result) {
  const auto count = static_cast<std::ptrdiff_t>(result.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) result[n] = a * x[n] + b * y[n];
}

void combine(double a, const FieldPair& x, double b, const FieldPair& y, FieldPair& result) {
  combine(a, x.temperature, b, y.temperature, result.temperature);
  for (std::size_t axis = 0; axis < x.flux.size(); ++axis) combine(a, x.flux[axis], b, y.flux[axis], result.flux[axis]);
  for (std::size_t k = 0; k < x.accounts.size(); ++k) result.accounts[k] = a * x.accounts[k] + b * y.accounts[k];
}

}  // namespace peritherm
