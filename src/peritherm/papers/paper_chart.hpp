#pragma once

#include <string>
#include <vector>

#include "peritherm/output/chart.hpp"
#include "peritherm/papers/paper_runs.hpp"

namespace peritherm {

/// A chart without curves yet; `logarithmic`: both axes.
Chart make_paper_chart(std::string title, std::string x_label, std::string y_label, bool logarithmic = false);

/// Draws the chart into pictures/STEM.png of the report.
ReportPicture save_paper_chart(const Chart& chart, const std::string& stem, std::string caption, const PaperRuns& runs);

/// Temperature of a plate as a colour map with isotherms.
struct PaperField {
  const Solution& solution;
  std::size_t time = 0;  ///< index into its times
  std::string title;
  double low = -100.0;  ///< of the colours
  double high = 100.0;
  const Problem* problem = nullptr;  ///< whose cracks are drawn; none if null
};
ReportPicture save_paper_field(const PaperField& field, const std::string& stem, std::string caption,
                               const PaperRuns& runs);

}  // namespace peritherm
