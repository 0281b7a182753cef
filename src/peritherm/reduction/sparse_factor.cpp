#include "peritherm/reduction/sparse_factor.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <new>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

using EigenSparse = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;

/// Rows of a symmetric matrix are its columns.
EigenSparse to_eigen(const SparseMatrix& matrix) {
  const auto size = static_cast<Eigen::Index>(matrix.rows());
  EigenSparse result(size, size);
  result.resizeNonZeros(static_cast<Eigen::Index>(matrix.values.size()));
  std::copy(matrix.begin.begin(), matrix.begin.end(), result.outerIndexPtr());
  std::copy(matrix.column_of.begin(), matrix.column_of.end(), result.innerIndexPtr());
  std::copy(matrix.values.begin(), matrix.values.end(), result.valuePtr());
  return result;
}

Error too_large(std::size_t bytes, std::size_t most) {
  return Error(fmt::format("the factor of the condensed points' conductances takes {:.3g} GiB, and {:.3g} GiB are free",
                           static_cast<double>(bytes) / 0x1p30, static_cast<double>(most) / 0x1p30),
               "Retain more points, use a coarser grid, or choose the method rational_krylov, which needs no factor",
               Fault::machine);
}

}  // namespace

struct SparseFactor::Parts {
  /// Tells its size before its entries are made.
  class SizedCholesky : public Eigen::SimplicialLLT<EigenSparse, Eigen::Lower, Eigen::AMDOrdering<std::int32_t>> {
   public:
    std::size_t bytes() const {
      return static_cast<std::size_t>(m_matrix.nonZeros()) * (sizeof(double) + sizeof(std::int32_t));
    }
  };
  SizedCholesky cholesky;
};

SparseFactor::SparseFactor(const SparseMatrix& matrix, std::size_t most_bytes) : parts_(std::make_unique<Parts>()) {
  if (matrix.rows() == 0) return;
  const EigenSparse lower = to_eigen(matrix);
  Parts::SizedCholesky& cholesky = parts_->cholesky;
  try {
    cholesky.analyzePattern(lower);
    if (most_bytes > 0 && cholesky.bytes() > most_bytes) throw too_large(cholesky.bytes(), most_bytes);
    cholesky.factorize(lower);
  } catch (const std::bad_alloc&) {
    throw too_large(cholesky.bytes(), most_bytes);
  }
  if (cholesky.info() != Eigen::Success) {
    throw Error(
        "the conductances of the condensed points are not positive definite: some of them exchange heat with no "
        "other",
        "Retain a point of each piece of the body", Fault::numerics);
  }
}

SparseFactor::~SparseFactor() = default;
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;

void SparseFactor::solve(Matrix& columns) const {
  if (columns.empty()) return;
  Eigen::Map<Eigen::MatrixXd> values(columns.values.data(), static_cast<Eigen::Index>(columns.rows),
                                     static_cast<Eigen::Index>(columns.columns));
  values = parts_->cholesky.solve(values).eval();
}

std::size_t SparseFactor::size() const { return static_cast<std::size_t>(parts_->cholesky.rows()); }
std::size_t SparseFactor::bytes() const { return size() == 0 ? 0 : parts_->cholesky.bytes(); }

}  // namespace peritherm
