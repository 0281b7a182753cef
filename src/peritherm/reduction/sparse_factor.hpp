#pragma once

#include <memory>

#include "peritherm/base/matrix.hpp"
#include "peritherm/base/sparse_matrix.hpp"

namespace peritherm {

/// Sparse Cholesky factor of a symmetric positive definite matrix, its rows reordered for little fill [amestoy2004].
class SparseFactor {
 public:
  /// `most_bytes`: that the factor may take; 0: no limit. Throws Error (Fault::machine) if it would take more, and
  /// Error (Fault::numerics) if the matrix is not positive definite.
  SparseFactor(const SparseMatrix& matrix, std::size_t most_bytes);
  ~SparseFactor();
  SparseFactor(SparseFactor&&) noexcept;

  /// Every column becomes matrix⁻¹ column.
  void solve(Matrix& columns) const;
  std::size_t size() const;
  std::size_t bytes() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace peritherm
