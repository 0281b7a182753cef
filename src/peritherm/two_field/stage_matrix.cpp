#include "peritherm/two_field/stage_matrix.hpp"

#include <algorithm>

namespace peritherm {

StageMatrix::StageMatrix(const TwoFieldSystem& system, double shift) : system_(system), shift_(shift) {
  for (std::size_t p = 0; p < system.parts().size(); ++p) conduction_.push_back(system.stage_conduction(p, shift));
}

void StageMatrix::product(ConstField x, Field result) const {
  const ConstField capacities = system_.capacities();
  const auto count = static_cast<std::ptrdiff_t>(x.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) result[n] = shift_ * capacities[n] * x[n];
  for (std::size_t p = 0; p < conduction_.size(); ++p) {
    const std::size_t first = system_.first_point(p), size = conduction_[p].size();
    conduction_[p].add_product(1.0, x.subspan(first, size), result.subspan(first, size));
  }
}

SparseMatrix StageMatrix::matrix(std::size_t part) const {
  SparseMatrix result = conduction_[part].matrix();
  const ConstField capacities = system_.capacities().subspan(system_.first_point(part));
  for (std::size_t n = 0; n < result.rows(); ++n) {
    const auto first = result.column_of.begin() + result.begin[n],
               last = result.column_of.begin() + result.begin[n + 1];
    const auto place = std::lower_bound(first, last, static_cast<std::int32_t>(n));
    result.values[static_cast<std::size_t>(place - result.column_of.begin())] += shift_ * capacities[n];
  }
  return result;
}

std::vector<double> StageMatrix::diagonal() const {
  std::vector<double> result;
  for (std::size_t p = 0; p < conduction_.size(); ++p) {
    for (std::size_t n = 0; n < conduction_[p].size(); ++n) {
      result.push_back(shift_ * system_.capacities()[result.size()] + conduction_[p].diagonal(n));
    }
  }
  return result;
}

void StageMatrix::subtract(ConstField x, ConstField multipliers, ConstField resistance, Field heat, Field rows) const {
  std::vector<double> image(x.size()), product_of_rows(rows.size());
  product(x, image);
  const auto count = static_cast<std::ptrdiff_t>(x.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) heat[n] -= image[n];
  system_.contacts().add_adjoint(-1.0, multipliers, heat);
  system_.contacts().product(x, product_of_rows);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r] -= product_of_rows[r] - system_.contacts().areas()[r] * resistance[r] * multipliers[r];
  }
}

}  // namespace peritherm
