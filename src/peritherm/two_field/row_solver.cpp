#include "peritherm/two_field/row_solver.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;

/// Of a row's diagonal: a pivot below is rounding, and the row a sum of others.
constexpr double least_independence = 1e-10;
constexpr double diagonal_share = 1e-14;  ///< added, so that a factorisation ends at dependent rows as well
constexpr std::size_t most_named = 5;

RowMatrix to_row_matrix(const SparseMatrix& matrix) {
  const auto size = static_cast<Eigen::Index>(matrix.rows());
  RowMatrix result(size, size);
  result.resizeNonZeros(static_cast<Eigen::Index>(matrix.values.size()));
  std::copy(matrix.begin.begin(), matrix.begin.end(), result.outerIndexPtr());
  std::copy(matrix.column_of.begin(), matrix.column_of.end(), result.innerIndexPtr());
  std::copy(matrix.values.begin(), matrix.values.end(), result.valuePtr());
  return result;
}

std::string place_of(const ContactRow& row) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", row.position[0], row.position[1], row.position[2]);
}

Error dependent_rows(const std::vector<std::size_t>& guilty, std::span<const ContactRow> rows) {
  std::string places;
  for (std::size_t k = 0; k < std::min(guilty.size(), most_named); ++k) {
    places += (k == 0 ? "" : ", ") + place_of(rows[guilty[k]]);
  }
  if (guilty.size() > most_named) places += ", …";
  return Error(fmt::format("{} of the rows of contacts and held temperatures follow from others: those at {}",
                           guilty.size(), places),
               "Let no two contacts or boundaries hold the same place, and give both sides at least as many points as "
               "there are places of contact");
}

}  // namespace

struct RowSolver::Parts {
  Eigen::SimplicialLDLT<RowMatrix, Eigen::Lower, Eigen::AMDOrdering<std::int32_t>> factor;
};

RowSolver::RowSolver(const SparseMatrix& matrix, const std::vector<std::size_t>& chosen,
                     std::span<const ContactRow> rows)
    : parts_(std::make_unique<Parts>()) {
  if (matrix.rows() == 0) return;
  RowMatrix lower = to_row_matrix(matrix);
  const Eigen::VectorXd diagonal = lower.diagonal();
  const Eigen::VectorXd roots = diagonal.cwiseSqrt().cwiseInverse();
  RowMatrix scaled = roots.asDiagonal() * lower * roots.asDiagonal();
  for (Eigen::Index n = 0; n < scaled.rows(); ++n) scaled.coeffRef(n, n) += diagonal_share;
  auto& factor = parts_->factor;
  factor.compute(scaled);
  std::vector<std::size_t> guilty;
  const Eigen::VectorXd pivots = factor.vectorD();
  const auto& order = factor.permutationP().indices();
  for (Eigen::Index n = 0; n < scaled.rows(); ++n) {
    if (!(pivots[order[n]] > least_independence)) guilty.push_back(chosen[static_cast<std::size_t>(n)]);
  }
  if (!guilty.empty()) throw dependent_rows(guilty, rows);
  factor.compute(lower);
}

RowSolver::~RowSolver() = default;
RowSolver::RowSolver(RowSolver&&) noexcept = default;

void RowSolver::solve(Field values) const {
  if (values.empty()) return;
  Eigen::Map<Eigen::VectorXd> map(values.data(), static_cast<Eigen::Index>(values.size()));
  map = parts_->factor.solve(map).eval();
}

}  // namespace peritherm
