#include "peritherm/two_field/two_field_gs4.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/two_field/load_jumps.hpp"
#include "peritherm/two_field/range_ahead.hpp"

namespace peritherm {
namespace {

constexpr double residual_share = 1e-2;           ///< of a stage, over the error allowed
constexpr double residual_of_fixed_steps = 1e-3;  ///< over the error of the step before
constexpr double least_residual = 1e-12;          ///< over the span of temperatures
/// A rate that backward Euler changes more in its first half step than this many times as in its second holds decays
/// that are faster than the step.
constexpr double stiff_change = 4.0;
constexpr double error_to_halve = 2.0;   ///< over the error allowed: asks for half the step
constexpr double impulse = 1e-9;         ///< length of a step onto the constraints, over the way to the first time
constexpr double good_share = 1e-6;      ///< of the shortest decay: a step that is good whatever its error
constexpr double least_of_ahead = 1e-3;  ///< a smaller span of temperatures is as good as none
constexpr double first_change = 0.01;    ///< of the span of temperatures, in a first trial step

}  // namespace

TwoFieldGs4::TwoFieldGs4(const GeneralisedSingleStep& options, const TwoFieldSystem& system,
                         std::optional<StageMethod> method)
    : options_(options),
      system_(system),
      parameters_(gs4_parameters(options)),
      sequence_(options.step),
      looks_(system.loads().sample),
      stages_(system, method) {
  const TwoFieldState zeros = system.make_state();
  const FieldPair pair{zeros.temperature, zeros.flux, zeros.account_heats};
  rate_ = corrected_ = corrected_before_ = new_rate_ = new_corrected_ = change_ = pair;
  heat_ = zeros.temperature;
  rows_ = multipliers_ = zeros.multipliers;
  conducted_ = zeros.flux;
  for (const double value : system.capacities()) capacity_ += value;
  for (const PartLaw& law : system.laws()) {
    const double conductivity = trace(law.conductivity) / system.dimension();
    flux_weights_.push_back(std::sqrt(law.relaxation_time / (conductivity * law.volumetric_heat_capacity)));
  }
  count_.shortest_step = std::numeric_limits<double>::infinity();
}

TwoFieldCount TwoFieldGs4::count() const {
  TwoFieldCount count = count_;
  count.factorisations = stages_.factorisations();
  count.iterations = stages_.iterations();
  if (count.steps.accepted == 0) count.shortest_step = 0.0;
  return count;
}

double TwoFieldGs4::march(double from, std::span<const double> times, TwoFieldState& state,
                          const TwoFieldFollower& follower) {
  if (!started_ || from != reached_) {
    started_ = false;
    reached_ = from;
    after_jump_ = false;
    if (sequence_.follows_errors()) good_step_ = good_share * shortest_decay(system_);
    lowest_ = std::numeric_limits<double>::infinity();
    highest_ = -lowest_;
    include(from, state);
    if (sequence_.follows_errors() && !times.empty()) look_ahead(times.back(), state);
  }
  for (const double to : times) {
    const int looks = looks_between(reached_, to, times.back() - from);
    const LoadSearch search = sequence_.follows_errors() ? LoadSearch::jumps_and_ends_of_rest : LoadSearch::jumps;
    for (const LoadJump& jump : find_load_jumps(system_.loads().sample, reached_, to, looks, search)) {
      if (!march_to(jump.before, state, follower)) return reached_;
      reached_ = jump.after;
      started_ = false;
      after_jump_ = true;
    }
    if (!march_to(to, state, follower)) return reached_;
    if (follower.at_time && !follower.at_time(reached_, state)) return reached_;
  }
  return reached_;
}

/// Near one temperature everywhere errors count by what is to come.
void TwoFieldGs4::look_ahead(double to, const TwoFieldState& state) {
  const TemperatureRange ahead = range_ahead(system_, state.temperature, reached_, to);
  if (highest_ - lowest_ >= least_of_ahead * (ahead.highest - ahead.lowest)) return;
  lowest_ = ahead.lowest;
  highest_ = ahead.highest;
}

/// Where loads do not jump; false if the follower ends the march.
bool TwoFieldGs4::march_to(double to, TwoFieldState& state, const TwoFieldFollower& follower) {
  if (!(reached_ < to)) return true;
  begin(to, state);
  while (!sequence_.at_end()) {
    if (!step(state)) continue;
    reached_ = sequence_.time();
    state.temperature_rate = corrected_.temperature;
    state.flux_rate = corrected_.flux;
    state.account_rates = corrected_.accounts;
    if (follower.after_step && !follower.after_step(reached_, state)) return false;
  }
  return true;
}

void TwoFieldGs4::begin(double to, TwoFieldState& state) {
  if (sequence_.follows_errors()) looks_.look(reached_, to);
  if (started_) return sequence_.begin(reached_, to, sequence_.wanted());
  find_start(to, state);
  started_ = true;
  include(reached_, state);
  double first = to - reached_;
  if (knows_rates_) {
    const double size = rms(1.0, corrected_, 0.0, corrected_, 0.0, corrected_);
    const double scale = lowest_ < highest_ ? span_ : size * first;
    if (size > 0.0) first = std::min(first, first_change * scale / size);
  }
  sequence_.begin(reached_, to, first);
}

void TwoFieldGs4::find_start(double to, TwoFieldState& state) {
  if (start() == SingleStepStart::consistent) {
    const auto fault = find_start_fault(system_, reached_, state.temperature);
    if (fault) throw inconsistent_start(system_, *fault);
  }
  const bool off = is_off(state);
  has_history_ = false;
  step_error_ = 0.0;
  rate_step_ = 0.0;
  starting_ = start() != SingleStepStart::consistent || sequence_.follows_errors();
  knows_rates_ = false;
  if (off && !sequence_.follows_errors()) return;
  if (off) meet_constraints(to, state);
  make_consistent(system_, reached_, state);
  corrected_ = {state.temperature_rate, state.flux_rate, state.account_rates};
  if (system_.loads().account_rates) system_.loads().account_rates(reached_, state.multipliers, corrected_.accounts);
  rate_ = corrected_;
  knows_rates_ = true;
}

/// What a user gives may miss the rows by what discretisation explains; in the midst of a march all heat is accounted.
bool TwoFieldGs4::is_off(const TwoFieldState& state) const {
  if (after_jump_) return system_.constraint_residual(reached_, state) > least_residual * span_;
  return find_start_fault(system_, reached_, state.temperature).has_value();
}

/// Start values that jump come to meet what holds them in no time, whatever the step: the error of that is none.
void TwoFieldGs4::meet_constraints(double to, TwoFieldState& state) {
  const double length = impulse * (to - reached_);
  include(reached_, state);
  solve(backward_euler, reached_, length, corrected_, state);
  add_change(state);
  reached_ += length;
  record(reached_, length, state);
}

bool TwoFieldGs4::step(TwoFieldState& state) {
  const bool too_far = sequence_.follows_errors() && sequence_.next() > looks_.reach(sequence_.time());
  if (too_far) sequence_.reject(error_to_halve);
  return !too_far && (starting_ ? start_step(state) : single_step(state));
}

/// Two half steps of backward Euler; taken if start values jump or their rates hold fast decays, else for the slope of
/// the rates only.
bool TwoFieldGs4::start_step(TwoFieldState& state) {
  const double half = 0.5 * sequence_.length(), begin = sequence_.time();
  TwoFieldState trial = state;
  for (int k = 0; k < 2; ++k) {
    if (k > 0) corrected_before_ = new_rate_;
    solve(backward_euler, begin + k * half, half, corrected_, trial);
    combine(1.0 / half, change_, 0.0, change_, new_rate_);
    add_change(trial);
  }
  const double later = rms(1.0, new_rate_, -1.0, corrected_before_, 0.0, new_rate_);
  if (sequence_.follows_errors()) {
    include(begin + 2.0 * half, trial);
    const double error = half * later / allowed();
    if (must_repeat(error)) return false;
  }
  starting_ = false;
  const bool rough =
      !knows_rates_ || rms(1.0, corrected_before_, -1.0, corrected_, 0.0, corrected_) > stiff_change * later;
  if (start() == SingleStepStart::backward_euler || (rough && start() == SingleStepStart::automatic)) {
    take_start(half, sequence_.follows_errors() ? half * later / allowed() : 0.0, state, trial);
    return true;
  }
  rate_step_ = sequence_.length();
  const double lag = parameters_.lag() * rate_step_ / half;
  combine(1.0 - lag, corrected_, lag, corrected_before_, rate_);
  return single_step(state);
}

void TwoFieldGs4::take_start(double half, double error, TwoFieldState& state, const TwoFieldState& trial) {
  state = trial;
  rate_step_ = sequence_.length();
  const double lag = parameters_.lag() * rate_step_ / half;
  combine(1.0 + lag, new_rate_, -lag, corrected_before_, rate_);
  std::swap(corrected_, new_rate_);
  step_before_ = half;
  has_history_ = true;
  record(sequence_.next(), half, state);
  sequence_.accept(error);
}

bool TwoFieldGs4::single_step(TwoFieldState& state) {
  const double length = sequence_.length();
  // The rate stands for a time before the step by a share of its length.
  if (rate_step_ > 0.0 && rate_step_ != length) {
    const double share = length / rate_step_;
    combine(share, rate_, 1.0 - share, corrected_, rate_);
  }
  rate_step_ = length;
  solve(parameters_, sequence_.time(), length, rate_, state);
  const double gamma = parameters_.gamma, lag = parameters_.lag();
  combine(1.0 / (gamma * length), change_, -(1.0 - gamma) / gamma, rate_, new_rate_);
  combine(1.0 - lag, new_rate_, lag, rate_, new_corrected_);
  step_error_ = error_of_step(length);
  const double error = sequence_.follows_errors() ? step_error_ / allowed() : 0.0;
  if (must_repeat(error)) return false;
  add_change(state);
  std::swap(rate_, new_rate_);
  std::swap(corrected_before_, corrected_);
  std::swap(corrected_, new_corrected_);
  step_before_ = length;
  has_history_ = true;
  record(sequence_.next(), length, state);
  sequence_.accept(error);
  return true;
}

/// Loads with a kink, on a body that was at rest, are off by much whatever the step; a very short one has done no harm.
bool TwoFieldGs4::must_repeat(double error) {
  if (error <= 1.0 || (std::isfinite(error) && sequence_.length() <= good_step_)) return false;
  ++count_.steps.rejected;
  sequence_.reject(error);
  return true;
}

void TwoFieldGs4::record(double time, double length, const TwoFieldState& state) {
  include(time, state);
  ++count_.steps.accepted;
  count_.longest_step = std::max(count_.longest_step, length);
  count_.shortest_step = std::min(count_.shortest_step, length);
  count_.largest_residual = std::max(count_.largest_residual, system_.constraint_residual(time, state));
}

/// c h³ T''' from the corrected rates of three times.
double TwoFieldGs4::error_of_step(double length) const {
  if (!has_history_) return sequence_.follows_errors() ? allowed() : 0.0;
  const double factor = 2.0 * parameters_.error_constant() * length * length * length / (length + step_before_);
  return rms(factor / length, new_corrected_, -factor / length - factor / step_before_, corrected_,
             factor / step_before_, corrected_before_);
}

/// Over the heat capacity; a flux counts as the temperature that drives it in a wave.
double TwoFieldGs4::rms(double a, const FieldPair& x, double b, const FieldPair& y, double c,
                        const FieldPair& z) const {
  const ConstField capacities = system_.capacities();
  double sum = 0.0;
  for (std::size_t p = 0; p < flux_weights_.size(); ++p) {
    const std::size_t end = system_.first_point(p + 1);
    for (std::size_t n = system_.first_point(p); n < end; ++n) {
      const double value = a * x.temperature[n] + b * y.temperature[n] + c * z.temperature[n];
      sum += capacities[n] * value * value;
      for (std::size_t axis = 0; flux_weights_[p] > 0.0 && axis < x.flux.size(); ++axis) {
        const double flux = a * x.flux[axis][n] + b * y.flux[axis][n] + c * z.flux[axis][n];
        sum += capacities[n] * flux_weights_[p] * flux_weights_[p] * flux * flux;
      }
    }
  }
  return std::sqrt(sum / capacity_);
}

void TwoFieldGs4::include(double time, const TwoFieldState& state) {
  const auto [low, high] = std::minmax_element(state.temperature.begin(), state.temperature.end());
  lowest_ = std::min(lowest_, *low);
  highest_ = std::max(highest_, *high);
  const std::vector<double> outside = system_.surroundings(time);
  for (std::size_t r = 0; r < outside.size(); ++r) {
    if (system_.rows()[r].second >= 0) continue;
    lowest_ = std::min(lowest_, outside[r] / system_.rows()[r].area);
    highest_ = std::max(highest_, outside[r] / system_.rows()[r].area);
  }
  const double size = std::max(std::abs(lowest_), std::abs(highest_));
  span_ = std::max({highest_ - lowest_, 1e-9 * size, 1e-150});
}

void TwoFieldGs4::add_change(TwoFieldState& state) const {
  combine(1.0, state.temperature, 1.0, change_.temperature, state.temperature);
  for (std::size_t axis = 0; axis < state.flux.size(); ++axis) {
    combine(1.0, state.flux[axis], 1.0, change_.flux[axis], state.flux[axis]);
  }
  combine(1.0, state.account_heats, 1.0, change_.accounts, state.account_heats);
  state.multipliers = multipliers_;
}

/// What passes each boundary by the rule of the temperatures, for the multipliers at the stage.
void TwoFieldGs4::make_accounts(const Gs4Parameters& with, double time, double length, const FieldPair& rate,
                                const TwoFieldState& state) {
  if (!system_.loads().account_rates) return;
  std::vector<double> at_stage(multipliers_);
  combine(1.0 - with.alpha_f, state.multipliers, with.alpha_f, multipliers_, at_stage);
  system_.loads().account_rates(time + with.alpha_f * length, at_stage, change_.accounts);
  const double share = with.gamma / with.alpha_m;
  for (std::size_t k = 0; k < change_.accounts.size(); ++k) {
    change_.accounts[k] = length * (share * change_.accounts[k] + (1.0 - share) * rate.accounts[k]);
  }
}

/// What the step changes if temperatures stay: Δq = Δq₀ − κ k G ΔT with
/// Δq₀ = −(τ c q' + q + k G (T + τ F c T')) / (τ β + α_f), β = α_m / (γ h), c = 1 − α_m / γ.
void TwoFieldGs4::eliminate_flux(const Gs4Parameters& with, double length, const FieldPair& rate,
                                 const TwoFieldState& state) {
  const double beta = with.alpha_m / (with.gamma * length), carried = 1.0 - with.alpha_m / with.gamma;
  std::vector<double> driving(state.temperature);
  for (std::size_t p = 0; p < system_.parts().size(); ++p) {
    const PartLaw& law = system_.laws()[p];
    const double factor = law.relaxation_time * law.fourier_share * carried;
    for (std::size_t n = system_.first_point(p); n < system_.first_point(p + 1); ++n) {
      driving[n] += factor * rate.temperature[n];
    }
  }
  system_.conductive_flux(driving, conducted_);
  for (std::size_t p = 0; p < system_.parts().size(); ++p) {
    const double tau = system_.laws()[p].relaxation_time;
    if (tau == 0.0) continue;
    const double inverse = -1.0 / (tau * beta + with.alpha_f);
    for (std::size_t axis = 0; axis < conducted_.size(); ++axis) {
      for (std::size_t n = system_.first_point(p); n < system_.first_point(p + 1); ++n) {
        change_.flux[axis][n] =
            inverse * (tau * carried * rate.flux[axis][n] + state.flux[axis][n] + conducted_[axis][n]);
      }
    }
  }
}

void TwoFieldGs4::complete_flux(double shift) {
  system_.conductive_flux(change_.temperature, conducted_);
  for (std::size_t p = 0; p < system_.parts().size(); ++p) {
    const PartLaw& law = system_.laws()[p];
    if (law.relaxation_time == 0.0) continue;
    const double decay = law.relaxation_time * shift;
    const double share = (1.0 + decay * law.fourier_share) / (1.0 + decay);
    for (std::size_t axis = 0; axis < conducted_.size(); ++axis) {
      for (std::size_t n = system_.first_point(p); n < system_.first_point(p + 1); ++n) {
        change_.flux[axis][n] -= share * conducted_[axis][n];
      }
    }
  }
}

/// The differential rows at t + α_f h, over α_f, and the constraints at t + h, for ΔT and λ at the end.
void TwoFieldGs4::make_right(const Gs4Parameters& with, double time, double length, const FieldPair& rate,
                             const TwoFieldState& state) {
  const double inverse = 1.0 / with.alpha_f, carried = 1.0 - with.alpha_m / with.gamma;
  const ConstField capacities = system_.capacities();
  const auto count = static_cast<std::ptrdiff_t>(heat_.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) heat_[n] = -inverse * carried * capacities[n] * rate.temperature[n];
  system_.add_heating(time + with.alpha_f * length, inverse, heat_);
  system_.add_conduction(-inverse, state.temperature, heat_);
  system_.contacts().add_adjoint(-inverse * (1.0 - with.alpha_f), state.multipliers, heat_);
  if (system_.has_fluxes()) {
    eliminate_flux(with, length, rate, state);
    system_.add_divergence(inverse, state.flux, heat_);
    system_.add_divergence(1.0, change_.flux, heat_);
  }
  rows_ = system_.surroundings(time + length);
  std::vector<double> product(rows_.size());
  system_.contacts().product(state.temperature, product);
  for (std::size_t r = 0; r < rows_.size(); ++r) rows_[r] -= product[r];
}

void TwoFieldGs4::guess(double length) {
  if (!has_history_) return combine(length, corrected_.temperature, 0.0, corrected_.temperature, change_.temperature);
  const double bend = 0.5 * length * length / step_before_;
  combine(length + bend, corrected_.temperature, -bend, corrected_before_.temperature, change_.temperature);
}

/// change_ and multipliers_ of a step from `state`.
void TwoFieldGs4::solve(const Gs4Parameters& with, double time, double length, const FieldPair& rate,
                        const TwoFieldState& state) {
  StageSolver& solver = stages_.at(with.shift(length));
  if (solver.shift() != with.shift(length)) length = with.shift(1.0) / solver.shift();
  make_right(with, time, length, rate, state);
  if (knows_rates_) guess(length);
  multipliers_ = state.multipliers;
  solver.set_resistance(system_.resistances(time + length));
  const double wanted = sequence_.follows_errors() ? residual_share * allowed() : residual_of_fixed_steps * step_error_;
  solver.solve(heat_, rows_, std::max(wanted, least_residual * span_), change_.temperature, multipliers_);
  ++count_.steps.evaluations;
  if (system_.has_fluxes()) complete_flux(with.shift(length));
  make_accounts(with, time, length, rate, state);
}

}  // namespace peritherm
