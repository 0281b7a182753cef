#include "peritherm/simulation/gap_stepping.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/radiating_gaps.hpp"

namespace peritherm {
namespace {

/// By which the mean temperature of faces may differ half-way, relatively and times its weight, from what it was taken
/// to be.
constexpr double largest_difference = 1e-5;
constexpr double first_share = 1e-3;  ///< of the time to the first output
constexpr double most_growth = 3.0, least_growth = 0.2, caution = 0.8;
/// Of a march; an interval this short that would be done again has a jump of loads in it.
constexpr double least_interval = 1e-9;
constexpr double steady_difference = 1e-9;
/// Of the way to the means that a round ends with. Where heat is prescribed, colder faces are overshot by up to three
/// times their distance.
constexpr double steady_share = 0.4;
constexpr int most_repetitions = 200;

double largest_difference_of(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
  return largest;
}

class GapStepping final : public TimeIntegrator {
 public:
  GapStepping(const TimeStepping& stepping, const Problem& problem, Assembly& assembly)
      : stepping_(stepping), system_(*assembly.system), gaps_(problem, assembly) {}

  double advance(double from, double to, Field temperature, const AfterStep& after_step) override {
    if (std::holds_alternative<SteadyState>(stepping_)) return settle(from, to, temperature, after_step);
    double time = from;
    if (interval_ == 0.0) interval_ = first_share * (to - from);
    while (time < to) {
      // The last two share what is left.
      const double left = to - time, length = left < 1.5 * interval_ ? left : std::min(interval_, 0.5 * left);
      const bool least = length <= least_interval * (to - from);
      time = pass(time, left == length ? to : time + length, least, temperature, after_step);
      if (stopped_) break;
    }
    return time;
  }

  StepCount count() const override {
    StepCount sum = done_;
    if (inner_) add(inner_->count(), sum);
    return sum;
  }

  double stable_step() const override {
    return inner_ ? inner_->stable_step() : make_integrator(stepping_, system_)->stable_step();
  }

 private:
  /// From one time to another or, if the faces go another way than they were taken to, not; returns the time reached.
  /// The `least` interval is passed whatever the faces do.
  double pass(double from, double to, bool least, Field temperature, const AfterStep& after_step) {
    stopped_ = false;
    start_.assign(temperature.begin(), temperature.end());
    const FaceMeans before = look(from, temperature);
    slopes_.resize(before.means.size(), 0.0);
    std::vector<double> halfway(before.means.size());
    for (std::size_t n = 0; n < halfway.size(); ++n) halfway[n] = before.means[n] + 0.5 * (to - from) * slopes_[n];
    set(halfway);
    const double reached = inner_->advance(from, to, temperature, after_step);
    stopped_ = reached < to;
    if (stopped_) return reached;
    const FaceMeans after = look(to, temperature);
    double difference = 0.0;
    for (std::size_t n = 0; n < halfway.size(); ++n) {
      slopes_[n] = (after.means[n] - before.means[n]) / (to - from);
      const double missed = std::abs(0.5 * (before.means[n] + after.means[n]) - halfway[n]);
      difference = std::max(difference, missed * std::max(before.weights[n], after.weights[n]));
    }
    const double growth = caution * std::sqrt(largest_difference / std::max(difference, 1e-300));
    const double next = (to - from) * std::clamp(growth, least_growth, most_growth);
    if (difference <= 2.0 * largest_difference || least) {
      if (least) std::fill(slopes_.begin(), slopes_.end(), 0.0);
      // The end of a march may have cut the interval short.
      interval_ = to - from < interval_ ? std::max(interval_, next) : next;
      return to;
    }
    interval_ = next;
    ++done_.rejected;
    std::copy(start_.begin(), start_.end(), temperature.begin());
    return from;
  }

  double settle(double from, double to, Field temperature, const AfterStep& after_step) {
    std::vector<double> now = look(from, temperature).means;
    for (double& mean : now) mean = std::max(mean, std::log(first_mean_temperature));
    for (int round = 0; round < most_repetitions; ++round) {
      set(now);
      const double reached = inner_->advance(from, to, temperature, after_step);
      if (reached < to) return reached;
      const std::vector<double> next = look(to, temperature).means;
      if (largest_difference_of(now, next) <= steady_difference) return to;
      for (std::size_t n = 0; n < now.size(); ++n) now[n] += steady_share * (next[n] - now[n]);
    }
    throw Error("time.integrator: no steady state was found in " + std::to_string(most_repetitions) +
                    " rounds of radiation between faces",
                "March in time to it instead: integrator = \"auto\" and a late time.end", Fault::numerics);
  }

  FaceMeans look(double time, Field temperature) {
    system_.fill(time, temperature);
    return gaps_.means(temperature);
  }

  void set(const std::vector<double>& means) {
    if (!gaps_.apply(means) && inner_ && !remembers()) return;
    // Methods take the fastest rate at their beginning.
    if (inner_) add(inner_->count(), done_);
    inner_ = make_integrator(stepping_, system_);
  }

  /// Does the method go on from what it knows of earlier rates?
  bool remembers() const {
    return std::holds_alternative<BackwardDifferences>(stepping_) ||
           std::holds_alternative<ImplicitRungeKutta>(stepping_) ||
           std::holds_alternative<GeneralisedSingleStep>(stepping_);
  }

  static void add(const StepCount& count, StepCount& sum) {
    sum.accepted += count.accepted;
    sum.rejected += count.rejected;
    sum.evaluations += count.evaluations;
  }

  TimeStepping stepping_;
  HeatSystem& system_;
  RadiatingGaps gaps_;
  std::unique_ptr<TimeIntegrator> inner_;
  StepCount done_;
  std::vector<double> start_;   ///< state at the beginning of an interval
  std::vector<double> slopes_;  ///< of the faces' means in time, over the last interval
  double interval_ = 0.0;
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_case_integrator(const TimeStepping& stepping, const Problem& problem,
                                                     Assembly& assembly) {
  if (RadiatingGaps::needed(problem)) return std::make_unique<GapStepping>(stepping, problem, assembly);
  return make_integrator(stepping, *assembly.system);
}

}  // namespace peritherm
