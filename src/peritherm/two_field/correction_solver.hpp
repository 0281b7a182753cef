#pragma once

#include <memory>

#include "peritherm/two_field/correction_energy.hpp"

namespace peritherm {

/// Solves E'(μ) = right to some digits, for right sides without a linear part: by one factor for all of them, or by
/// conjugate gradients in solids, where factors fill and iterations are few.
class CorrectionSolver {
 public:
  CorrectionSolver(const CorrectionEnergy& energy, int dimension);
  ~CorrectionSolver();
  void solve(ConstField right, Field multipliers) const;

 private:
  struct Factor;
  void iterate(ConstField right, Field multipliers) const;

  const CorrectionEnergy& energy_;
  std::unique_ptr<Factor> factor_;
  std::vector<double> diagonal_;
};

}  // namespace peritherm
