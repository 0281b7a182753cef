#pragma once

#include <chrono>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "peritherm/studies/run_study.hpp"
#include "progress.hpp"

namespace peritherm::app {

/// "12 runs: 3 horizons, 4 horizon ratios", below the title.
std::string study_heading(const ReadStudy& study);

/// Errors with the rates between them, crossings, the error in time, and the files.
std::string study_text(const ReadStudy& study, const StudySummary& summary, const std::filesystem::path& folder);

/// Shows how many runs are done: on a terminal one line that is redrawn, elsewhere a line after each run.
class StudyDisplay {
 public:
  StudyDisplay(std::ostream& out, ProgressDisplay::Style style) : out_(out), style_(style) {}
  void show(const StudyProgress& progress);
  void close();

 private:
  std::ostream& out_;
  ProgressDisplay::Style style_;
  bool line_open_ = false;
};

}  // namespace peritherm::app
