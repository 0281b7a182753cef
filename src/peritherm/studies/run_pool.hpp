#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/studies/run_cache.hpp"
#include "peritherm/studies/solve.hpp"

namespace peritherm {

/// How far the runs of a study are.
struct StudyProgress {
  std::size_t finished = 0;  ///< runs
  std::size_t runs = 0;
  double share = 0.0;  ///< of the expected work that is done
  double wall = 0.0;   ///< since the first of them began [s]
};

struct PoolSettings {
  int threads = 0;                                        ///< in all; 0: one per core
  bool rerun = false;                                     ///< finished runs are not taken from the cache
  std::function<void(const StudyProgress&)> on_progress;  ///< called by several threads, one at a time
  std::function<bool()> stop_requested;                   ///< called by several threads at once
};

/// What became of a run.
struct RunResult {
  std::optional<Solution> solution;  ///< none if it failed or was stopped
  std::string failure;               ///< why it failed
  Fault fault = Fault::input;        ///< of the failure
  std::string not_kept;              ///< why the cache could not take the solution; empty if it did
  bool reused = false;               ///< it had been run before
};

/// Solves every problem for the times, several at once: each by one thread, as many as there are threads and as fit
/// into the memory beside the solutions, the dearest first (by one thread the cheapest). With fewer runs left than
/// threads are free, they share those. What is finished is kept at once; problems that occur twice are solved once. A
/// run that fails, or that cannot be kept, leaves the others alone.
std::vector<RunResult> solve_all(const std::vector<Problem>& problems, const std::vector<double>& times,
                                 const RunCache& cache, const PoolSettings& settings);

}  // namespace peritherm
