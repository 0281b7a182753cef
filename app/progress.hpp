#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

#include "peritherm/simulation/simulate.hpp"

namespace peritherm::app {

/// Shows how far a run is: on a terminal one line that is redrawn at most ten times a second, elsewhere a plain line
/// for every tenth of the run and after ten seconds without one.
class ProgressDisplay {
 public:
  enum class Style { silent, plain, live };

  ProgressDisplay(std::ostream& out, Style style);

  void show(const Progress& progress);

  /// Removes the live line, so that what follows begins on a clean one.
  void close();

 private:
  void show_live(const Progress& progress);
  void show_plain(const Progress& progress);

  std::ostream& out_;
  Style style_;
  std::chrono::steady_clock::time_point last_{};
  double last_share_ = 0.0;
  bool line_open_ = false;
};

/// "42 %  3.15 s of 7.5 s  1 204 steps  812 evaluations/s  8 s left", with a bar in front if there is room for it.
std::string progress_line(const Progress& progress, int width);

/// Live if standard output is a terminal, else plain.
ProgressDisplay::Style display_style(bool quiet);

}  // namespace peritherm::app
