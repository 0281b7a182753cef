#pragma once

#include <memory>
#include <vector>

#include "peritherm/integrators/gs4_parameters.hpp"
#include "peritherm/integrators/step_sequence.hpp"
#include "peritherm/two_field/field_pair.hpp"
#include "peritherm/two_field/load_looks.hpp"
#include "peritherm/two_field/stage_cache.hpp"
#include "peritherm/two_field/two_field_integrator.hpp"

namespace peritherm {

/// GS4-1 for two fields with constraints: what has a rate is balanced within the step, at t(n) + α_f h; constraints,
/// and fluxes without a rate of their own, hold at its end. Second order in temperatures, fluxes, multipliers and
/// corrected rates for every member of the family.
class TwoFieldGs4 final : public TwoFieldIntegrator {
 public:
  /// `method`: none: what costs less.
  TwoFieldGs4(const GeneralisedSingleStep& options, const TwoFieldSystem& system,
              std::optional<StageMethod> method = std::nullopt);

  double march(double from, std::span<const double> times, TwoFieldState& state,
               const TwoFieldFollower& follower) override;
  TwoFieldCount count() const override;

  /// The family's own rates, of first order only unless γ = 1/2; a state holds corrected ones.
  const FieldPair& raw_rate() const { return rate_; }

 private:
  bool march_to(double to, TwoFieldState& state, const TwoFieldFollower& follower);
  void look_ahead(double to, const TwoFieldState& state);
  void begin(double to, TwoFieldState& state);
  void find_start(double to, TwoFieldState& state);
  void meet_constraints(double to, TwoFieldState& state);
  bool is_off(const TwoFieldState& state) const;
  SingleStepStart start() const { return after_jump_ ? SingleStepStart::automatic : options_.start; }
  bool step(TwoFieldState& state);
  bool start_step(TwoFieldState& state);
  void take_start(double half, double error, TwoFieldState& state, const TwoFieldState& trial);
  bool single_step(TwoFieldState& state);
  bool must_repeat(double error);
  void solve(const Gs4Parameters& with, double time, double length, const FieldPair& rate, const TwoFieldState& state);
  void make_right(const Gs4Parameters& with, double time, double length, const FieldPair& rate,
                  const TwoFieldState& state);
  void eliminate_flux(const Gs4Parameters& with, double length, const FieldPair& rate, const TwoFieldState& state);
  void complete_flux(double shift);
  void make_accounts(const Gs4Parameters& with, double time, double length, const FieldPair& rate,
                     const TwoFieldState& state);
  void guess(double length);
  void add_change(TwoFieldState& state) const;
  void include(double time, const TwoFieldState& state);
  void record(double time, double length, const TwoFieldState& state);
  double error_of_step(double length) const;
  double rms(double a, const FieldPair& x, double b, const FieldPair& y, double c, const FieldPair& z) const;
  double allowed() const { return options_.relative_tolerance * span_; }

  GeneralisedSingleStep options_;
  const TwoFieldSystem& system_;
  Gs4Parameters parameters_;
  StepSequence sequence_;
  LoadLooks looks_;
  StageCache stages_;
  FieldPair rate_;                          ///< v(n), for a step of rate_step_
  FieldPair corrected_, corrected_before_;  ///< the rate now, and step_before_ ago
  FieldPair new_rate_, new_corrected_;
  FieldPair change_;                 ///< of a step; the flux's part that temperatures do not bring, at first
  std::vector<double> multipliers_;  ///< at the end of a step
  std::vector<double> heat_, rows_;  ///< of the stage's right side
  std::vector<std::vector<double>> conducted_;
  double capacity_ = 0.0;             ///< Σ ρ c V [J/K]
  std::vector<double> flux_weights_;  ///< √(τ / (k ρ c)) of each part: a flux as a temperature [K m²/W]
  TwoFieldCount count_;
  double reached_ = 0.0, rate_step_ = 0.0, step_before_ = 0.0;  ///< [s]
  double step_error_ = 0.0;                                     ///< estimate for the last step [K]
  double good_step_ = 0.0;                                      ///< whatever the error [s]
  bool started_ = false, starting_ = false, has_history_ = false, knows_rates_ = false;
  bool after_jump_ = false;                           ///< begin anew in the midst of a march
  double lowest_ = 0.0, highest_ = 0.0, span_ = 0.0;  ///< [K]
};

}  // namespace peritherm
