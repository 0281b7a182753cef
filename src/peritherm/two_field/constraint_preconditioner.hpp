#pragma once

#include <optional>
#include <vector>

#include "peritherm/reduction/sparse_factor.hpp"
#include "peritherm/two_field/coarse_space.hpp"
#include "peritherm/two_field/row_solver.hpp"

namespace peritherm {

/// Solves [M Φᵀ; Φ −A R] (z, w) = (heat, rows) with M⁻¹ = D⁻¹ + Z E⁻¹ Zᵀ: D the diagonal of A, and on bins of about a
/// horizon A itself, so that its iterations do not grow with the number of points. Rows hold to rounding.
///   w = S⁻¹ (Φ D⁻¹ heat − rows + Y y),  S = Φ D⁻¹ Φᵀ + A R,  Y = Φ Z,
///   (E + Yᵀ S⁻¹ Y) y = Zᵀ heat − Yᵀ S⁻¹ (Φ D⁻¹ heat − rows),  z = D⁻¹ (heat − Φᵀ w) + Z y;
/// the matrix for y needs to be near only, and takes the sums of the rows of S in its place.
class ConstraintPreconditioner {
 public:
  explicit ConstraintPreconditioner(const StageMatrix& matrix);

  void set_resistance(const std::vector<double>& resistance);
  void solve(ConstField heat, ConstField rows, Field z, Field w) const;
  /// Without bins: for what rounding leaves of rows.
  void mend_rows(ConstField rows, Field z, Field w) const;
  long factorisations() const { return factorisations_; }

 private:
  void complete(ConstField heat, ConstField w, Field z) const;

  const StageMatrix& matrix_;
  std::vector<double> inverse_;  ///< of D
  Bins bins_;
  SparseMatrix coarse_, contacts_of_bins_, rows_matrix_;
  std::optional<SparseFactor> factor_;
  std::optional<RowSolver> row_solver_;
  long factorisations_ = 0;
};

}  // namespace peritherm
