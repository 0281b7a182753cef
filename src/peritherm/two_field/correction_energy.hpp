#pragma once

#include <vector>

#include "peritherm/base/sparse_matrix.hpp"
#include "peritherm/two_field/families.hpp"
#include "peritherm/two_field/tensor.hpp"

namespace peritherm {

/// E(μ) = 1/2 Σ_i Σ_j a_ij z_ij² over the points i that may change, z_ij what of μ_j − μ_i is not linear in ξ_ij, and
/// a_ij = V_i² V_j / |ξ_ij|²; lengths in spacings. To μ belongs the change a_ij z_ij / V_i of the gradient, the least
/// one that changes Vᵀ G by E'(μ) and leaves the gradients of linear functions alone.
class CorrectionEnergy {
 public:
  /// `changing`: ascending.
  CorrectionEnergy(int dimension, const SubDomain& part, const Families& families, std::vector<PointIndex> changing);

  std::size_t size() const { return columns_.size(); }
  const std::vector<PointIndex>& columns() const { return columns_; }    ///< the points where μ stands
  const std::vector<PointIndex>& changing() const { return changing_; }  ///< the points that G changes at
  std::size_t bonds() const { return bonds_.size(); }                    ///< of all changing points, one behind another

  /// changes += those of each bond that belong to μ [1/spacing].
  void add_changes(ConstField multipliers, Field changes) const;
  /// result = Vᵀ of changes, at the columns.
  void sum_changes(ConstField changes, Field result) const;
  /// result = E'' μ: what both do one after the other, without the changes in between.
  void apply(ConstField multipliers, Field result) const;
  /// E'', singular: linear μ cost nothing.
  SparseMatrix matrix() const;
  void fill_diagonal(Field diagonal) const;

 private:
  struct Bond {
    PointIndex column;
    double weight;  ///< a
    Point moment;   ///< a ξ
  };
  struct Row {
    std::size_t begin;
    PointIndex column;
    double volume;
    double weight;   ///< Σ a
    Point moment;    ///< −Σ a ξ
    Tensor inverse;  ///< of Σ a ξ ξᵀ
  };
  /// A bond that ends at a column, or the point itself (−1).
  struct End {
    std::size_t row;
    std::ptrdiff_t bond;
  };
  /// Slope of the multipliers around a point.
  Point slope_of(const Row& row, std::size_t end, ConstField multipliers) const;
  std::size_t end_of(std::size_t n) const { return n + 1 < rows_.size() ? rows_[n + 1].begin : bonds_.size(); }
  std::vector<PointIndex> number_columns(std::size_t points, const Families& families);
  std::vector<std::vector<End>> find_ends() const;

  std::vector<PointIndex> changing_, columns_;
  std::vector<Row> rows_;
  std::vector<Bond> bonds_;
};

}  // namespace peritherm
