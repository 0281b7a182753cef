#pragma once

#include <vector>

#include "peritherm/two_field/two_field_system.hpp"

namespace peritherm {

/// A = σ ρ c V + Σ Gᵀ V κ k G + s k S of a stage, and what rows leave of a solution.
class StageMatrix {
 public:
  StageMatrix(const TwoFieldSystem& system, double shift);

  const TwoFieldSystem& system() const { return system_; }
  double shift() const { return shift_; }
  std::span<const PatternRows> conduction() const { return conduction_; }

  /// result = A x [W].
  void product(ConstField x, Field result) const;
  /// Of one part, as a matrix.
  SparseMatrix matrix(std::size_t part) const;
  std::vector<double> diagonal() const;

  /// heat −= A x + Φᵀ λ; rows −= Φ x − A R λ.
  void subtract(ConstField x, ConstField multipliers, ConstField resistance, Field heat, Field rows) const;

 private:
  const TwoFieldSystem& system_;
  double shift_;
  std::vector<PatternRows> conduction_;  ///< one per part
};

}  // namespace peritherm
