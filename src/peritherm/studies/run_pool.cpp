#include "peritherm/studies/run_pool.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/memory.hpp"

namespace peritherm {
namespace {

/// A run that has to be made, and what it will take.
struct PendingRun {
  std::size_t number = 0;  ///< in the list of problems
  std::string key;
  Prepared prepared;  ///< for one thread
  double bytes = 0.0;
  double kept = 0.0;  ///< part of the bytes that its solution goes on holding
  double cost = 0.0;  ///< [s] by one thread
};

/// Gives the caller back its number of OpenMP threads, which estimates change.
class ThreadsOfCaller {
 public:
  ThreadsOfCaller() = default;
  ThreadsOfCaller(const ThreadsOfCaller&) = delete;
  ThreadsOfCaller& operator=(const ThreadsOfCaller&) = delete;
  ~ThreadsOfCaller() { omp_set_num_threads(before_); }

 private:
  int before_ = omp_get_max_threads();
};

class RunPool {
 public:
  RunPool(const std::vector<Problem>& problems, const std::vector<double>& times, const RunCache& cache,
          const PoolSettings& settings)
      : problems_(problems),
        times_(times),
        cache_(cache),
        settings_(settings),
        free_threads_(settings.threads > 0 ? settings.threads : omp_get_num_procs()),
        results_(problems.size()) {}

  std::vector<RunResult> go() {
    collect();
    tell();
    start_workers();
    for (const auto& [copy, original] : copies_) results_[copy] = results_[original];
    return std::move(results_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Returns when all have ended. Those that the system grants do the work of all.
  void start_workers() {
    std::vector<std::jthread> workers;
    const std::size_t count = std::min<std::size_t>(pending_.size(), static_cast<std::size_t>(free_threads_));
    workers.reserve(count);
    try {
      while (workers.size() < count) workers.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      if (workers.empty()) work();
    }
  }

  /// Finished runs are taken from the cache; of what is left, memory and duration are estimated.
  void collect() {
    std::map<std::string, std::size_t> known;
    double copied = 0.0;
    for (std::size_t n = 0; n < problems_.size(); ++n) {
      PendingRun run{n, run_key(problems_[n], times_), {}, 0.0, 0.0, 0.0};
      if (const auto [place, added] = known.emplace(run.key, n); !added) {
        copies_.emplace_back(n, place->second);
        copied += bytes_of_solution(n);
        continue;
      }
      if (!settings_.rerun) results_[n].solution = cache_.find(run.key);
      results_[n].reused = results_[n].solution.has_value();
      if (!results_[n].reused && estimate(run)) pending_.push_back(std::move(run));
    }
    total_ = pending_.size();
    for (const PendingRun& run : pending_) total_cost_ += run.cost;
    // What was taken from the cache is held already.
    free_memory_ = static_cast<double>(available_memory());
    memory_known_ = free_memory_ > 0.0;
    free_memory_ -= copied;
    // By several threads the dearest is taken first, so that none is left alone with it at the end; by one thread the
    // cheapest, so that an interrupted study keeps many runs.
    const double sign = free_threads_ > 1 ? 1.0 : -1.0;
    std::stable_sort(pending_.begin(), pending_.end(),
                     [sign](const auto& a, const auto& b) { return sign * a.cost > sign * b.cost; });
  }

  /// False if the run cannot be made at all.
  bool estimate(PendingRun& run) {
    try {
      Problem problem = problems_[run.number];
      problem.numerics.threads = 1;
      run.prepared = prepare_to_solve(std::move(problem), times_);
      run.kept = bytes_of_solution(run.number);
      run.bytes = run.prepared.bytes + run.kept;
      run.cost = run.prepared.duration + 1e-3;
      return true;
    } catch (const Error& error) {
      fail(run.number, error);
      return false;
    }
  }

  double bytes_of_solution(std::size_t number) const {
    return static_cast<double>(make_grid(problems_[number]).size() * times_.size() * sizeof(double));
  }

  void fail(std::size_t number, const Error& error) {
    results_[number].failure = error.what();
    results_[number].fault = error.fault();
  }

  bool stopped() const { return settings_.stop_requested && settings_.stop_requested(); }

  void work() {
    std::unique_lock lock(mutex_);
    while (!pending_.empty() && !stopped()) {
      const auto next = std::find_if(pending_.begin(), pending_.end(), [this](const PendingRun& run) {
        return running_ == 0 || !memory_known_ || run.bytes <= free_memory_;
      });
      if (next == pending_.end() || free_threads_ == 0) {
        changed_.wait(lock);
        continue;
      }
      PendingRun run = std::move(*next);
      // With fewer runs left than threads, they share them.
      const int threads = std::max(1, free_threads_ / static_cast<int>(pending_.size()));
      run.prepared.threads = threads;
      pending_.erase(next);
      ++running_;
      free_threads_ -= threads;
      free_memory_ -= run.bytes;
      lock.unlock();
      RunResult result = make(run);
      lock.lock();
      --running_;
      free_threads_ += threads;
      free_memory_ += run.bytes - (result.solution ? run.kept : 0.0);
      if (result.solution || !result.failure.empty()) {
        ++finished_;
        cost_done_ += run.cost;
      }
      results_[run.number] = std::move(result);
      tell();
      changed_.notify_all();
    }
  }

  RunResult make(const PendingRun& run) const {
    RunResult result;
    try {
      Solution solution = solve(run.prepared, times_, settings_.stop_requested);
      // A stopped run has not reached all of its times.
      if (solution.times.size() < times_.size()) return result;
      result.solution = std::move(solution);
      keep(run.key, result);
    } catch (const Error& error) {
      result.failure = error.what();
      result.fault = error.fault();
    } catch (const std::exception& error) {
      const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
      result.failure = memory ? "the memory of this machine does not suffice" : error.what();
      result.fault = Fault::machine;
    }
    return result;
  }

  /// A full disk costs no finished run, only that it is made again the next time.
  void keep(const std::string& key, RunResult& result) const {
    try {
      cache_.keep(key, *result.solution);
    } catch (const Error& error) {
      result.not_kept = error.what();
    }
  }

  void tell() {
    if (!settings_.on_progress) return;
    const double share = total_cost_ > 0.0 ? cost_done_ / total_cost_ : 1.0;
    settings_.on_progress({finished_, total_, share, std::chrono::duration<double>(Clock::now() - start_).count()});
  }

  const std::vector<Problem>& problems_;
  const std::vector<double>& times_;
  const RunCache& cache_;
  const PoolSettings& settings_;
  int free_threads_;
  double free_memory_ = 0.0;  ///< [B]
  bool memory_known_ = false;
  std::vector<RunResult> results_;
  std::vector<PendingRun> pending_;
  std::vector<std::pair<std::size_t, std::size_t>> copies_;  ///< numbers of equal problems
  std::mutex mutex_;
  std::condition_variable changed_;
  int running_ = 0;
  std::size_t finished_ = 0, total_ = 0;
  double total_cost_ = 0.0, cost_done_ = 0.0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

std::vector<RunResult> solve_all(const std::vector<Problem>& problems, const std::vector<double>& times,
                                 const RunCache& cache, const PoolSettings& settings) {
  const ThreadsOfCaller caller;
  return RunPool(problems, times, cache, settings).go();
}

}  // namespace peritherm
