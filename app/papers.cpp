#include "papers.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <iostream>

#include "interrupt.hpp"
#include "peritherm/base/error.hpp"
#include "peritherm/papers/write_papers.hpp"
#include "progress.hpp"
#include "text.hpp"

namespace peritherm::app {
namespace {

/// One line per example, and on a terminal a line that counts the runs of the present one.
class PapersDisplay {
 public:
  explicit PapersDisplay(ProgressDisplay::Style style) : style_(style) {}

  void show(const PapersProgress& progress) {
    if (style_ == ProgressDisplay::Style::silent) return;
    if (progress.example != example_) {
      close();
      std::cout << fmt::format("[{} of {}] {}", progress.finished + 1, progress.examples, progress.example)
                << std::endl;
      example_ = progress.example;
    }
    if (style_ != ProgressDisplay::Style::live || progress.tasks == 0) return;
    std::cout << fmt::format("\r  {} of {} runs, {}\033[K", progress.tasks_done, progress.tasks,
                             duration_text(progress.wall))
              << std::flush;
    open_ = true;
  }

  void close() {
    if (open_) std::cout << "\r\033[K" << std::flush;
    open_ = false;
  }

 private:
  ProgressDisplay::Style style_;
  std::string example_;
  bool open_ = false;
};

void print_summary(const PapersSummary& summary, bool quiet) {
  if (!quiet) {
    for (const std::string& row : summary.failed) std::cout << "does not hold: " << row << '\n';
    std::cout << fmt::format("{} of {} judged rows hold after {}\n", summary.verdict.judged - summary.verdict.failed,
                             summary.verdict.judged, duration_text(summary.wall));
    for (const auto& file : summary.files) std::cout << "  " << path_text(file) << '\n';
  }
  if (summary.stopped) {
    std::cerr << fmt::format("stopped: {} left out; the report holds what is finished\n",
                             counted(summary.verdict.missing, "example is", "examples are"));
  }
}

}  // namespace

int run_papers(const PapersArguments& arguments) {
  PapersDisplay display(display_style(arguments.quiet));
  PapersSettings settings;
  settings.names = arguments.names;
  settings.quick = arguments.quick;
  settings.threads = arguments.threads;
  settings.folder = arguments.output.empty() ? "results/papers" : arguments.output;
  settings.overwrite = arguments.overwrite;
  settings.on_progress = [&display](const PapersProgress& progress) { display.show(progress); };
  settings.stop_requested = [] { return interrupt() != 0; };
  watch_interrupts();
  PapersSummary summary;
  try {
    summary = write_papers(settings);
  } catch (...) {
    display.close();
    throw;
  }
  display.close();
  print_summary(summary, arguments.quiet);
  if (summary.stopped) return exit_signal_base + interrupt();
  return summary.verdict.failed == 0 ? 0 : static_cast<int>(Fault::numerics);
}

}  // namespace peritherm::app
