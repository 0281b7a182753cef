#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/base/field_storage.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm {
namespace {

constexpr int most_stages = 399;
/// Steps this short against the fastest decay are good enough even across a jump of a source or a boundary value.
constexpr double resolved = 0.01;
constexpr long steps_between_looks = 8;  // at the span of temperatures, which changes slowly

/// b_j of the Runge-Kutta-Legendre method [meyer2014, eq. 16].
double legendre_weight(int j) { return j < 2 ? 1.0 / 3.0 : (j * j + j - 2.0) / (2.0 * j * (j + 1.0)); }

/// Longest stable step of s stages times the fastest rate [meyer2014, eq. 17].
double stability(int stages) { return (static_cast<double>(stages) * stages + stages - 2.0) / 2.0; }

int stages_for(double step_times_rate) {
  const int stages = static_cast<int>(std::ceil((std::sqrt(9.0 + 8.0 * step_times_rate) - 1.0) / 2.0));
  return std::max(3, stages + (stages % 2 == 0 ? 1 : 0));
}

/// Runge-Kutta-Legendre method of second order [meyer2014], with the error estimate that its relatives use
/// [sommeijer1998, eq. 2.9]: 0.8 (T − T') + 0.4 h (f + f').
class Legendre final : public TimeIntegrator {
 public:
  Legendre(const RungeKuttaLegendre& options, ThermalSystem& system)
      : tolerance_(options.relative_tolerance),
        system_(system),
        rate_(system.fastest_rate()),
        step_(4.0 / rate_),
        start_(system.size()),
        previous_(system.size()),
        latest_(system.size()),
        slope_(system.size()) {}

  StepCount count() const override { return count_; }
  double stable_step() const override { return RungeKuttaLegendre::stability / rate_; }

  double advance(double from, double to, Field temperature, const AfterStep& after_step) override {
    double time = from;
    bool slope_known = false;
    bool go_on = true;
    std::copy(temperature.begin(), temperature.end(), start_.begin());
    include(start_);
    while (go_on && time < to) {
      const double wanted = std::min(step_, stability(most_stages) / rate_);
      double step = std::min(wanted, to - time);
      // Two even steps instead of a long and a tiny one.
      if (to - time > step && to - time < 2.0 * step) step = 0.5 * (to - time);
      const bool last = step >= to - time;
      const double next = last ? to : time + step;
      if (system_.begin_step(time, next) || !slope_known) evaluate(time, start_, 1.0, {}, slope_);
      const double error = try_step(time, step, to - time);
      slope_known = true;
      const double factor = 0.8 / std::cbrt(std::max(error, 1e-9));
      if (error <= 1.0 || (std::isfinite(error) && step * rate_ < resolved)) {
        std::swap(start_, latest_);
        std::swap(slope_, previous_);
        time = next;
        ++count_.accepted;
        if (count_.accepted % steps_between_looks == 0) include(start_);
        const double longer = step * std::clamp(factor, error > 1.0 ? 1.0 : 0.3, 3.0);
        step_ = step < wanted ? std::max(longer, factor < 1.0 ? 0.0 : step_) : longer;
        go_on = after_step(time, start_);
      } else {
        reject(time, step, factor, error);
      }
    }
    std::copy(start_.begin(), start_.end(), temperature.begin());
    return time;
  }

 private:
  void evaluate(double time, Field at, double rate_weight, Terms terms, Field result) {
    system_.combine(time, at, rate_weight, terms, result);
    ++count_.evaluations;
  }

  /// Widens the span of temperatures that errors are measured by.
  void include(ConstField temperature) {
    const auto [lowest, highest] = system_.extremes(temperature);
    lowest_ = std::min(lowest_, lowest);
    highest_ = std::max(highest_, highest);
  }

  /// latest_ = start_ + length · slope_, the first stage.
  void start_stages(double length) {
    const auto count = static_cast<std::ptrdiff_t>(start_.size());
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t n = 0; n < count; ++n) latest_[n] = start_[n] + length * slope_[n];
  }

  /// Leaves the new temperature in latest_ and its slope in previous_; returns the error over the tolerance.
  double try_step(double time, double step, double rest) {
    const int stages = stages_for(step * rate_);
    const double w = 4.0 / (static_cast<double>(stages) * stages + stages - 2.0);
    const double first_share = legendre_weight(1) * w;
    start_stages(first_share * step);
    double previous_share = 0.0, latest_share = first_share;
    for (int j = 2; j <= stages; ++j) {
      const double b = legendre_weight(j);
      const double mu = (2.0 * j - 1.0) / j * b / legendre_weight(j - 1);
      const double nu = -(j - 1.0) / j * b / legendre_weight(j - 2);
      const double mu_rate = mu * w;
      const double gamma = -(1.0 - legendre_weight(j - 1)) * mu_rate;
      const Term terms[] = {{mu, latest_.data()},
                            {nu, j == 2 ? start_.data() : previous_.data()},
                            {1.0 - mu - nu, start_.data()},
                            {gamma * step, slope_.data()}};
      evaluate(time + latest_share * step, latest_, mu_rate * step, terms, previous_);
      std::swap(previous_, latest_);
      previous_share = std::exchange(latest_share, mu * latest_share + nu * previous_share + mu_rate + gamma);
    }
    evaluate(time + step, latest_, 1.0, {}, previous_);
    const Term error[] = {
        {0.8, start_.data()}, {-0.8, latest_.data()}, {0.4 * step, slope_.data()}, {0.4 * step, previous_.data()}};
    // From one temperature everywhere, the change that the rest of the way promises is the only measure.
    const Term promise[] = {{rest, previous_.data()}};
    const double span = highest_ - lowest_;
    const double rounding =
        8.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(lowest_), std::abs(highest_));
    const double scale = span > rounding ? span : system_.rms(promise);
    const double size = system_.rms(error);
    // Where all temperatures are alike, rounding is all there is, and no shorter step would lower it.
    return size <= rounding * (1.0 + step * rate_) ? 0.0 : size / (tolerance_ * scale);
  }

  void reject(double time, double step, double factor, double error) {
    ++count_.rejected;
    step_ = step * (std::isfinite(error) ? std::clamp(factor, 0.1, 0.9) : 0.1);
    if (step_ > 1e-14 * (std::abs(time) + 1.0 / rate_)) return;
    std::ostringstream text;
    text << "the step of rkl2 became too short at t = " << time << " s";
    throw Error(text.str(), "Look for expressions that jump or are not finite near that time", Fault::numerics);
  }

  double tolerance_;
  ThermalSystem& system_;
  double rate_;
  double step_;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
  StepCount count_;
  FieldStorage start_, previous_, latest_, slope_;
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const RungeKuttaLegendre& options, ThermalSystem& system) {
  return std::make_unique<Legendre>(options, system);
}

}  // namespace peritherm
