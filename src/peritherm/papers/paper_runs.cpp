#include "peritherm/papers/paper_runs.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "peritherm/base/file.hpp"
#include "peritherm/studies/study_runs.hpp"

namespace peritherm {
namespace {

/// What a run may cost, to begin with the dear ones: bonds times the root of the time, as for propagators.
double cost_of(const PaperRun& run) {
  const auto dimension = static_cast<double>(run.problem.body.size.size());
  double points = 1.0;
  for (const int cells : run.problem.body.cells.value_or(std::vector<int>{})) points *= cells;
  return points * std::pow(2.0 * run.problem.nonlocality.horizon_ratio.value_or(1.0), dimension) *
         std::sqrt(run.times.empty() ? 0.0 : run.times.back()) * std::pow(points, 1.0 / dimension);
}

/// Hands out numbers, keeps the first exception.
class TaskQueue {
 public:
  explicit TaskQueue(std::size_t size) : size_(size) {}
  template <class Task>
  void work(const Task& task) {
    for (std::size_t number = next_++; number < size_; number = next_++) {
      try {
        task(number);
      } catch (...) {
        const std::lock_guard lock(guard_);
        if (!failure_) failure_ = std::current_exception();
        next_ = size_;
      }
    }
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::size_t size_;
  std::atomic<std::size_t> next_{0};
  std::mutex guard_;
  std::exception_ptr failure_;
};

}  // namespace

void PaperRuns::pass() const {
  if (stopped()) throw PapersStopped{};
}

void PaperRuns::carry_out(const std::vector<std::function<void()>>& tasks) {
  TaskQueue queue(tasks.size());
  std::mutex guard;
  std::size_t done = 0;
  const auto one = [&](std::size_t number) {
    pass();
    tasks[number]();
    pass();
    const std::lock_guard lock(guard);
    ++done;
    if (settings_.on_done) settings_.on_done(done, tasks.size());
  };
  {
    const std::size_t helpers = std::min(static_cast<std::size_t>(std::max(settings_.threads, 1)), tasks.size());
    std::vector<std::jthread> threads;
    for (std::size_t k = 0; k < helpers; ++k) threads.emplace_back([&] { queue.work(one); });
  }
  queue.rethrow();
}

std::vector<Solution> PaperRuns::solve(std::vector<PaperRun> runs) {
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cost_of(runs[a]) > cost_of(runs[b]); });
  std::vector<Solution> solutions(runs.size());
  std::vector<std::function<void()>> tasks;
  for (const std::size_t number : order) {
    tasks.emplace_back([this, number, &runs, &solutions] {
      PaperRun& run = runs[number];
      run.problem.numerics.threads = 1;
      solutions[number] = peritherm::solve(run.problem, run.times, [this] { return stopped(); });
    });
  }
  carry_out(tasks);
  return solutions;
}

Solution PaperRuns::solve(PaperRun run) { return solve(std::vector<PaperRun>{std::move(run)}).front(); }

std::filesystem::path PaperRuns::picture_path(const std::string& stem) const {
  make_folder(settings_.folder / "pictures");
  return settings_.folder / picture_name(stem);
}

PaperRun with_tolerance(PaperRun run, double tolerance) {
  set_tolerance(run.problem.time.integrator, tolerance);
  return run;
}

}  // namespace peritherm
