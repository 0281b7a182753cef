#pragma once

#include <chrono>
#include <vector>

#include "peritherm/reduction/galerkin.hpp"
#include "peritherm/reduction/response_looks.hpp"
#include "peritherm/reduction/shifted_solver.hpp"

namespace peritherm {

/// What a search for a rational Krylov subspace is to reach.
struct KrylovAim {
  double tolerance = 1e-6;     ///< error (rms) after steps of each input, relative to the temperatures at that time
  std::vector<double> shifts;  ///< to be cycled through [1/s]; none: where the residual is largest
  std::size_t most_unknowns = 200;
};

/// Builds a rational Krylov subspace for the inputs of a system and for its start [druskin2011]: the Galerkin solution
/// at a shift is corrected by conjugate gradients, and the correction joins the basis. What is left at all shifts
/// decides where to correct next, and when to stop.
class KrylovSearch {
 public:
  KrylovSearch(FullSystem& full, const KrylovAim& aim, ReductionCost& cost, const ReductionProgress& progress);

  /// Throws Error if the aim cannot be reached.
  void run();

  const HeatBasis& basis() const { return basis_; }
  const InputStates& inputs() const { return inputs_; }
  /// Error (rms) after steps of each input and from the start, relative to the temperatures at that time, of the
  /// basis without its last `judged_off()` states.
  double error() const { return error_; }
  /// States that the judge goes without: one per input, and one for the start.
  std::size_t judged_off() const { return drives_.size(); }
  const std::vector<double>& shifts_taken() const { return taken_; }

 private:
  struct Candidate {
    std::size_t drive, shift;
    double error;
  };
  void add_drives();
  void add_start();
  void look();
  std::vector<Candidate> choose() const;
  void correct(const Candidate& candidate);
  void continue_chain(double shift);
  bool add_correction(double shift, ConstField rate, std::size_t drive);
  double step_error(std::size_t judged) const;
  double estimate(const Drive& drive, double shift, const Look& look) const;
  double scale(std::size_t drive, std::size_t shift) const;
  void report() const;
  [[noreturn]] void give_up(const std::string& why) const;

  FullSystem& full_;
  KrylovAim aim_;
  ReductionCost& cost_;
  const ReductionProgress& progress_;
  HeatBasis basis_;
  InputStates inputs_;
  ShiftedSolver solver_;
  FieldStorage start_;
  std::vector<Drive> drives_;
  std::vector<double> candidates_;        ///< shifts, ascending [1/s]
  std::vector<std::vector<Look>> looks_;  ///< per drive and candidate
  std::vector<std::vector<double>>
      exhausted_;                    ///< per drive and candidate: size of the basis when nothing was found there
  std::vector<FieldStorage> chain_;  ///< per drive: what the next given shift works on
  std::vector<double> taken_;
  double residual_error_ = 0.0, first_error_ = 0.0;
  double error_ = 0.0;
};

}  // namespace peritherm
