#pragma once

#include "peritherm/output/chart.hpp"
#include "peritherm/papers/mei_2021_bars.hpp"
#include "peritherm/papers/mei_2021_values.hpp"

namespace peritherm {

/// A rerun at the crossing m or a single run with a small horizon, and what an independent prototype found for it.
struct JudgedBar {
  std::string name;
  BarOf2021 bar;
  mei_2021_values::RerunValue recomputed{};  ///< zeros: nothing is known
};

/// Solutions of such bars at one time and their errors.
struct JudgedBars {
  std::vector<JudgedBar> bars;
  std::vector<Solution> solutions;
  std::vector<BarErrors> errors;
  TemperatureAt classical;
};
JudgedBars solve_judged_bars(std::vector<JudgedBar> bars, double time, TemperatureAt classical, PaperRuns& runs);

/// Largest, rms and mid-bar error of each.
ReportTable table_of_errors(std::string caption, const JudgedBars& judged);

/// Differences to the classical solution along the bar, of some of the runs.
Chart chart_of_errors(std::string title, const JudgedBars& judged, const std::vector<std::size_t>& which);

}  // namespace peritherm
