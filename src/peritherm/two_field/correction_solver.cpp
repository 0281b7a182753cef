#include "peritherm/two_field/correction_solver.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace peritherm {
namespace {

using LowerTriangle = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;

/// Of the largest diagonal entry, so that linear multipliers, which cost nothing, have a factor, too.
constexpr double relative_shift = 1e-12;
/// The caller repeats what is left.
constexpr double iteration_accuracy = 1e-5;
constexpr double rounding_floor = 2e-15;
/// Residuals of conjugate gradients go up and down, but not by so much.
constexpr double led_astray = 1e4;
constexpr int most_iterations = 1000;

LowerTriangle shifted_lower(const SparseMatrix& matrix) {
  const auto size = static_cast<Eigen::Index>(matrix.rows());
  LowerTriangle result(size, size);
  std::vector<Eigen::Index> counts(matrix.rows(), 0);
  double largest = 0.0;
  for (std::size_t j = 0; j < matrix.rows(); ++j) {
    for (std::int64_t n = matrix.begin[j]; n < matrix.begin[j + 1]; ++n) {
      const auto row = static_cast<std::size_t>(matrix.column_of[n]);
      counts[j] += row >= j;
      if (row == j) largest = std::max(largest, matrix.values[n]);
    }
  }
  result.reserve(counts);
  for (std::size_t j = 0; j < matrix.rows(); ++j) {
    for (std::int64_t n = matrix.begin[j]; n < matrix.begin[j + 1]; ++n) {
      const auto row = static_cast<std::size_t>(matrix.column_of[n]);
      if (row < j) continue;
      const double shift = row == j ? relative_shift * largest : 0.0;
      result.insert(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(j)) = matrix.values[n] + shift;
    }
  }
  result.makeCompressed();
  return result;
}

double largest_entry(ConstField values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

double inner_product(ConstField a, ConstField b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

struct CorrectionSolver::Factor {
  Eigen::SimplicialLDLT<LowerTriangle, Eigen::Lower> cholesky;
};

CorrectionSolver::CorrectionSolver(const CorrectionEnergy& energy, int dimension) : energy_(energy) {
  if (dimension == 3) {
    diagonal_.resize(energy.size());
    energy.fill_diagonal(diagonal_);
  } else {
    factor_ = std::make_unique<Factor>();
    factor_->cholesky.compute(shifted_lower(energy.matrix()));
  }
}

CorrectionSolver::~CorrectionSolver() = default;

void CorrectionSolver::solve(ConstField right, Field multipliers) const {
  if (factor_ == nullptr) {
    iterate(right, multipliers);
    return;
  }
  const auto size = static_cast<Eigen::Index>(right.size());
  Eigen::Map<Eigen::VectorXd>(multipliers.data(), size) =
      factor_->cholesky.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), size));
}

void CorrectionSolver::iterate(ConstField right, Field multipliers) const {
  const std::size_t size = right.size();
  std::vector<double> rest(right.begin(), right.end()), scaled(size), direction(size), product(size);
  std::fill(multipliers.begin(), multipliers.end(), 0.0);
  // Below rounding the linear part of the residual, which no multiplier reaches, would lead astray.
  const double target = std::max(iteration_accuracy * largest_entry(right), rounding_floor);
  std::vector<double> reached(size, 0.0);
  double before = 0.0, least = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const double left = largest_entry(rest);
    if (left < least) {
      least = left;
      std::copy(reached.begin(), reached.end(), multipliers.begin());
    }
    if (!(left > target) || left > led_astray * least) break;
    for (std::size_t j = 0; j < size; ++j) scaled[j] = rest[j] / diagonal_[j];
    const double now = inner_product(rest, scaled);
    const double share = before > 0.0 ? now / before : 0.0;
    before = now;
    for (std::size_t j = 0; j < size; ++j) direction[j] = scaled[j] + share * direction[j];
    energy_.apply(direction, product);
    const double step = now / inner_product(direction, product);
    for (std::size_t j = 0; j < size; ++j) {
      reached[j] += step * direction[j];
      rest[j] -= step * product[j];
    }
  }
}

}  // namespace peritherm
