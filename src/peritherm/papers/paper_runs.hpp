#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "peritherm/papers/report.hpp"
#include "peritherm/studies/solve.hpp"

namespace peritherm {

/// A problem to march through some times (ascending) [s].
struct PaperRun {
  Problem problem;
  std::vector<double> times;
};

/// Thrown out of an example when somebody asked for the end.
struct PapersStopped {};

/// What the examples compute with: marches problems side by side, one thread each, and keeps pictures.
class PaperRuns {
 public:
  struct Settings {
    bool quick = false;
    int threads = 1;
    std::filesystem::path folder;                                    ///< of the report; pictures go below it
    std::function<bool()> stop_requested;                            ///< asked often
    std::function<void(std::size_t done, std::size_t all)> on_done;  ///< after each task of a batch
  };
  explicit PaperRuns(Settings settings) : settings_(std::move(settings)) {}

  bool quick() const { return settings_.quick; }

  /// In the order of the runs; dear ones are begun first. Throws PapersStopped; any other error of a run ends all.
  std::vector<Solution> solve(std::vector<PaperRun> runs);
  Solution solve(PaperRun run);

  /// Any other tasks side by side. Throws like `solve`.
  void carry_out(const std::vector<std::function<void()>>& tasks);

  /// Throws PapersStopped if somebody asked for the end.
  void pass() const;

  /// pictures/STEM.png below the folder.
  std::filesystem::path picture_path(const std::string& stem) const;
  static std::string picture_name(const std::string& stem) { return "pictures/" + stem + ".png"; }

 private:
  bool stopped() const { return settings_.stop_requested && settings_.stop_requested(); }

  Settings settings_;
};

/// The same run with another tolerance in time, where its integrator has one.
PaperRun with_tolerance(PaperRun run, double tolerance);

}  // namespace peritherm
