#include "peritherm/simulation/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "peritherm/base/file.hpp"
#include "peritherm/base/version.hpp"
#include "peritherm/discretisation/damage.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/memory.hpp"
#include "peritherm/simulation/not_finite.hpp"
#include "peritherm/simulation/plan.hpp"
#include "peritherm/simulation/result_folder.hpp"
#include "peritherm/simulation/schedule.hpp"
#include "peritherm/simulation/summary.hpp"
#include "peritherm/simulation/write.hpp"

namespace peritherm {
namespace {

using Clock = std::chrono::steady_clock;

constexpr long evaluations_between_looks = 8;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Heat that came in against heat that is stored.
class EnergyBalance {
 public:
  EnergyBalance(const HeatSystem& system, ConstField state) : system_(system), first_(system.stored_heat(state)) {
    capacity_ = system.heat_capacity();
    widen(state);
  }

  /// |Σ rates| over the largest of them, for states whose heats are unknown. Where next to nothing flows, a billionth
  /// of what the spread of temperatures could make flow is the measure.
  double imbalance(const std::vector<double>& rates, double fastest_rate) const {
    double sum = 0.0, largest = 1e-9 * capacity_ * (highest_ - lowest_) * fastest_rate;
    for (const double rate : rates) {
      sum += rate;
      largest = std::max(largest, std::abs(rate));
    }
    return sum == 0.0 ? 0.0 : std::abs(sum) / largest;
  }

  /// |stored − stored at the start − Σ heats| over the largest of what flowed and what the spread could store.
  double residual(ConstField state) {
    widen(state);
    double sum = 0.0, flowed = capacity_ * (highest_ - lowest_);
    for (const double heat : system_.account_heats(state)) {
      sum += heat;
      flowed = std::max(flowed, std::abs(heat));
    }
    const double missing = std::abs(system_.stored_heat(state) - first_ - sum);
    // Where next to nothing flows, a millionth of what is stored is the measure.
    flowed = std::max(flowed, 1e-6 * capacity_ * std::max(std::abs(lowest_), std::abs(highest_)));
    return missing == 0.0 ? 0.0 : missing / std::max(flowed, std::numeric_limits<double>::min());
  }

 private:
  void widen(ConstField state) {
    const auto [lowest, highest] = system_.extremes(state);
    lowest_ = std::min(lowest_, lowest);
    highest_ = std::max(highest_, highest);
  }

  const HeatSystem& system_;
  double first_;
  double capacity_ = 0.0;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
};

/// Hands the state to those who look at it.
class Gallery {
 public:
  Gallery(const Problem& problem, const Assembly& assembly, const std::filesystem::path& folder)
      : problem_(problem), assembly_(assembly), watches_(make_watches(problem, folder)) {}

  void show(double time, FieldStorage& state, bool everybody) {
    std::vector<Observer*> due;
    for (const Watch& watch : watches_) {
      if (everybody || watch.is_due(time)) due.push_back(watch.observer.get());
    }
    if (due.empty()) return;
    HeatSystem& system = *assembly_.system;
    system.begin_step(time, time);
    system.fill(time, state);
    const Body& body = assembly_.geometry.body;
    const Snapshot snapshot{
        .time = time,
        .grid = body.grid,
        .title = problem_.title,
        .temperature = PointValues(assembly_.layout, state, body.material_of),
        .materials = body.material_of,
        .material_names = assembly_.geometry.material_names,
        .heat_flux = [&](std::size_t first, std::span<Point> flux) { heat_flux(assembly_, state, first, flux); },
        .damage = [&] { return damage(body, assembly_.geometry.stencil, cuts(), time); },
        .cracks = outlines(time),
        .stored_heat = system.stored_heat(state),
        .accounts = accounts(time, state),
    };
    for (Observer* observer : due) observer->observe(snapshot);
  }

  std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> all;
    for (const Watch& watch : watches_) {
      for (auto& file : watch.observer->files()) all.push_back(std::move(file));
    }
    return all;
  }

 private:
  std::vector<HeatAccount> accounts(double time, FieldStorage& state) {
    const std::vector<double> rates = assembly_.system->account_rates(time, state);
    const std::vector<double> heats = assembly_.system->account_heats(state);
    const std::vector<std::string> names = assembly_.system->account_names();
    std::vector<HeatAccount> result;
    for (std::size_t a = 0; a < names.size(); ++a) result.push_back({names[a], heats[a], rates[a]});
    return result;
  }

  std::vector<std::vector<Point>> outlines(double time) const {
    std::vector<std::vector<Point>> lines;
    for (const CrackSurface& crack : assembly_.geometry.body.cracks) {
      for (auto& line : crack.outline(time)) lines.push_back(std::move(line));
    }
    return lines;
  }

  const CutBonds& cuts() {
    if (const CutBonds* const known = assembly_.system->conduction().cut_bonds()) return *known;
    if (!cuts_) cuts_ = find_cut_bonds(assembly_.geometry.body, assembly_.geometry.stencil);
    return *cuts_;
  }

  const Problem& problem_;
  const Assembly& assembly_;
  std::vector<Watch> watches_;
  std::optional<CutBonds> cuts_;
};

/// The march from output time to output time.
class March {
 public:
  March(const Problem& problem, const RunSettings& settings, const TimeStepping& stepping, Assembly& assembly,
        RunSummary& summary)
      : problem_(problem),
        settings_(settings),
        assembly_(assembly),
        summary_(summary),
        gallery_(problem, assembly, settings.folder),
        state_(initial_state(problem, assembly)),
        balance_(*assembly.system, state_),
        integrator_(make_integrator(stepping, *assembly.system)) {
    summary_.plan.stable_step = integrator_->stable_step();
  }

  void go() {
    start_ = Clock::now();
    show(0.0, false);
    const MarchFollower follower{
        [this](double now, ConstField temperature) { return after_step(now, temperature); },
        [this](double now, Field) { return arrive(now); },
        [this](double now) { return report(now); },
    };
    const double time = integrator_->march(0.0, march_times(problem_), state_, follower);
    if (time > arrived_) {
      stopped_ = true;
      arrive(time);
    } else {
      record(time);
    }
    summary_.status = time < problem_.time.end ? "stopped" : "completed";
  }

  void count_up() {
    summary_.wall = seconds_since(start_);
    summary_.count = integrator_->count();
    summary_.peak_memory_bytes = peak_memory();
  }

  void record(double time) {
    count_up();
    summary_.end_time = time;
    const bool steady = std::holds_alternative<SteadyState>(problem_.time.integrator) && time == problem_.time.end;
    summary_.energy_relative_residual =
        steady ? balance_.imbalance(assembly_.system->account_rates(time, state_), assembly_.system->fastest_rate())
               : balance_.residual(state_);
  }

 private:
  void show(double time, bool everybody) {
    gallery_.show(time, state_, everybody);
    summary_.files = gallery_.files();
  }

  bool arrive(double now) {
    arrived_ = now;
    look(now, state_);
    record(now);
    show(now, stopped_);
    return !stopped_;
  }

  void look(double now, ConstField temperature) {
    const auto [lowest, highest] = assembly_.system->extremes(temperature);
    if (!std::isfinite(lowest) || !std::isfinite(highest)) report_not_finite(assembly_, temperature, now);
    looked_at_ = integrator_->count().evaluations;
  }

  bool after_step(double now, ConstField temperature) {
    // Looking at every point costs as much as a part of an evaluation, so short steps are not all looked at.
    if (integrator_->count().evaluations >= looked_at_ + evaluations_between_looks) look(now, temperature);
    summary_.end_time = now;
    return report(now);
  }

  bool report(double now) {
    if (settings_.on_progress) {
      settings_.on_progress({now, problem_.time.end, integrator_->count(), seconds_since(start_)});
    }
    stopped_ = settings_.stop_requested && settings_.stop_requested();
    return !stopped_;
  }

  const Problem& problem_;
  const RunSettings& settings_;
  Assembly& assembly_;
  RunSummary& summary_;
  Gallery gallery_;
  FieldStorage state_;
  EnergyBalance balance_;
  std::unique_ptr<TimeIntegrator> integrator_;
  bool stopped_ = false;
  double arrived_ = 0.0;
  long looked_at_ = -evaluations_between_looks;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

RunSummary run(const Problem& given, const RunSettings& settings) {
  // The backend that was chosen stands in resolved.toml: another choice would give other last digits.
  const Prepared prepared = prepare(given);
  const Problem& problem = prepared.problem;
  Assembly assembly = assemble(problem);
  RunSummary summary;
  const ChosenStepping chosen = choose_stepping(problem.time.integrator, *assembly.system, 0.0, march_times(problem));
  summary.plan = make_plan(prepared, assembly, chosen);
  // A run that cannot begin, for its step or its start, must neither remove results nor leave a folder behind.
  March march(problem, settings, chosen.stepping, assembly, summary);
  open_result_folder(settings.folder, settings.overwrite);
  remove_old_results(settings.folder);
  if (settings.on_plan) settings.on_plan(summary.plan);
  write_file(settings.folder / "resolved.toml", "# Written by peritherm " + std::string(version()) +
                                                    "; running it again reproduces the run.\n" +
                                                    write_problem(problem));
  try {
    march.go();
  } catch (...) {
    summary.status = "failed";
    march.count_up();
    try {
      write_summary(summary, settings.folder);
    } catch (const Error&) {
      // What ended the run matters more than that its summary is missing.
    }
    throw;
  }
  write_summary(summary, settings.folder);
  summary.files.insert(summary.files.begin(), {settings.folder / "summary.json", settings.folder / "resolved.toml"});
  return summary;
}

}  // namespace peritherm
