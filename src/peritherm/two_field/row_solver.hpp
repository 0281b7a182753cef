#pragma once

#include <memory>
#include <span>
#include <vector>

#include "peritherm/two_field/contact_rows.hpp"

namespace peritherm {

/// Solves with the matrix Φ W Φᵀ + diag of contact rows, by a sparse factorisation that costs about as much as there
/// are rows.
class RowSolver {
 public:
  /// `chosen`: the numbers of the matrix's rows among all. Throws Error if a row follows from others, naming places.
  RowSolver(const SparseMatrix& matrix, const std::vector<std::size_t>& chosen, std::span<const ContactRow> rows);
  ~RowSolver();
  RowSolver(RowSolver&&) noexcept;

  /// values becomes matrix⁻¹ values.
  void solve(Field values) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace peritherm
