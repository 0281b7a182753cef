#include "peritherm/simulation/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "peritherm/base/file.hpp"
#include "peritherm/base/version.hpp"
#include "peritherm/simulation/memory.hpp"
#include "peritherm/simulation/result_folder.hpp"
#include "peritherm/simulation/running_case.hpp"
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
  explicit EnergyBalance(const RunningCase& running)
      : running_(running), first_(running.stored_heat()), capacity_(running.heat_capacity()) {
    widen();
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
  double residual() {
    widen();
    double sum = 0.0, flowed = capacity_ * (highest_ - lowest_);
    for (const double heat : running_.account_heats()) {
      sum += heat;
      flowed = std::max(flowed, std::abs(heat));
    }
    const double missing = std::abs(running_.stored_heat() - first_ - sum);
    // Where next to nothing flows, a millionth of what is stored is the measure.
    flowed = std::max(flowed, 1e-6 * capacity_ * std::max(std::abs(lowest_), std::abs(highest_)));
    return missing == 0.0 ? 0.0 : missing / std::max(flowed, std::numeric_limits<double>::min());
  }

 private:
  void widen() {
    const auto [lowest, highest] = running_.extremes();
    lowest_ = std::min(lowest_, lowest);
    highest_ = std::max(highest_, highest);
  }

  const RunningCase& running_;
  double first_;
  double capacity_;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
};

/// Hands the state to those who look at it.
class Gallery {
 public:
  Gallery(RunningCase& running, const std::filesystem::path& folder)
      : running_(running), watches_(make_watches(running.problem(), folder)) {}

  void show(double time, bool everybody) {
    std::vector<Observer*> due;
    for (const Watch& watch : watches_) {
      if (everybody || watch.is_due(time)) due.push_back(watch.observer.get());
    }
    if (due.empty()) return;
    const Snapshot snapshot = running_.snapshot(time);
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
  RunningCase& running_;
  std::vector<Watch> watches_;
};

/// The march from output time to output time.
class March {
 public:
  March(RunningCase& running, const RunSettings& settings, RunSummary& summary)
      : running_(running),
        settings_(settings),
        summary_(summary),
        gallery_(running, settings.folder),
        balance_(running) {
    summary_.plan.stable_step = running.stable_step();
  }

  void go() {
    start_ = Clock::now();
    show(0.0, false);
    const RunningCase::Follower follower{
        [this](double now) { return after_step(now); },
        [this](double now) { return arrive(now); },
        [this](double now) { return report(now); },
    };
    const double time = running_.march(march_times(running_.problem()), follower);
    if (time > arrived_) {
      stopped_ = true;
      arrive(time);
    } else {
      record(time);
    }
    summary_.status = time < end() ? "stopped" : "completed";
  }

  void count_up() {
    summary_.wall = seconds_since(start_);
    summary_.count = running_.count();
    summary_.peak_memory_bytes = peak_memory();
    running_.complete(summary_);
  }

  void record(double time) {
    count_up();
    summary_.end_time = time;
    const bool steady = std::holds_alternative<SteadyState>(running_.problem().time.integrator) && time == end();
    summary_.energy_relative_residual =
        steady ? balance_.imbalance(running_.account_rates(time), running_.fastest_rate()) : balance_.residual();
  }

 private:
  double end() const { return running_.problem().time.end; }

  void show(double time, bool everybody) {
    gallery_.show(time, everybody);
    summary_.files = gallery_.files();
  }

  bool arrive(double now) {
    arrived_ = now;
    look(now);
    record(now);
    show(now, stopped_);
    return !stopped_;
  }

  void look(double now) {
    const auto [lowest, highest] = running_.extremes();
    if (!std::isfinite(lowest) || !std::isfinite(highest)) running_.report_not_finite(now);
    looked_at_ = running_.count().evaluations;
  }

  bool after_step(double now) {
    // Looking at every point costs as much as a part of an evaluation, so short steps are not all looked at.
    if (running_.count().evaluations >= looked_at_ + evaluations_between_looks) look(now);
    summary_.end_time = now;
    return report(now);
  }

  bool report(double now) {
    if (settings_.on_progress) settings_.on_progress({now, end(), running_.count(), seconds_since(start_)});
    stopped_ = settings_.stop_requested && settings_.stop_requested();
    return !stopped_;
  }

  RunningCase& running_;
  const RunSettings& settings_;
  RunSummary& summary_;
  Gallery gallery_;
  EnergyBalance balance_;
  bool stopped_ = false;
  double arrived_ = 0.0;
  long looked_at_ = -evaluations_between_looks;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

std::unique_ptr<RunningCase> make_running_case(const Problem& problem) {
  return problem.nonlocality.model == Model::two_field ? make_two_field_case(problem) : make_bond_case(problem);
}

Plan plan(const Problem& problem) { return make_running_case(problem)->plan(); }

RunSummary run(const Problem& given, const RunSettings& settings) {
  // The backend that was chosen stands in resolved.toml: another choice would give other last digits.
  const std::unique_ptr<RunningCase> running = make_running_case(given);
  RunSummary summary;
  summary.plan = running->plan();
  // A run that cannot begin, for its step or its start, must neither remove results nor leave a folder behind.
  March march(*running, settings, summary);
  open_result_folder(settings.folder, settings.overwrite);
  remove_old_results(settings.folder);
  if (settings.on_plan) settings.on_plan(summary.plan);
  write_file(settings.folder / "resolved.toml", "# Written by peritherm " + std::string(version()) +
                                                    "; running it again reproduces the run.\n" +
                                                    write_problem(running->problem()));
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
