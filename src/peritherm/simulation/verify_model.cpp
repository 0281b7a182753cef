#include "peritherm/simulation/verify_model.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/integrator.hpp"
#include "peritherm/output/interpolation.hpp"
#include "peritherm/simulation/model_question.hpp"

namespace peritherm {
namespace {

using VerifyClock = std::chrono::steady_clock;

/// A tenth of the model's error, within what integrators can do.
double full_tolerance(const ReducedModel& model) {
  const double error = std::isfinite(model.estimated_error) ? model.estimated_error : 1e-7;
  return std::clamp(0.1 * error, 1e-12, 1e-4);
}

/// Compares the full model's states with the reduced one's as they come.
class ModelComparison {
 public:
  ModelComparison(ReducibleCase& reducible, const ReducedModel& model, std::vector<ModelState> states, double level)
      : reducible_(reducible), model_(model), states_(std::move(states)), level_(level) {
    const std::size_t points = reducible.full.present.size();
    full_.resize(points);
    reduced_.resize(points);
    for (const OutputOptions& output : reducible.problem.outputs) {
      const auto* probe = std::get_if<ProbeOutput>(&output.kind);
      if (probe == nullptr) continue;
      probes_.push_back(probe_model(reducible.problem, model, probe->at));
      places_.push_back(to_point(probe->at));
      result.probes.push_back({probe->column, 0.0, model.judge.equations.rates.empty() ? missing : 0.0});
    }
    result.estimated = model.judge.equations.rates.empty() ? missing : 0.0;
  }

  void compare(double time, Field state) {
    HeatSystem& system = *reducible_.assembly.system;
    system.begin_step(time, time);
    system.fill(time, state);
    const auto [lowest, highest] = system.extremes(state);
    lowest_ = std::min(lowest_, lowest);
    highest_ = std::max(highest_, highest);
    result.span = highest_ - lowest_;
    if (time == 0.0) return;
    const ModelState& answered = states_[next_++];
    reducible_.assembly.layout.gather(state, full_);
    lift(model_, answered, level_, reduced_);
    result.times.push_back(compare_fields(time, estimated_error(model_, answered)));
    result.rms = std::max(result.rms, result.times.back().rms);
    result.maximum = std::max(result.maximum, result.times.back().maximum);
    result.estimated = std::max(result.estimated, result.times.back().estimated);
    compare_probes(answered);
  }

  ModelVerification result;

 private:
  static constexpr double missing = std::numeric_limits<double>::quiet_NaN();

  ModelVerification::AtTime compare_fields(double time, double estimated) const {
    double sum = 0.0, largest = 0.0;
    std::size_t count = 0;
    for (std::size_t n = 0; n < full_.size(); ++n) {
      if (!reducible_.full.present[n]) continue;
      const double difference = std::abs(reduced_[n] - full_[n]);
      sum += difference * difference;
      largest = std::max(largest, difference);
      ++count;
    }
    return {time, std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1))), largest, estimated};
  }

  void compare_probes(const ModelState& answered) {
    const Body& body = reducible_.assembly.geometry.body;
    std::vector<double> values = full_;
    for (std::size_t n = 0; n < values.size(); ++n) {
      if (!reducible_.full.present[n]) values[n] = missing;
    }
    for (std::size_t k = 0; k < probes_.size(); ++k) {
      ModelVerification::AtProbe& at = result.probes[k];
      const double full = interpolate(body.grid, values, places_[k]);
      at.maximum = std::max(at.maximum, std::abs(probes_[k].temperature(answered, level_) - full));
      at.estimated = std::max(at.estimated, probes_[k].estimated_error(answered));
    }
  }

  ReducibleCase& reducible_;
  const ReducedModel& model_;
  std::vector<ModelState> states_;
  double level_;
  std::size_t next_ = 0;
  std::vector<double> full_, reduced_;
  std::vector<ModelProbe> probes_;
  std::vector<Point> places_;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

ModelVerification verify_model(ReducibleCase& reducible, const ReducedCase& reduced,
                               const ReductionProgress& progress) {
  const ModelQuestion question = make_question(reducible.problem, reduced.model, reducible.full.times);
  ModelComparison comparison(reducible, reduced.model, answer(reduced.model, question), question.level);
  const double tolerance = full_tolerance(reduced.model);
  HeatSystem& system = *reducible.assembly.system;
  FieldStorage state = initial_state(reducible.problem, reducible.assembly);
  comparison.compare(0.0, state);
  const auto start = VerifyClock::now();
  double comparing = 0.0;
  // Its error at the end is what it was told; methods that control the error of each step are off by far more.
  const TimeStepping accurate = Chebyshev{tolerance};
  const bool changes = system.body_changes_within(0.0, reducible.full.longest_time);
  const ChosenStepping chosen = changes
                                    ? choose_stepping(AutomaticStepping{tolerance}, system, 0.0, reducible.full.times)
                                    : ChosenStepping{accurate, {}};
  const auto integrator = make_integrator(chosen.stepping, system);
  const auto goes_on = [&](double now) { return !progress || progress("full run", now / reducible.full.longest_time); };
  const double reached = integrator->march(0.0, reducible.full.times, state,
                                           {[&](double now, ConstField) { return goes_on(now); },
                                            [&](double now, Field field) {
                                              const auto look = VerifyClock::now();
                                              comparison.compare(now, field);
                                              comparing +=
                                                  std::chrono::duration<double>(VerifyClock::now() - look).count();
                                              return goes_on(now);
                                            },
                                            goes_on});
  if (reached < reducible.full.longest_time) throw Error("the comparison with the full model was stopped", "");
  ModelVerification result = std::move(comparison.result);
  const double marched = std::chrono::duration<double>(VerifyClock::now() - start).count() - comparing;
  result.full_seconds = reducible.assembly_seconds + marched;
  result.integrator = std::visit([](const auto& options) { return std::string(options.name); }, chosen.stepping);
  result.tolerance = tolerance;
  result.evaluations = integrator->count().evaluations;
  return result;
}

}  // namespace peritherm
