#pragma once

#include <memory>
#include <vector>

#include "peritherm/two_field/stage_solver.hpp"

namespace peritherm {

/// Solvers for the shifts that were used last, so that what was factored for one serves again.
class StageCache {
 public:
  /// `method`: none: what costs less.
  explicit StageCache(const TwoFieldSystem& system, std::optional<StageMethod> method = std::nullopt)
      : system_(system), method_(method.value_or(choose_stage_method(system))) {}

  /// Of this shift, but for rounding: use the solver's own.
  StageSolver& at(double shift);
  long factorisations() const;
  long iterations() const;

 private:
  const TwoFieldSystem& system_;
  StageMethod method_;
  std::vector<std::unique_ptr<StageSolver>> stages_;  ///< the last used first
  long past_factorisations_ = 0, past_iterations_ = 0;
};

}  // namespace peritherm
