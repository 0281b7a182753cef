#pragma once

#include <memory>
#include <optional>

#include "peritherm/two_field/two_field_system.hpp"

namespace peritherm {

/// Solves the linear system of a stage, heat fluxes eliminated, at one shift σ:
///   (σ ρ c V + Σ Gᵀ V κ k G + s k S) x + Φᵀ λ = heat,   Φ x − A R λ = rows.
class StageSolver {
 public:
  virtual ~StageSolver() = default;
  double shift() const { return shift_; }

  /// R of every row [m² K/W]; before the first solution, and when it has changed.
  virtual void set_resistance(const std::vector<double>& resistance) = 0;
  /// `x` and `multipliers`: a guess at first; rows hold to rounding whatever the tolerance. `tolerance`: of x, root
  /// mean square over heat capacity [K]; direct solvers ignore it. Throws Error if it is out of reach.
  virtual void solve(ConstField heat, ConstField rows, double tolerance, Field x, Field multipliers) = 0;
  virtual long iterations() const = 0;      ///< so far
  virtual long factorisations() const = 0;  ///< so far

 protected:
  explicit StageSolver(double shift) : shift_(shift) {}

 private:
  double shift_;
};

enum class StageMethod { direct, iterative };

/// What costs less for the body.
StageMethod choose_stage_method(const TwoFieldSystem& system);

std::unique_ptr<StageSolver> make_stage_solver(StageMethod method, const TwoFieldSystem& system, double shift);
/// Sparse Cholesky factors of each part, and the rows by their range space [benzi2005, sec. 5].
std::unique_ptr<StageSolver> make_direct_stage(const TwoFieldSystem& system, double shift);
/// Conjugate gradients with a constraint preconditioner [gould2001], [dollar2006].
std::unique_ptr<StageSolver> make_iterative_stage(const TwoFieldSystem& system, double shift);

}  // namespace peritherm
