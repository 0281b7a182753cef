#include "peritherm/papers/mei_2021_reruns.hpp"

#include <cmath>

#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

/// Half of the last of two or three digits that a value is known to, and a little for the integration in time.
double digits_limit(double known) {
  const double hundredfold = 100.0 * known;
  return std::abs(hundredfold - std::round(hundredfold)) < 1e-9 ? 6e-3 : 6e-4;
}

ReportRow error_row(const std::string& name, double value, double known) {
  ReportRow row(name, {3, false});
  row.scheme(value);
  if (known > 0.0) row.recomputed(known).near(ValueKind::scheme, ValueKind::recomputed, digits_limit(known));
  return row;
}

}  // namespace

JudgedBars solve_judged_bars(std::vector<JudgedBar> bars, double time, TemperatureAt classical, PaperRuns& runs) {
  std::vector<PaperRun> all;
  for (const JudgedBar& one : bars) all.push_back(run_of_2021(one.bar, {time}));
  JudgedBars judged{std::move(bars), runs.solve(std::move(all)), {}, std::move(classical)};
  for (const Solution& solution : judged.solutions) judged.errors.push_back(errors_of(solution, 0, judged.classical));
  return judged;
}

ReportTable table_of_errors(std::string caption, const JudgedBars& judged) {
  ReportTable table{std::move(caption), {}};
  for (std::size_t k = 0; k < judged.bars.size(); ++k) {
    const JudgedBar& one = judged.bars[k];
    table.rows.push_back(error_row(one.name + ", largest", judged.errors[k].largest, one.recomputed.largest));
    table.rows.push_back(error_row(one.name + ", rms", judged.errors[k].rms, one.recomputed.rms));
    table.rows.push_back(
        error_row(one.name + ", mean of the nodes next to 5 cm", judged.errors[k].middle, one.recomputed.middle));
  }
  return table;
}

Chart chart_of_errors(std::string title, const JudgedBars& judged, const std::vector<std::size_t>& which) {
  Chart chart = make_paper_chart(std::move(title), "x [cm]", "difference [°C]");
  for (const std::size_t k : which) {
    const ComparedPoints points = compare_bar(judged.solutions[k], 0, judged.classical);
    Curve curve{judged.bars[k].name, points.x, {}};
    for (std::size_t n = 0; n < points.x.size(); ++n) curve.y.push_back(points.computed[n] - points.classical[n]);
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace peritherm
