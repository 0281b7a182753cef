#include <algorithm>
#include <cmath>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/base/field_storage.hpp"
#include "peritherm/integrators/gs4_parameters.hpp"
#include "peritherm/integrators/implicit_heat.hpp"
#include "peritherm/integrators/integrator.hpp"
#include "peritherm/integrators/step_sequence.hpp"

namespace peritherm {
namespace {

/// Of the residual of a step with errors allowed, and of one without, over the span of temperatures.
constexpr double residual_share = 1e-2;
constexpr double residual_of_fixed_steps = 1e-13;
/// A rate that backward Euler changes more in its first half step than this many times as in its second holds decays
/// that are faster than the step.
constexpr double stiff_change = 4.0;
/// Rates at an output that differ from those of the steps by more than errors explain: loads have jumped.
constexpr double jump_over_error = 20.0;
constexpr double first_change = 0.01;  ///< of the span of temperatures, in a first trial step

class Gs4 final : public TimeIntegrator {
 public:
  Gs4(const GeneralisedSingleStep& options, ThermalSystem& system)
      : options_(options),
        system_(system),
        parameters_(gs4_parameters(options)),
        sequence_(options.step),
        solver_(system, options.preconditioner == ImplicitPreconditioner::jacobi),
        rate_(system.size()),
        corrected_(system.size()),
        corrected_before_(system.size()),
        new_rate_(system.size()),
        change_(system.size()),
        right_(system.size()),
        trial_(system.size()) {}

  double advance(double from, double to, Field temperature, const AfterStep& after_step) override {
    refuse_cuts(GeneralisedSingleStep::name, system_, from, to);
    if (!started_ || from != reached_) begin(from, temperature);
    bool go_on = true;
    while (go_on && reached_ < to) {
      const double end = look_ahead(to);
      find_rates(temperature, end);
      while (go_on && !sequence_.at_end()) {
        if (!step(temperature)) continue;
        reached_ = sequence_.time();
        ++count_.accepted;
        go_on = after_step(reached_, temperature);
      }
    }
    return reached_;
  }

  StepCount count() const override {
    StepCount count = count_;
    count.evaluations += solver_.evaluations();
    return count;
  }
  double stable_step() const override { return GeneralisedSingleStep::stability / system_.fastest_rate(); }

 private:
  static Field whole(FieldStorage& storage) { return {storage.data(), storage.size()}; }

  void begin(double from, Field temperature) {
    const auto [lowest, highest] = system_.extremes(temperature);
    lowest_ = lowest;
    highest_ = highest;
    reached_ = from;
    started_ = false;
  }

  /// Steps end where loads jump, so that none is passed over.
  double look_ahead(double to) {
    if (!sequence_.follows_errors()) return to;
    constexpr double rough = 0.02;  // only jumps and kinks matter here: error control follows the rest
    const auto piece = system_.fit_loads(reached_, to, propagator_load_degree, rough);
    return piece ? std::min(to, piece->end) : to;
  }

  /// Takes the rate from the system at the start, and where it is not what the steps lead to.
  void find_rates(Field temperature, double end) {
    if (started_ && (options_.step || steps_lead_to_rates(temperature))) {
      return sequence_.begin(reached_, end, sequence_.wanted());
    }
    evaluate(reached_, temperature, 1.0, {}, corrected_);
    copy(corrected_, rate_);
    const Term terms[] = {{1.0, corrected_.data()}};
    const double size = system_.rms(terms), length = end - reached_;
    promise_ = std::max(promise_, size * std::min(length, 1.0 / system_.fastest_rate()));
    include(temperature);
    rate_step_ = 0.0;
    has_history_ = false;
    starting_ = options_.start != SingleStepStart::consistent || sequence_.follows_errors();
    started_ = true;
    sequence_.begin(reached_, end, size > 0.0 ? std::min(length, first_change * span_ / size) : length);
  }

  bool steps_lead_to_rates(Field temperature) {
    evaluate(reached_, temperature, 1.0, {}, right_);
    const Term difference[] = {{1.0, right_.data()}, {-1.0, corrected_.data()}};
    return system_.rms(difference) * sequence_.wanted() <= jump_over_error * allowed();
  }

  bool step(Field temperature) { return starting_ ? start_step(temperature) : single_step(temperature); }

  /// Two half steps of backward Euler; taken if the rate at the start holds fast decays, else for the rate's slope
  /// only.
  bool start_step(Field temperature) {
    const double half = 0.5 * sequence_.length(), begin = sequence_.time();
    std::copy(temperature.begin(), temperature.end(), trial_.begin());
    solve(backward_euler, begin, half, corrected_, whole(trial_));
    add_change(whole(trial_));
    scale(change_, 1.0 / half, new_rate_);
    copy(new_rate_, corrected_before_);
    solve(backward_euler, begin + half, half, corrected_before_, whole(trial_));
    add_change(whole(trial_));
    scale(change_, 1.0 / half, new_rate_);
    const Term first[] = {{1.0, corrected_before_.data()}, {-1.0, corrected_.data()}};
    const Term second[] = {{1.0, new_rate_.data()}, {-1.0, corrected_before_.data()}};
    const double later = system_.rms(second), error = half * later / allowed();
    if (sequence_.follows_errors() && !(error <= 1.0)) return reject(error);
    starting_ = false;
    const bool rough = system_.rms(first) > stiff_change * later;
    if (options_.start == SingleStepStart::backward_euler || (rough && options_.start == SingleStepStart::automatic)) {
      take_start(temperature, half, error);
      return true;
    }
    rate_step_ = sequence_.length();
    const double lag = parameters_.lag() * rate_step_ / half;
    combine(1.0 - lag, corrected_, lag, corrected_before_, rate_);
    return single_step(temperature);
  }

  void take_start(Field temperature, double half, double error) {
    std::copy(trial_.begin(), trial_.end(), temperature.begin());
    rate_step_ = sequence_.length();
    const double lag = parameters_.lag() * rate_step_ / half;
    combine(1.0 + lag, new_rate_, -lag, corrected_before_, rate_);
    std::swap(corrected_, new_rate_);
    step_before_ = half;
    has_history_ = true;
    include(temperature);
    sequence_.accept(error);
  }

  bool single_step(Field temperature) {
    const double length = sequence_.length();
    // The rate stands for a time before the step by a share of its length.
    if (rate_step_ > 0.0 && rate_step_ != length) {
      const double share = length / rate_step_;
      combine(share, rate_, 1.0 - share, corrected_, rate_);
    }
    rate_step_ = length;
    guess(length);
    solve(parameters_, sequence_.time(), length, rate_, temperature);
    const double gamma = parameters_.gamma, lag = parameters_.lag();
    combine(1.0 / (gamma * length), change_, -(1.0 - gamma) / gamma, rate_, new_rate_);
    combine(1.0 - lag, new_rate_, lag, rate_, right_);
    const double error = sequence_.follows_errors() ? error_of_step(length) / allowed() : 0.0;
    if (!(error <= 1.0)) return reject(error);
    add_change(temperature);
    std::swap(rate_, new_rate_);
    std::swap(corrected_before_, corrected_);
    std::swap(corrected_, right_);
    step_before_ = length;
    has_history_ = true;
    include(temperature);
    sequence_.accept(error);
    return true;
  }

  /// c h³ T''' from the corrected rates of three times, the newest in right_.
  double error_of_step(double length) {
    if (!has_history_) return allowed();
    const double factor = 2.0 * parameters_.error_constant() * length * length * length / (length + step_before_);
    const Term terms[] = {{factor / length, right_.data()},
                          {-factor / length - factor / step_before_, corrected_.data()},
                          {factor / step_before_, corrected_before_.data()}};
    return system_.rms(terms);
  }

  bool reject(double error) {
    ++count_.rejected;
    sequence_.reject(error);
    return false;
  }

  void guess(double length) {
    if (!has_history_) return scale(corrected_, length, change_);
    const double bend = 0.5 * length * length / step_before_;
    combine(length + bend, corrected_, -bend, corrected_before_, change_);
  }

  /// change_ of a step from `temperature`, a guess of it at first.
  void solve(const Gs4Parameters& with, double time, double length, FieldStorage& rate, Field temperature) {
    const double weight = with.gamma * length / with.alpha_m;
    const Term terms[] = {{length * (1.0 - with.gamma / with.alpha_m), rate.data()}};
    evaluate(time + with.alpha_f * length, temperature, weight, terms, right_);
    if (&with == &backward_euler) scale(rate, length, change_);
    const double tolerance = sequence_.follows_errors() ? residual_share * allowed() : residual_of_fixed_steps * span_;
    solver_.solve(with.alpha_f * weight, tolerance, whole(right_), whole(change_));
  }

  void evaluate(double time, Field at, double rate_weight, Terms terms, FieldStorage& result) {
    system_.combine(time, at, rate_weight, terms, whole(result));
    ++count_.evaluations;
  }

  /// Errors count as shares of the span of temperatures so far.
  double allowed() const { return options_.relative_tolerance * span_; }

  void include(ConstField temperature) {
    const auto [lowest, highest] = system_.extremes(temperature);
    lowest_ = std::min(lowest_, lowest);
    highest_ = std::max(highest_, highest);
    const double size = std::max(std::abs(lowest_), std::abs(highest_));
    span_ = std::max({highest_ - lowest_, 1e-9 * size, promise_, 1e-150});
  }

  void add_change(Field temperature) const {
    const ConstField body = solver_.body();
    const auto count = static_cast<std::ptrdiff_t>(system_.field_size());
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t n = 0; n < count; ++n) temperature[n] += body[n] * change_[n];
    for (std::size_t n = system_.field_size(); n < temperature.size(); ++n) temperature[n] += change_[n];
  }

  static void copy(const FieldStorage& from, FieldStorage& to) { std::copy(from.begin(), from.end(), to.begin()); }

  static void scale(const FieldStorage& values, double factor, FieldStorage& result) {
    combine(factor, values, 0.0, values, result);
  }

  static void combine(double a, const FieldStorage& x, double b, const FieldStorage& y, FieldStorage& result) {
    const auto count = static_cast<std::ptrdiff_t>(result.size());
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t n = 0; n < count; ++n) result[n] = a * x[n] + b * y[n];
  }

  GeneralisedSingleStep options_;
  ThermalSystem& system_;
  Gs4Parameters parameters_;
  StepSequence sequence_;
  ImplicitHeat solver_;
  FieldStorage rate_;              ///< v(n), for a step of rate_step_
  FieldStorage corrected_;         ///< the rate now
  FieldStorage corrected_before_;  ///< the rate step_before_ ago
  FieldStorage new_rate_, change_, right_, trial_;
  StepCount count_;
  double reached_ = 0.0, rate_step_ = 0.0, step_before_ = 0.0;  ///< [s]
  bool started_ = false, starting_ = false, has_history_ = false;
  double lowest_ = 0.0, highest_ = 0.0, promise_ = 0.0, span_ = 0.0;  ///< [K]
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const GeneralisedSingleStep& options, ThermalSystem& system) {
  return std::make_unique<Gs4>(options, system);
}

std::unique_ptr<TimeIntegrator> make_integrator(const DifferentialAlgebraic&, ThermalSystem&) {
  throw Error("time.integrator: 'ida' integrates two fields with constraints, and this body has one field",
              "Choose \"cvode\", the same formulas for one field, or nonlocality.model = \"two_field\"");
}

}  // namespace peritherm
