#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm {
namespace {

/// Evaluations grow like the root of time over the fastest decay and the sixth root of accuracy; the factor was
/// measured on a cracked plate. Between two outputs it takes three stages and an estimate at least.
double evaluations_of(const RungeKuttaLegendre& options, double rate, std::span<const double> times, std::size_t) {
  const double smooth =
      10.0 + 11.0 * std::sqrt(rate * times.back()) * std::pow(3e-5 / options.relative_tolerance, 1.0 / 6.0);
  return std::max(smooth, 4.0 * static_cast<double>(times.size()));
}

/// Coefficients fall like exp(−k² / (rate · time)).
double terms_of(const Chebyshev& options, double rate, double length) {
  const double digits = std::log(1.0 / options.relative_tolerance);
  return 3.0 + std::sqrt(rate * length * digits + digits * digits / 4.0);
}

double evaluations_of(const Chebyshev& options, double rate, std::span<const double> times, std::size_t state_size) {
  double sum = 0.0, begin = 0.0;
  while (!times.empty()) {
    const std::size_t count = std::min(times.size(), times_at_once(state_size));
    sum += terms_of(options, rate, times[count - 1] - begin);
    begin = times[count - 1];
    times = times.subspan(count);
  }
  return sum;
}

double evaluations_of(const AutomaticStepping&, double rate, std::span<const double> times, std::size_t state_size) {
  return std::min(evaluations_of(Chebyshev{}, rate, times, state_size),
                  evaluations_of(RungeKuttaLegendre{}, rate, times, state_size));
}

/// As if the body took until the end to settle; who knows its size knows better.
double evaluations_of(const SteadyState& options, double rate, std::span<const double> times, std::size_t) {
  return 10.0 + 0.5 * std::sqrt(rate * times.back()) * std::log(2.0 / options.relative_tolerance);
}

/// Conjugate gradients take about the root of the step's stiffness; factors and powers were measured on a cracked
/// plate.
double evaluations_of(const BackwardDifferences& options, double rate, std::span<const double> times, std::size_t) {
  return 20.0 + 16.0 * std::sqrt(rate * times.back()) * std::pow(1e-5 / options.relative_tolerance, 0.1);
}

double evaluations_of(const ImplicitRungeKutta& options, double rate, std::span<const double> times, std::size_t) {
  return 20.0 + 65.0 * std::sqrt(rate * times.back()) * std::pow(1e-5 / options.relative_tolerance, 0.2);
}

/// Steps follow the course of temperatures; each takes about the root of its stiffness.
double evaluations_of(const GeneralisedSingleStep& options, double rate, std::span<const double> times, std::size_t) {
  const double steps = options.step ? std::ceil(times.back() / *options.step)
                                    : 10.0 + 40.0 * std::pow(1e-5 / options.relative_tolerance, 1.0 / 3.0);
  return 20.0 + steps * (2.0 + 3.0 * std::sqrt(rate * times.back() / steps));
}

double evaluations_of(const DifferentialAlgebraic& options, double rate, std::span<const double> times, std::size_t n) {
  return evaluations_of(BackwardDifferences{{options.relative_tolerance}}, rate, times, n);
}

template <class Options>
requires requires(Options options) { options.safety; }
double evaluations_of(const Options& options, double rate, std::span<const double> times, std::size_t) {
  const double step = options.step.value_or(options.safety * Options::stability / rate);
  double steps = 0.0, begin = 0.0;
  for (const double time : times) {
    steps += std::ceil((time - begin) / step * (1.0 - 1e-12));
    begin = time;
  }
  return steps * Options::stages;
}

/// What smooth pieces of the loads make of the propagator's work; ends early beyond `most`.
double evaluations_by_pieces(const Chebyshev& options, ThermalSystem& system, double from,
                             std::span<const double> times, double most) {
  const double rate = system.fastest_rate();
  constexpr int most_pieces = 32;  // looked at; the rest is taken to be as rough
  const double end = times.back();
  double sum = 0.0, begin = from;
  for (int pieces = 0; !times.empty() && sum <= most;) {
    if (pieces > most_pieces) return sum * (end - from) / (begin - from);
    const double last = times[std::min(times.size(), times_at_once(system.size())) - 1];
    const auto piece = system.fit_loads(begin, last, propagator_load_degree, load_share * options.relative_tolerance);
    if (!piece) return std::numeric_limits<double>::infinity();
    if (piece->end < last) ++pieces;
    sum += terms_of(options, rate, piece->end - piece->begin) * (piece->degree + 1);
    begin = piece->end;
    while (!times.empty() && times.front() <= begin) times = times.subspan(1);
  }
  return sum;
}

constexpr double propagator_rounding = 1e-12;  ///< of rates, beyond which sums that cancel lose the answer

void refuse_rounding(std::string_view method, ThermalSystem& system) {
  if (system.rate_rounding() <= propagator_rounding) return;
  throw Error("time.integrator: " + std::string(method) +
                  " adds up terms that cancel, and needs numerics.precision = \"double\"",
              "Choose \"rkl2\", or double precision");
}

template <class Options>
void refuse_fine_tolerance(const Options& options, ThermalSystem& system) {
  constexpr double finest = 1e-5;  // below it, steps would follow the rounding of single precision
  if (system.rate_rounding() <= propagator_rounding || options.relative_tolerance >= finest) return;
  throw Error("time.integrator.relative_tolerance: single precision resolves no errors below 1e-5",
              "Choose 1e-5 or more, or double precision");
}

void refuse_changes(ThermalSystem& system, double from, double end) {
  if (system.fit_loads(from, end, 0, 1.0)) return;
  throw Error("time.integrator: chebyshev needs a body that does not change in time, and bonds are cut before time.end",
              "Choose \"auto\" or \"rkl2\"");
}

void refuse_one_sided(const TimeStepping& options, const ThermalSystem& system) {
  if (system.is_symmetric() || !needs_symmetry(options)) return;
  const std::string name = std::visit([](const auto& chosen) { return std::string(chosen.name); }, options);
  throw Error(
      "time.integrator: " + name + " needs bonds that conduct the same both ways, and " + std::string(one_sided_reason),
      "Choose \"auto\" or \"rkl2\", or impose all boundaries with \"mirror\"");
}

}  // namespace

bool needs_symmetry(const TimeStepping& options) {
  return std::holds_alternative<Chebyshev>(options) || std::holds_alternative<SteadyState>(options) ||
         std::holds_alternative<BackwardDifferences>(options) || std::holds_alternative<ImplicitRungeKutta>(options) ||
         std::holds_alternative<GeneralisedSingleStep>(options);
}

void refuse_cuts(std::string_view method, ThermalSystem& system, double from, double to) {
  system.begin_step(from, from);
  if (!system.begin_step(from, to)) return;
  throw Error("time.integrator: " + std::string(method) + " cannot follow bonds that are cut or break during the run",
              "Choose the integrator \"rkl2\", which can");
}

std::size_t times_at_once(std::size_t state_size) {
  constexpr std::size_t room = std::size_t{1} << 26;  // bytes; beyond that, keeping results costs more than it saves
  return std::clamp<std::size_t>(room / (8 * state_size + 1), 3, 64);
}

double estimate_evaluations(const TimeStepping& options, double fastest_rate, std::span<const double> times,
                            std::size_t state_size) {
  if (times.empty()) return 0.0;
  return std::visit([&](const auto& chosen) { return evaluations_of(chosen, fastest_rate, times, state_size); },
                    options);
}

ChosenStepping choose_stepping(const TimeStepping& options, ThermalSystem& system, double from,
                               std::span<const double> times) {
  refuse_one_sided(options, system);
  if (std::holds_alternative<SteadyState>(options)) refuse_rounding(SteadyState::name, system);
  std::visit(
      [&](const auto& chosen) {
        if constexpr (requires { chosen.preconditioner; }) {
          refuse_fine_tolerance(chosen, system);
          if (!times.empty()) refuse_cuts(chosen.name, system, from, times.back());
        }
      },
      options);
  if (std::holds_alternative<Chebyshev>(options)) {
    refuse_rounding(Chebyshev::name, system);
    if (!times.empty()) refuse_changes(system, from, times.back());
  }
  const auto* automatic = std::get_if<AutomaticStepping>(&options);
  if (automatic == nullptr) return {options, ""};
  Chebyshev propagator;
  RungeKuttaLegendre stabilised;
  propagator.relative_tolerance = automatic->relative_tolerance.value_or(propagator.relative_tolerance);
  stabilised.relative_tolerance = automatic->relative_tolerance.value_or(stabilised.relative_tolerance);
  if (times.empty()) return {propagator, "nothing to march through"};
  if (!system.is_symmetric()) return {stabilised, std::string(one_sided_reason)};
  if (system.rate_rounding() > propagator_rounding) {
    return {stabilised, "chebyshev would add up what single precision rounds"};
  }
  std::vector<double> lengths(times.begin(), times.end());
  for (double& length : lengths) length -= from;
  const double other = evaluations_of(stabilised, system.fastest_rate(), lengths, system.size());
  const double own = evaluations_by_pieces(propagator, system, from, times, other);
  if (std::isinf(own)) return {stabilised, "bonds are cut while it runs"};
  if (own > other) return {stabilised, "boundary values, sources or many outputs would make chebyshev restart often"};
  return {propagator, "the body does not change in time"};
}

namespace {

/// Chooses anew for each march.
class Automatic final : public TimeIntegrator {
 public:
  Automatic(const AutomaticStepping& options, ThermalSystem& system) : options_(options), system_(system) {}

  double advance(double from, double to, Field temperature, const AfterStep& after_step) override {
    const double times[] = {to};
    return chosen(from, times).advance(from, to, temperature, after_step);
  }

  double march(double from, std::span<const double> times, Field temperature, const MarchFollower& follower) override {
    return chosen(from, times).march(from, times, temperature, follower);
  }

  StepCount count() const override {
    StepCount sum;
    for (const auto& integrator : integrators_) {
      if (!integrator) continue;
      sum.accepted += integrator->count().accepted;
      sum.rejected += integrator->count().rejected;
      sum.evaluations += integrator->count().evaluations;
    }
    return sum;
  }

  double stable_step() const override { return AutomaticStepping::stability / system_.fastest_rate(); }

 private:
  TimeIntegrator& chosen(double from, std::span<const double> times) {
    const TimeStepping stepping = choose_stepping(options_, system_, from, times).stepping;
    auto& integrator = integrators_[std::holds_alternative<Chebyshev>(stepping) ? 0 : 1];
    if (!integrator) integrator = make_integrator(stepping, system_);
    return *integrator;
  }

  AutomaticStepping options_;
  ThermalSystem& system_;
  std::array<std::unique_ptr<TimeIntegrator>, 2> integrators_;
};

}  // namespace

std::unique_ptr<TimeIntegrator> make_integrator(const AutomaticStepping& options, ThermalSystem& system) {
  return std::make_unique<Automatic>(options, system);
}

double TimeIntegrator::march(double from, std::span<const double> times, Field temperature,
                             const MarchFollower& follower) {
  double time = from;
  for (const double next : times) {
    time = advance(time, next, temperature, follower.after_step);
    if (time < next || !follower.at_time(time, temperature)) break;
  }
  return time;
}

}  // namespace peritherm
