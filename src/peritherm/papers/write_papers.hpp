#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "peritherm/papers/report.hpp"

namespace peritherm {

struct PapersProgress {
  std::string example;       ///< "bobaru_2010: Example 1: …"
  std::size_t examples = 0;  ///< in all
  std::size_t finished = 0;  ///< examples
  std::size_t tasks = 0;     ///< of the batch that runs now
  std::size_t tasks_done = 0;
  double wall = 0.0;  ///< since the start [s]
};

struct PapersSettings {
  std::vector<std::string> names;                          ///< of papers; empty: all
  bool quick = false;                                      ///< coarser and fewer runs
  int threads = 0;                                         ///< runs side by side; 0: one per core
  std::filesystem::path folder;                            ///< of the report; made if missing
  bool overwrite = false;                                  ///< a report that is there may be replaced
  std::function<void(const PapersProgress&)> on_progress;  ///< from one thread at a time
  std::function<bool()> stop_requested;                    ///< true ends the run; what is finished is kept
};

struct PapersSummary {
  ReportVerdict verdict;
  bool stopped = false;
  double wall = 0.0;  ///< [s]
  std::vector<std::filesystem::path> files;
  std::vector<std::string> failed;  ///< "bobaru_2010, Example 1: quantity: check"
};

/// Computes the examples of the papers and writes report.html, report.csv, report.txt, one NAME.md per paper and
/// pictures/ after each of them, so that a run that is stopped keeps what it has. Throws Error: unknown names;
/// Fault::machine if a report would be replaced.
PapersSummary write_papers(const PapersSettings& settings);

}  // namespace peritherm
