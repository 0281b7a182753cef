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
  std::vector<double> shifts;  ///< to be cycled through [1/s]; none: inverse times at which most is missing
  std::size_t most_unknowns = 200;
  bool must_reach = true;  ///< false: be content with what can be had
};

/// Builds a rational Krylov subspace for the inputs of a system and for its start [druskin2011]. What Galerkin's
/// responses leave of the full equations decides where to solve next, and when to stop: in exact arithmetic all these
/// residuals are multiples of one vector, and the solution for it at any shift extends the subspace.
class KrylovSearch {
 public:
  KrylovSearch(FullSystem& full, const KrylovAim& aim, ReductionCost& cost, const ReductionProgress& progress);

  /// Throws Error if the aim cannot be reached.
  void run();

  const HeatBasis& basis() const { return basis_; }
  const InputStates& inputs() const { return inputs_; }
  /// Error (rms) after steps of each input and from the start, relative to the temperatures at that time, of the
  /// basis without what the judge goes without.
  double error() const { return error_; }
  /// States of the judge: all but the last two of each drive.
  std::size_t judged() const;
  const std::vector<double>& shifts_taken() const { return taken_; }

 private:
  struct Candidate {
    std::size_t drive, time;
    double error;
  };
  void add_drives();
  void add_start();
  void look();
  std::vector<Candidate> rank() const;
  std::vector<Candidate> choose(const std::vector<Candidate>& ranked) const;
  bool correct(const std::vector<Candidate>& candidates);
  bool continue_chains(double shift);
  bool add_solution(double shift, FieldStorage right_side, std::size_t drive);
  double step_error() const;
  double estimate(const Drive& drive, double time, const Look& look) const;
  double scale(std::size_t drive, std::size_t time) const;
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
  std::vector<double> times_;  ///< that are looked at, ascending [s]
  std::vector<Response> responses_;
  std::vector<std::vector<Look>> looks_;             ///< per drive and time
  std::vector<std::vector<std::size_t>> exhausted_;  ///< the same: size of the basis when nothing new came from there
  std::vector<FieldStorage> chains_;                 ///< per drive: what the next given shift works on
  std::vector<double> taken_;
  double residual_error_ = 0.0, first_error_ = 0.0, error_ = 0.0;
};

}  // namespace peritherm
