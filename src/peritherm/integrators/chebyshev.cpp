#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/base/field_storage.hpp"
#include "peritherm/integrators/chebyshev_coefficients.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm {
namespace {

constexpr std::size_t terms_between_looks = 16;  ///< at the size of the recurrence
/// |T_k| <= 1 where the fastest rate is not underestimated; rounding stays far below the rest.
constexpr double most_growth = 1.01;
constexpr int most_raises = 40;

/// T(t) = T0 + t φ1(tA) (A T0 + b0) + Σ t^(k+1) φ_{k+1}(tA) b_k for dT/dt = A T + Σ b_k t^k / k!, each φ expanded in
/// Chebyshev polynomials of A on [−rate, 0] [talezer1986, druskin1989]: one evaluation per term, and every output time
/// takes its own coefficients of the same recurrence.
class Propagator final : public TimeIntegrator {
 public:
  Propagator(const Chebyshev& options, ThermalSystem& system)
      : tolerance_(options.relative_tolerance), system_(system), rate_(system.fastest_rate()) {}

  StepCount count() const override { return count_; }
  double stable_step() const override { return Chebyshev::stability / rate_; }

  double advance(double from, double to, Field temperature, const AfterStep& after_step) override {
    const double times[] = {to};
    const MarchFollower follower{after_step, [](double, Field) { return true; }, [](double) { return true; }};
    return march(from, times, temperature, follower);
  }

  double march(double from, std::span<const double> times, Field temperature, const MarchFollower& follower) override {
    follower_ = follower;
    double time = from;
    while (!times.empty()) {
      const double last = times[std::min(times.size(), times_at_once(system_.size())) - 1];
      system_.begin_step(time, last);
      const auto piece = system_.fit_loads(time, last, propagator_load_degree, load_share * tolerance_);
      if (!piece) refuse(time, last);
      const double begin = time;
      if (!move(*piece, times, temperature, time)) break;
      while (!times.empty() && times.front() <= time) times = times.subspan(1);
      if (time <= begin) break;
    }
    return time;
  }

 private:
  [[noreturn]] static void refuse(double from, double to) {
    std::ostringstream text;
    text << "time.integrator: chebyshev needs a body that does not change in time, and bonds are cut between t = "
         << from << " s and " << to << " s";
    throw Error(text.str(), "Choose \"auto\" or \"rkl2\"");
  }

  /// One window: sets `time` to where it ends; false if the follower ends the march.
  bool move(const ThermalSystem::LoadPiece& piece, std::span<const double> times, Field temperature, double& time) {
    start(piece, temperature);
    double end = std::min(piece.end, piece.begin + longest_step());
    std::vector<double> targets;
    for (const double t : times.first(std::min(times.size(), times_at_once(system_.size())))) {
      if (t < end) targets.push_back(t);
    }
    targets.push_back(end);
    int raises = 0;
    while (!propagate(piece, targets, temperature)) {
      if (stopped_) return false;
      ++count_.rejected;
      if (++raises > most_raises) diverge(piece.begin);
      rate_ *= 1.1;
      start(piece, temperature);
    }
    ++count_.accepted;
    return deliver(targets, times, temperature, time);
  }

  /// Hands out what the window yields: every target that was asked for, and its end.
  bool deliver(const std::vector<double>& targets, std::span<const double> times, Field temperature, double& time) {
    for (std::size_t n = 0; n < targets.size(); ++n) {
      copy(results_[n], temperature);
      time = targets[n];
      if (!follower_.after_step(time, temperature)) return false;
      const bool asked = std::find(times.begin(), times.end(), time) != times.end();
      if (asked && !follower_.at_time(time, temperature)) return false;
    }
    return true;
  }

  /// first_ = A T0 + b0, and the scale of temperatures that errors are measured by.
  void start(const ThermalSystem::LoadPiece& piece, Field temperature) {
    if (first_.empty()) {
      first_ = FieldStorage(system_.size());
      second_ = FieldStorage(system_.size());
    }
    system_.combine_linear(0, temperature, 1.0, {}, first_);
    ++count_.evaluations;
    const auto [lowest, highest] = system_.extremes(temperature);
    lowest_ = std::min(lowest_, lowest);
    highest_ = std::max(highest_, highest);
    const Term slope[] = {{1.0, first_.data()}};
    slope_ = system_.rms(slope);
    const double magnitude = std::max(std::abs(lowest_), std::abs(highest_));
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * magnitude;
    const double span = highest_ - lowest_;
    // From one temperature everywhere, the change that the first slope promises is the only measure.
    scale_ = span > rounding ? span : std::max(rounding, slope_ * std::min(piece.end - piece.begin, 1.0 / rate_));
    if (scale_ == 0.0) scale_ = 1.0;
  }

  /// Rounding of A T0 comes back times the length of the step; beyond this it would exceed the tolerance.
  double longest_step() const {
    const double noise = 4.0 * std::numeric_limits<double>::epsilon() * slope_;
    return noise > 0.0 ? std::max(0.1 * tolerance_ * scale_ / noise, 1.0 / rate_)
                       : std::numeric_limits<double>::infinity();
  }

  /// results_[n] = T(targets[n]); false if the recurrence grows, or if the follower stops it.
  bool propagate(const ThermalSystem::LoadPiece& piece, const std::vector<double>& targets, Field temperature) {
    results_.resize(std::max(results_.size(), targets.size()));
    for (std::size_t n = 0; n < targets.size(); ++n) {
      if (results_[n].empty()) results_[n] = FieldStorage(temperature.size());
      copy(temperature, results_[n]);
    }
    const double length = targets.back() - piece.begin;
    const double rate = std::max(rate_, 1.0 / length);
    std::vector<std::vector<std::vector<double>>> coefficients;
    for (const double target : targets) {
      const double step = std::max(target - piece.begin, 1e-30 / rate);
      coefficients.push_back(propagator_coefficients(rate, step, piece.degree));
    }
    for (int k = 0; k <= piece.degree; ++k) {
      if (k > 0) load_direction(k);
      const Term direction[] = {{1.0, first_.data()}};
      const double size = system_.rms(direction);
      std::vector<std::vector<double>> own;
      for (std::size_t n = 0; n < targets.size(); ++n) {
        std::vector<double>& all = coefficients[n][static_cast<std::size_t>(k)];
        truncate(all, size > 0.0 ? 0.25 * tolerance_ * scale_ / size : 1.0);
        own.push_back(std::move(all));
      }
      const double share = static_cast<double>(k) / (piece.degree + 1);
      if (!recur(own, rate, {piece.begin + length * share, length / (piece.degree + 1)})) return false;
    }
    return true;
  }

  /// first_ = b_k, the rate that the k-th derivative of the loads alone causes.
  void load_direction(int k) {
    std::fill(second_.begin(), second_.end(), 0.0);
    system_.combine_linear(k, second_, 1.0, {}, first_);
    ++count_.evaluations;
  }

  struct Stretch {
    double begin, length;  ///< [s]
  };

  /// Adds Σ coefficients · T_k(X) v to each result, X = 1 + 2 A / rate and v = first_, which is overwritten.
  bool recur(const std::vector<std::vector<double>>& coefficients, double rate, const Stretch& stretch) {
    std::size_t terms = 2;
    for (const auto& own : coefficients) terms = std::max(terms, own.size());
    const double most = most_growth * most_growth * system_.heat_product(first_, first_);
    Field previous = first_, current = second_;
    const Term start[] = {{1.0, previous.data()}};
    evaluate(previous, 2.0 / rate, start, current, {});
    std::vector<Accumulation> sums;
    for (std::size_t k = 1; k + 1 < terms; ++k) {
      sums.clear();
      // Two terms at a time: half the traffic.
      for (std::size_t n = 0; k % 2 == 1 && n < coefficients.size(); ++n) {
        if (k - 1 >= coefficients[n].size()) continue;
        sums.push_back({results_[n].data(), weight(coefficients[n], k), weight(coefficients[n], k - 1)});
      }
      const Term next[] = {{2.0, current.data()}, {-1.0, previous.data()}};
      evaluate(current, 4.0 / rate, next, previous, sums);
      std::swap(previous, current);
      if (k % terms_between_looks != 0 && k + 2 < terms) continue;
      // A value that is not finite passes no comparison.
      if (!(system_.heat_product(current, current) <= most)) return false;
      stopped_ = !follower_.within_step(stretch.begin + stretch.length * static_cast<double>(k) / terms);
      if (stopped_) return false;
    }
    for (std::size_t n = 0; n < coefficients.size(); ++n) {
      if (terms % 2 == 0) add(weight(coefficients[n], terms - 2), previous, results_[n]);
      add(weight(coefficients[n], terms - 1), current, results_[n]);
    }
    return true;
  }

  static double weight(const std::vector<double>& coefficients, std::size_t k) {
    if (k >= coefficients.size()) return 0.0;
    return k == 0 ? 0.5 * coefficients[0] : coefficients[k];
  }

  static void copy(ConstField from, Field to) {
    const auto size = static_cast<std::ptrdiff_t>(from.size());
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t i = 0; i < size; ++i) to[i] = from[i];
  }

  static void add(double weight, ConstField values, Field result) {
    if (weight == 0.0) return;
    const auto size = static_cast<std::ptrdiff_t>(values.size());
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t i = 0; i < size; ++i) result[i] += weight * values[i];
  }

  void evaluate(Field at, double rate_weight, Terms terms, Field result, Accumulations sums) {
    system_.combine_linear(-1, at, rate_weight, terms, result, sums);
    ++count_.evaluations;
  }

  [[noreturn]] void diverge(double time) const {
    std::ostringstream text;
    text << "chebyshev found no bound of the fastest rate at t = " << time << " s";
    throw Error(text.str(), "Look for temperatures, sources or boundary values that are not finite, or choose \"rkl2\"",
                Fault::numerics);
  }

  double tolerance_;
  ThermalSystem& system_;
  double rate_;
  MarchFollower follower_;
  bool stopped_ = false;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
  double slope_ = 0.0, scale_ = 1.0;
  StepCount count_;
  FieldStorage first_, second_;
  std::vector<FieldStorage> results_;
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const Chebyshev& options, ThermalSystem& system) {
  return std::make_unique<Propagator>(options, system);
}

}  // namespace peritherm
