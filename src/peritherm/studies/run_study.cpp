#include "peritherm/studies/run_study.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "peritherm/base/text.hpp"
#include "peritherm/output/labels.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/studies/study_errors.hpp"

namespace peritherm {
namespace {

/// A run that is made again to see the error of the time integration.
struct TimeCheck {
  std::size_t run = 0;  ///< number in the list of runs
  StudyRun again;
  std::string how;
};

/// The same run, more exact in time; nothing if it has no means to be.
std::optional<TimeCheck> make_time_check(const ReadStudy& read, std::size_t number, const StudyRun& run) {
  TimeCheck check{number, run, {}};
  const bool changed = std::visit(
      [&](auto& options) {
        if constexpr (requires { options.step; }) {
          if (options.step) {
            *options.step *= 0.5;
            check.how = "half the time step";
            return true;
          }
        }
        if constexpr (requires { options.relative_tolerance; }) {
          options.relative_tolerance = read.study.tolerance / 10.0;
          check.how = "relative tolerance " + shortest(read.study.tolerance / 10.0) + " in place of " +
                      shortest(read.study.tolerance);
          return true;
        } else if constexpr (requires { options.safety; }) {
          options.safety *= 0.5;
          check.how = "half the time step";
          return true;
        } else {
          return false;
        }
      },
      check.again.problem.time.integrator);
  return changed ? std::optional(std::move(check)) : std::nullopt;
}

/// Of each variant the run in the middle, by its number of points: neither the cheapest nor the dearest. Of an
/// intersection alone: of its coarse runs.
std::vector<TimeCheck> make_time_checks(const ReadStudy& read, const std::vector<StudyRun>& runs) {
  std::vector<TimeCheck> checks;
  if (!read.study.vary.time_steps.empty()) return checks;
  for (std::size_t v = 0; v < read.cases.size(); ++v) {
    std::vector<std::size_t> numbers;
    for (std::size_t n = 0; n < (read.runs.empty() ? runs.size() : read.runs.size()); ++n) {
      if (runs[n].variant == v && (!read.runs.empty() || numbers.size() < 6)) numbers.push_back(n);
    }
    if (numbers.empty()) continue;
    std::stable_sort(numbers.begin(), numbers.end(), [&runs](std::size_t a, std::size_t b) {
      return make_grid(runs[a].problem).size() < make_grid(runs[b].problem).size();
    });
    const std::size_t middle = numbers[(numbers.size() - 1) / 2];
    if (auto check = make_time_check(read, middle, runs[middle])) checks.push_back(std::move(*check));
  }
  return checks;
}

std::string counted_runs(std::size_t count) {
  return count == 1 ? "1 finished run" : std::to_string(count) + " finished runs";
}

/// Runs a list of problems and notes what became of them.
class StudyRunner {
 public:
  StudyRunner(const ReadStudy& read, const StudySettings& settings, StudySummary& summary)
      : read_(read), settings_(settings), cache_(settings.folder / "runs"), summary_(summary) {}

  void go() {
    std::vector<StudyRun> runs = read_.runs;
    const std::size_t per_variant = append_intersections(runs);
    const std::vector<TimeCheck> checks = make_time_checks(read_, runs);
    const auto first_check = static_cast<std::ptrdiff_t>(runs.size());
    for (const TimeCheck& check : checks) runs.push_back(check.again);
    std::vector<RunResult> results = solve(runs);
    note_time_errors(checks, runs, results);
    const auto own = static_cast<std::ptrdiff_t>(read_.runs.size());
    std::vector<RunResult> coarse(std::make_move_iterator(results.begin() + own),
                                  std::make_move_iterator(results.begin() + first_check));
    results.resize(read_.runs.size());
    summary_.results = std::move(results);
    compare_runs(read_, summary_);
    if (per_variant > 0) intersect(coarse, per_variant);
  }

  bool stopped() const { return settings_.pool.stop_requested && settings_.pool.stop_requested(); }

 private:
  std::vector<RunResult> solve(const std::vector<StudyRun>& runs) {
    std::vector<Problem> problems;
    for (const StudyRun& run : runs) problems.push_back(run.problem);
    std::vector<RunResult> results = solve_all(problems, read_.study.times, cache_, settings_.pool);
    std::size_t lost = 0;
    std::string reason;
    for (std::size_t n = 0; n < results.size(); ++n) {
      ++summary_.runs;
      if (!results[n].not_kept.empty() && ++lost == 1) reason = results[n].not_kept;
      summary_.reused += results[n].reused ? 1 : 0;
      if (results[n].failure.empty()) continue;
      const std::string name = run_name(read_.study, runs[n]);
      note_failure("the run with " + name + " failed: " + results[n].failure, results[n].fault);
    }
    if (lost > 0) {
      note_failure(counted_runs(lost) + " could not be kept for another time: " + reason, Fault::machine);
    }
    return results;
  }

  void note_failure(const std::string& text, Fault fault) {
    if (summary_.failures.empty()) summary_.fault = fault;
    if (std::find(summary_.failures.begin(), summary_.failures.end(), text) == summary_.failures.end()) {
      summary_.failures.push_back(text);
    }
  }

  std::size_t append_intersections(std::vector<StudyRun>& runs) const {
    std::size_t count = 0;
    for (std::size_t v = 0; read_.study.intersection && v < read_.cases.size(); ++v) {
      const std::vector<StudyRun> own = intersection_runs(read_, v);
      count = own.size();
      runs.insert(runs.end(), own.begin(), own.end());
    }
    return count;
  }

  void note_time_errors(const std::vector<TimeCheck>& checks, const std::vector<StudyRun>& runs,
                        const std::vector<RunResult>& results) {
    const std::size_t first_check = runs.size() - checks.size();
    for (std::size_t k = 0; k < checks.size(); ++k) {
      const std::size_t run = checks[k].run;
      if (!results[run].solution || !results[first_check + k].solution) continue;
      summary_.time_errors.push_back({run_name(read_.study, runs[run]),
                                      largest_difference(*results[run].solution, *results[first_check + k].solution),
                                      checks[k].how});
    }
  }

  /// `per_variant` results for each variant: the six coarse runs, and the single one if there is one.
  void intersect(const std::vector<RunResult>& results, std::size_t per_variant) {
    std::vector<StudyRun> reruns;
    std::vector<std::size_t> of_result;
    for (std::size_t v = 0; v < read_.cases.size(); ++v) {
      const std::span<const RunResult> own(results.data() + v * per_variant, per_variant);
      std::vector<Solution> coarse;
      for (std::size_t k = 0; k < 6 && own[k].solution; ++k) coarse.push_back(*own[k].solution);
      if (coarse.size() < 6) continue;
      IntersectionResult result = find_crossings(read_, v, coarse);
      if (per_variant > 6 && own[6].solution) {
        result.single = judge(read_, *own[6].solution, read_.study.intersection->single->horizon_ratio);
      }
      if (!result.chosen.crossing) {
        note_failure(missing_crossing(read_, result), Fault::numerics);
      } else if (read_.study.intersection->cells) {
        reruns.push_back(rerun_at(read_, v, result.chosen.crossing->ratio));
        of_result.push_back(summary_.intersections.size());
      }
      summary_.intersections.push_back(std::move(result));
    }
    if (stopped()) return;
    const std::vector<RunResult> again = solve(reruns);
    for (std::size_t k = 0; k < again.size(); ++k) {
      IntersectionResult& result = summary_.intersections[of_result[k]];
      if (again[k].solution) result.rerun = judge(read_, *again[k].solution, result.chosen.crossing->ratio);
    }
  }

  const ReadStudy& read_;
  const StudySettings& settings_;
  RunCache cache_;
  StudySummary& summary_;
};

}  // namespace

StudySummary run_study(const ReadStudy& read, const StudySettings& settings) {
  const auto start = std::chrono::steady_clock::now();
  prepare_study_folder(read, settings);
  StudySummary summary;
  StudyRunner runner(read, settings, summary);
  runner.go();
  summary.status = runner.stopped() ? "stopped" : (summary.failures.empty() ? "completed" : "failed");
  summary.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_study(read, settings.folder, summary);
  draw_study(read, settings.folder, summary);
  return summary;
}

}  // namespace peritherm
