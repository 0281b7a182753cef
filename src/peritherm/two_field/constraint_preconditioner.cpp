#include "peritherm/two_field/constraint_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace peritherm {
namespace {

/// In horizons: smaller bins take fewer iterations, and longer for each.
constexpr double bin_width = 1.3;

std::vector<std::size_t> all_numbers(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

}  // namespace

ConstraintPreconditioner::ConstraintPreconditioner(const StageMatrix& matrix)
    : matrix_(matrix), inverse_(matrix.diagonal()), bins_(make_bins(matrix.system(), bin_width)) {
  for (double& value : inverse_) value = 1.0 / value;
  coarse_ = bin_matrix(matrix, bins_);
  contacts_of_bins_ = bin_contacts(matrix.system(), bins_);
  const ContactMatrix& contacts = matrix.system().contacts();
  rows_matrix_ = contacts.gram(inverse_, all_numbers(contacts.rows()));
}

void ConstraintPreconditioner::set_resistance(const std::vector<double>& resistance) {
  const TwoFieldSystem& system = matrix_.system();
  SparseMatrix rows = rows_matrix_;
  std::vector<double> weights(rows.rows(), 0.0);
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    for (std::int64_t k = rows.begin[r]; k < rows.begin[r + 1]; ++k) {
      if (rows.column_of[k] == static_cast<PointIndex>(r))
        rows.values[k] += system.contacts().areas()[r] * resistance[r];
      weights[r] += std::abs(rows.values[k]);
    }
    weights[r] = 1.0 / weights[r];
  }
  row_solver_.emplace(rows, all_numbers(rows.rows()), system.rows());
  factor_.emplace(add_contacts(coarse_, contacts_of_bins_, weights), 0);
  ++factorisations_;
}

/// z = D⁻¹ (heat − Φᵀ w).
void ConstraintPreconditioner::complete(ConstField heat, ConstField w, Field z) const {
  std::copy(heat.begin(), heat.end(), z.begin());
  matrix_.system().contacts().add_adjoint(-1.0, w, z);
  const auto count = static_cast<std::ptrdiff_t>(z.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) z[n] *= inverse_[n];
}

void ConstraintPreconditioner::solve(ConstField heat, ConstField rows, Field z, Field w) const {
  const ContactMatrix& contacts = matrix_.system().contacts();
  const auto count = static_cast<std::ptrdiff_t>(z.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) z[n] = inverse_[n] * heat[n];
  contacts.product(z, w);
  for (std::size_t r = 0; r < w.size(); ++r) w[r] -= rows[r];
  row_solver_->solve(w);
  Matrix level(bins_.count, 1);
  bins_.sum(heat, level.values);
  for (std::size_t r = 0; r < w.size(); ++r) {
    for (std::int64_t k = contacts_of_bins_.begin[r]; k < contacts_of_bins_.begin[r + 1]; ++k) {
      level.values[contacts_of_bins_.column_of[k]] -= contacts_of_bins_.values[k] * w[r];
    }
  }
  factor_->solve(level);
  std::vector<double> more(w.size(), 0.0);
  for (std::size_t r = 0; r < w.size(); ++r) {
    for (std::int64_t k = contacts_of_bins_.begin[r]; k < contacts_of_bins_.begin[r + 1]; ++k) {
      more[r] += contacts_of_bins_.values[k] * level.values[contacts_of_bins_.column_of[k]];
    }
  }
  row_solver_->solve(more);
  for (std::size_t r = 0; r < w.size(); ++r) w[r] += more[r];
  complete(heat, w, z);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) z[n] += level.values[bins_.bin_of[n]];
}

void ConstraintPreconditioner::mend_rows(ConstField rows, Field z, Field w) const {
  for (std::size_t r = 0; r < w.size(); ++r) w[r] = -rows[r];
  row_solver_->solve(w);
  const std::vector<double> nothing(z.size(), 0.0);
  complete(nothing, w, z);
}

}  // namespace peritherm
