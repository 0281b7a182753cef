#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/conjugate_gradients.hpp"
#include "peritherm/integrators/heat_paths.hpp"
#include "peritherm/integrators/integrator.hpp"
#include "peritherm/integrators/loss_rates.hpp"

namespace peritherm {
namespace {

/// Below this contrast of loss rates, preconditioning by their estimates gains less than it costs.
constexpr double least_contrast = 3.0;
/// Rounding of the heat that enters a part, over the heats that it is the sum of.
constexpr double balance_rounding = 1e-11;
/// Rounding of a rate, over the rates of its largest terms: half the root of some hundred bonds, in units of the last
/// digit.
constexpr double sum_rounding = 8.0 * std::numeric_limits<double>::epsilon();
/// Rates this small against the fastest decay of all temperatures are rounding.
constexpr double rest_rounding = 1e-12;
/// An error that rounding keeps above this share of the span of temperatures is no answer; where there is hardly a
/// span, rounding is judged by the temperatures themselves.
constexpr double worst_share = 1e-3;
constexpr double rounding_share = 1e-6;

std::string digits(double value, const char* unit) {
  std::ostringstream text;
  text.precision(4);
  text << value << ' ' << unit;
  return text.str();
}

/// The temperature at which the rate vanishes. A step is an iteration.
class Steady final : public TimeIntegrator {
 public:
  Steady(const SteadyState& options, ThermalSystem& system)
      : options_(options), system_(system), residual_(system.size(), 0.0) {}

  StepCount count() const override { return count_; }
  double stable_step() const override { return RungeKuttaLegendre::stability / system_.fastest_rate(); }

  double advance(double from, double to, Field temperature, const AfterStep& after_step) override {
    system_.begin_step(to, to);
    parts_ = {};
    next_part_ = first_part;
    start_ = system_.extremes(temperature);
    evaluate(to, temperature);
    ConjugateGradients search(system_, prepare(temperature));
    const auto goal = [this](ConstField now) { return this->goal(now); };
    const auto after_iteration = [&](ConstField now) {
      ++count_.accepted;
      ++count_.evaluations;
      return after_step(from, now);
    };
    double before = std::numeric_limits<double>::infinity();
    using End = ConjugateGradients::End;
    while (!is_rounding(temperature)) {
      const End end = search.improve(temperature, residual_, options_.most_iterations, goal, after_iteration);
      // What the recurrence of residuals has lost to rounding comes back; a few more iterations mend it.
      evaluate(to, temperature);
      const double error = search.error(residual_);
      if (end == End::stopped) return from;
      if (end == End::out_of_iterations) give_up(error);
      if (error <= this->goal(temperature)) break;
      if (!(error <= 0.5 * before)) {
        accept_rounding(error, temperature);
        break;
      }
      before = error;
    }
    // Heat has passed the boundaries for an unknown time; only its rates are known.
    for (std::size_t n = system_.field_size(); n < temperature.size(); ++n) {
      temperature[n] = std::numeric_limits<double>::quiet_NaN();
    }
    after_step(to, temperature);
    return to;
  }

 private:
  static constexpr double at_rest = 0.0, open = 1.0, first_part = 2.0;  ///< marks of points

  void evaluate(double time, Field temperature) {
    system_.combine(time, temperature, 1.0, {}, residual_);
    ++count_.evaluations;
    project();
  }

  double span(ConstField temperature) const {
    const auto [lowest, highest] = system_.extremes(temperature);
    return std::max(highest, start_.highest) - std::min(lowest, start_.lowest);
  }

  double goal(ConstField temperature) const {
    const auto [lowest, highest] = system_.extremes(temperature);
    const double rounding = std::numeric_limits<double>::epsilon() * std::max(std::abs(lowest), std::abs(highest));
    return options_.relative_tolerance * span(temperature) + rounding;
  }

  /// Is the rate no larger than the rounding of the sums that it is?
  bool is_rounding(ConstField temperature) const {
    const auto [lowest, highest] = system_.extremes(temperature);
    const Term residual[] = {{1.0, residual_.data()}};
    return system_.rms(residual) <=
           sum_rounding * system_.fastest_rate() * std::max(std::abs(lowest), std::abs(highest));
  }

  /// Finds out what holds the level of temperature where; returns what to precondition with.
  std::vector<double> prepare(Field temperature) {
    std::vector<double> loss_rates(system_.size()), first(system_.size()), second(system_.size());
    parts_.assign(system_.size(), 0.0);
    HeatPaths paths(system_);
    paths.mark_open(parts_, first);
    for (std::size_t n = 0; n < first.size(); ++n) first[n] = parts_[n] == open ? 0.0 : 1.0;
    const bool closed = system_.heat_product(first, first) > 0.0;
    if (closed) find_parts(temperature, paths, first, second);
    count_.evaluations += paths.evaluations() + loss_rate_probes;
    estimate_loss_rates(system_, loss_rates, first, second);
    even_out(loss_rates, first, second);
    if (!closed) parts_ = {};
    project();
    return loss_rates;
  }

  /// Marks the parts that nothing holds and that are not at rest, one by one.
  void find_parts(Field temperature, HeatPaths& paths, Field marks, Field scratch) {
    const auto [lowest, highest] = start_;
    const double least = rest_rounding * system_.fastest_rate() * std::max(std::abs(lowest), std::abs(highest));
    for (std::size_t n = 0; n < system_.field_size(); ++n) {
      if (parts_[n] != at_rest || !(std::abs(residual_[n]) > least)) continue;
      std::fill(marks.begin(), marks.end(), 0.0);
      marks[n] = 1.0;
      paths.spread(marks, scratch);
      check_balance(temperature, marks, scratch);
      for (std::size_t k = 0; k < system_.field_size(); ++k) {
        if (marks[k] == 1.0 && parts_[k] == at_rest) parts_[k] = next_part_;
      }
      next_part_ += 1.0;
    }
  }

  /// Heat that enters a closed part must leave it again.
  void check_balance(Field temperature, ConstField marks, Field scratch) {
    const double net = system_.heat_product(marks, residual_);
    system_.combine_linear(-1, temperature, 1.0, {}, scratch);
    ++count_.evaluations;
    for (std::size_t n = 0; n < scratch.size(); ++n) scratch[n] = std::abs(scratch[n]) + std::abs(residual_[n]);
    const double gross = system_.heat_product(marks, scratch);
    if (std::abs(net) <= balance_rounding * gross) return;
    throw Error("there is no steady state: a part of the body that nothing holds at a temperature " +
                    std::string(net > 0.0 ? "gains " : "loses ") + digits(std::abs(net), "W"),
                "Hold a temperature there, let it exchange heat with surroundings, or let what is put in sum to zero");
  }

  /// Loss rates that hardly differ gain nothing; where nothing holds the level, they must not shift it.
  void even_out(Field loss_rates, Field ones, Field closed) {
    double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
    for (std::size_t n = 0; n < system_.field_size(); ++n) {
      if (loss_rates[n] > 0.0) lowest = std::min(lowest, loss_rates[n]);
      highest = std::max(highest, loss_rates[n]);
      ones[n] = 1.0;
      closed[n] = parts_[n] == open ? 0.0 : 1.0;
    }
    const double closed_capacity = system_.heat_product(ones, closed);
    const double mean = closed_capacity > 0.0 ? system_.heat_product(loss_rates, closed) / closed_capacity : 0.0;
    for (std::size_t n = 0; n < system_.field_size(); ++n) {
      if (closed[n] == 1.0) loss_rates[n] = mean;
      if (highest <= least_contrast * lowest) loss_rates[n] = highest;
    }
  }

  /// Takes the rounding of its mean out of the residual of each closed part, for nothing could remove it.
  void project() {
    if (parts_.empty()) return;
    std::vector<double> marks(system_.size(), 0.0);
    for (double part = first_part; part < next_part_; part += 1.0) {
      for (std::size_t n = 0; n < system_.field_size(); ++n) marks[n] = parts_[n] == part ? 1.0 : 0.0;
      const double mean = system_.heat_product(marks, residual_) / system_.heat_product(marks, marks);
      for (std::size_t n = 0; n < system_.field_size(); ++n) residual_[n] -= marks[n] * mean;
    }
    for (std::size_t n = 0; n < system_.field_size(); ++n) {
      if (parts_[n] == at_rest) residual_[n] = 0.0;
    }
  }

  [[noreturn]] void give_up(double error) const {
    throw Error("the steady state was not reached in " + std::to_string(options_.most_iterations) +
                    " iterations; temperatures may be off by about " + digits(error, "K"),
                "Raise time.integrator.most_iterations or relative_tolerance, or march there with \"rkl2\"",
                Fault::numerics);
  }

  void accept_rounding(double error, ConstField temperature) const {
    const auto [lowest, highest] = system_.extremes(temperature);
    const double scale = span(temperature) + rounding_share * std::max(std::abs(lowest), std::abs(highest));
    if (error <= worst_share * scale || !std::isfinite(error)) return;
    throw Error("rounding keeps the steady state off by about " + digits(error, "K"),
                "Parts of the body are joined by next to nothing. Separate them, or march with \"rkl2\"",
                Fault::numerics);
  }

  SteadyState options_;
  ThermalSystem& system_;
  StepCount count_;
  ThermalSystem::Extremes start_{0.0, 0.0};
  std::vector<double> residual_;
  std::vector<double> parts_;  ///< mark of each point; empty if none is closed
  double next_part_ = first_part;
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const SteadyState& options, ThermalSystem& system) {
  return std::make_unique<Steady>(options, system);
}

}  // namespace peritherm
