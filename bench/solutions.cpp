#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "bodies.hpp"
#include "peritherm/base/error.hpp"
#include "sections.hpp"

namespace peritherm::bench {
namespace {

constexpr double output_times[] = {0.01, 0.03, 0.1};
constexpr double wanted_errors[] = {1e-4, 1e-6, 1e-9};

/// Temperatures at the output times, evaluations and processor time of the march alone.
struct Answer {
  std::vector<std::vector<double>> temperatures;
  double evaluations = 0.0;
  double seconds = 0.0;
};

/// One run of an integrator, and what it came to.
struct Trial {
  std::string setting;
  double evaluations, seconds, error;
};
using Trials = std::vector<Trial>;

BodyKind cracked_plate(const Settings& settings) { return {2, settings.quick ? 128 : 512, 6.5, true}; }

Answer march(const BodyKind& kind, const TimeStepping& stepping) {
  const Problem problem = make_problem(kind);
  const Assembly assembly = assemble(problem);
  FieldStorage state = initial_state(problem, assembly);
  Answer answer;
  const double start = seconds(Clock::thread);
  const auto integrator = make_integrator(stepping, *assembly.system);
  const MarchFollower follower{[](double, ConstField) { return true; },
                               [&](double, Field temperature) {
                                 answer.temperatures.emplace_back(assembly.geometry.body.grid.size());
                                 assembly.layout.gather(temperature, answer.temperatures.back());
                                 return true;
                               },
                               [](double) { return true; }};
  integrator->march(0.0, output_times, state, follower);
  answer.seconds = seconds(Clock::thread) - start;
  answer.evaluations = static_cast<double>(integrator->count().evaluations);
  return answer;
}

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0, size = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    difference += (a[n] - b[n]) * (a[n] - b[n]);
    size += b[n] * b[n];
  }
  return std::sqrt(difference / size);
}

/// The largest over the output times.
double error_of(const Answer& answer, const Answer& reference) {
  double error = 0.0;
  for (std::size_t k = 0; k < answer.temperatures.size(); ++k) {
    error = std::max(error, relative_difference(answer.temperatures[k], reference.temperatures[k]));
  }
  return error;
}

/// The settings of an integrator from coarse to fine.
template <class Stepping>
std::vector<std::pair<std::string, Stepping>> ladder() {
  std::vector<std::pair<std::string, Stepping>> rungs;
  if (Stepping::name == "auto") return rungs;  // One of the others.
  if constexpr (requires(Stepping s) { s.relative_tolerance; }) {
    for (int power = 3; power <= 11; ++power) {
      Stepping stepping;
      stepping.relative_tolerance = std::pow(10.0, -power);
      rungs.emplace_back(fmt::format("tolerance 1e-{}", power), stepping);
    }
  } else if constexpr (requires(Stepping s) { s.safety; }) {
    Stepping stepping;
    stepping.safety = 1.0;
    rungs.emplace_back("longest stable step", stepping);
  }
  return rungs;
}

/// Cost at which an error is reached, between two trials on a line of logarithms.
std::optional<double> cost_at(const Trials& trials, double error, double Trial::*cost) {
  for (std::size_t k = 1; k < trials.size(); ++k) {
    const Trial &coarse = trials[k - 1], &fine = trials[k];
    if (coarse.error < error || fine.error > error) continue;
    const double place = std::log(error / coarse.error) / std::log(fine.error / coarse.error);
    return coarse.*cost * std::pow(fine.*cost / coarse.*cost, place);
  }
  return std::nullopt;
}

constexpr double most_evaluations = 8000.0;  // Further rungs of the ladder would take minutes.

class Solutions {
 public:
  Solutions(const Settings& settings, Report& report)
      : kind_(cracked_plate(settings)), report_(report), reference_(find_reference()) {}

  void measure_all() { each_stepping(std::make_index_sequence<std::variant_size_v<TimeStepping>>()); }

  void report_aims() {
    const Trial& euler = trials_.at("euler").front();
    const Trial& classical = trials_.at("rk4").front();
    // First order: twice the evaluations halve the error.
    const double longer = euler.error / 1e-4;
    const auto legendre = cost_at(trials_.at("rkl2"), 1e-4, &Trial::evaluations);
    if (legendre)
      report_.aim("evaluations of euler over rkl2 at error 1e-4", euler.evaluations * longer / *legendre,
                  Goal::at_least, 15.0);
    if (const auto time = cost_at(trials_.at("rkl2"), 1e-4, &Trial::seconds)) {
      report_.aim("time of rk4 at its limit over rkl2 at error 1e-4", classical.seconds / *time, Goal::at_least, 40.0);
    }
    if (!trials_.contains("chebyshev")) return;
    const Trials& exact = trials_["chebyshev"];
    const double most[] = {350.0, 430.0, 520.0};
    for (int k = 0; k < 3; ++k) {
      if (const auto count = cost_at(exact, wanted_errors[k], &Trial::evaluations)) {
        report_.aim(fmt::format("evaluations of chebyshev at error {:.0e}", wanted_errors[k]), *count, Goal::at_most,
                    most[k]);
      }
    }
    if (const auto time = cost_at(exact, 1e-6, &Trial::seconds)) {
      report_.aim("time of euler at error 1e-4 over chebyshev at 1e-6", euler.seconds * longer / *time, Goal::at_least,
                  60.0);
    }
  }

 private:
  /// The most accurate that this build has.
  Answer find_reference() const {
    std::optional<Answer> found;
    [&]<std::size_t... K>(std::index_sequence<K...>) {
      (try_reference<std::variant_alternative_t<K, TimeStepping>>(found), ...);
    }
    (std::make_index_sequence<std::variant_size_v<TimeStepping>>());
    if (!found) found = march(kind_, RungeKutta4{std::nullopt, 1.0});
    return *found;
  }

  template <class Stepping>
  void try_reference(std::optional<Answer>& found) const {
    if (found || Stepping::name != "chebyshev") return;
    if constexpr (requires(Stepping s) { s.relative_tolerance; }) {
      Stepping stepping;
      stepping.relative_tolerance = 1e-12;
      found = march(kind_, stepping);
    }
  }

  template <std::size_t... K>
  void each_stepping(std::index_sequence<K...>) {
    (measure<std::variant_alternative_t<K, TimeStepping>>(), ...);
  }

  template <class Stepping>
  void measure() {
    Trials& trials = trials_[std::string(Stepping::name)];
    for (const auto& [setting, stepping] : ladder<Stepping>()) {
      try {
        const Answer answer = march(kind_, stepping);
        trials.push_back({setting, answer.evaluations, answer.seconds, error_of(answer, reference_)});
      } catch (const Error& error) {
        report_.row({std::string(Stepping::name), setting, std::string(error.what()), std::string("-"),
                     std::string("-"), std::string("-")});
        return;
      }
      const Trial& trial = trials.back();
      report_.row({std::string(Stepping::name), setting, trial.evaluations, trial.seconds, trial.error,
                   1e3 * trial.seconds / trial.evaluations});
      if (trial.evaluations > most_evaluations || trial.error < wanted_errors[2]) break;
    }
    for (const double error : wanted_errors) {
      const auto count = cost_at(trials, error, &Trial::evaluations), time = cost_at(trials, error, &Trial::seconds);
      if (!count || !time) continue;
      report_.row({std::string(Stepping::name), fmt::format("between, for error {:.0e}", error), *count, *time, error,
                   1e3 * *time / *count});
    }
  }

  BodyKind kind_;
  Report& report_;
  Answer reference_;
  std::map<std::string, Trials> trials_;
};

}  // namespace

void measure_solutions(const Settings& settings, Report& report) {
  omp_set_num_threads(1);
  report.begin("solution",
               "cracked plate, " + text_of(cracked_plate(settings)) +
                   ", held above and below from a start at 0, answers at t = 0.01, 0.03 and 0.1; error: the largest "
                   "relative L2 difference from the reference; one thread, its processor time",
               {{"integrator"}, {"setting"}, {"evaluations"}, {"time", "s"}, {"error"}, {"time per evaluation", "ms"}});
  Solutions solutions(settings, report);
  solutions.measure_all();
  solutions.report_aims();
  report.end();
}

}  // namespace peritherm::bench
