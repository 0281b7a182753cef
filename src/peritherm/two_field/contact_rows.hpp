#pragma once

#include <cstdint>
#include <vector>

#include "peritherm/base/sparse_matrix.hpp"
#include "peritherm/two_field/traces.hpp"

namespace peritherm {

/// One algebraic row: A (P₁ T₁ − P₂ T₂ − R λ) = A g with the multiplier λ, the flux from the first to the second or
/// out of the body [W/m²].
struct ContactRow {
  int first = 0;       ///< part
  Trace first_trace;   ///< on its points
  int second = -1;     ///< part; −1: surroundings of temperature g
  Trace second_trace;  ///< empty for surroundings
  double area = 0.0;   ///< A [m²]
  Point position{};    ///< [m]
};

/// Φ, the rows' weights times their areas, on the temperatures of all parts one behind another.
class ContactMatrix {
 public:
  ContactMatrix() = default;
  /// `first_point`: number of each part's first point, and the number of all at the end.
  ContactMatrix(const std::vector<ContactRow>& rows, const std::vector<std::size_t>& first_point);

  std::size_t rows() const { return areas_.size(); }
  ConstField areas() const { return areas_; }
  const SparseMatrix& matrix() const { return matrix_; }

  /// result = Φ T [K m²].
  void product(ConstField temperature, Field result) const;
  /// result += factor · Φᵀ λ [W].
  void add_adjoint(double factor, ConstField multipliers, Field result) const;
  /// Σ |weights| · |T − P T| over both traces of a row: how much temperatures differ there [K].
  double variation(std::size_t row, ConstField temperature) const;
  /// Φ diag(weights) Φᵀ of some rows, in their order.
  SparseMatrix gram(ConstField weights, const std::vector<std::size_t>& chosen) const;

 private:
  SparseMatrix matrix_;
  std::vector<double> areas_;
  std::vector<std::int64_t> second_begin_;  ///< where the weights of the second trace begin
};

}  // namespace peritherm
