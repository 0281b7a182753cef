#include "peritherm/studies/study_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "peritherm/output/labels.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/studies/study_errors.hpp"

namespace peritherm {
namespace {

constexpr int parabola_places = 60;

Chart titled(const ReadStudy& read, double time) {
  Chart chart;
  const std::string title = read.study.title.empty() ? read.cases.front().title : read.study.title;
  chart.title = title + (title.empty() ? "" : ", ") + time_text(time);
  return chart;
}

/// Lengths in a unit that suits the largest of them.
struct LengthScale {
  explicit LengthScale(double size) : unit(length_unit(size)) {}
  std::string label(const std::string& name) const { return name + " [" + std::string(unit.symbol) + "]"; }
  Unit unit;
};

LengthScale body_scale(const ReadStudy& read) {
  const Grid grid = make_grid(read.cases.front());
  return LengthScale(grid.length(0));
}

std::string norm_label(const std::string& quantity) {
  if (quantity == "relative_l2") return "relative ℓ² difference";
  if (quantity == "bobaru_2010") return "difference in the norm of 2010";
  if (quantity == "relative_rms") return "relative rms difference";
  if (quantity == "rms") return "rms difference";
  if (quantity == "maximum") return "largest difference";
  return "difference at " + quantity;
}

void add_triangle(Chart& chart, const Curve& curve, double rate) {
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (std::isfinite(curve.y[i]) && curve.y[i] > 0.0) usable.push_back(i);
  }
  if (usable.size() < 2 || !std::isfinite(rate) || std::abs(rate) < 0.2) return;
  const std::size_t a = usable[usable.size() - 2], b = usable.back();
  const double x_from = std::min(curve.x[a], curve.x[b]), x_to = std::max(curve.x[a], curve.x[b]);
  const double lower = std::min(curve.y[a], curve.y[b]);
  chart.slopes.push_back({x_from, x_to, 0.45 * lower, rate, fmt::format("{:.2f}", rate)});
}

Curve level(const std::string& name, double from, double to, double value) {
  return {name, {from, to}, {value, value}, CurveStyle::dashed, 7};
}

/// One level if all curves share it. With a nonlocal solution of each run's own horizon there is none to draw.
void add_references(Chart& chart, const std::vector<double>& references) {
  const auto [least, most] = std::minmax_element(references.begin(), references.end());
  if (*most - *least > 1e-12 * std::max(std::abs(*least), std::abs(*most))) return;
  double low = HUGE_VAL, high = 0.0;
  for (const Curve& curve : chart.curves) {
    for (const double x : curve.x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  chart.curves.push_back(level("reference", low, high, *most));
}

std::string horizon_name(double horizon) {
  const Unit unit = length_unit(horizon);
  return "horizon " + rounded_text(horizon / unit.size, 4) + ' ' + std::string(unit.symbol);
}

/// Distance from the first of the places, or x of a bar.
std::vector<double> distances(const ReadStudy& read, const std::vector<Point>& places, double unit) {
  std::vector<double> result;
  for (const Point& place : places) {
    const Point& from = places.front();
    const double distance = std::hypot(place[0] - from[0], place[1] - from[1], place[2] - from[2]);
    result.push_back((read.cases.front().body.size.size() == 1 ? place[0] : distance) / unit);
  }
  return result;
}

Chart crossings_chart(const ReadStudy& read, const StudySummary& summary, bool along) {
  Chart chart = titled(read, read.study.intersection->time);
  const LengthScale scale = body_scale(read);
  chart.x.label = along ? scale.label("x") : "t [s]";
  chart.y.label = "intersecting horizon ratio";
  if (!along) chart.title = read.study.title;
  chart.y.low = 0.0;
  chart.y.high = 1.25 * *std::max_element(read.study.intersection->horizon_ratios.begin(),
                                          read.study.intersection->horizon_ratios.end());
  for (const IntersectionResult& result : summary.intersections) {
    Curve curve{read.study.variants.size() > 1 ? result.variant : "", {}, {}, CurveStyle::dots_on_line, -1};
    for (const LocatedCrossing& at : along ? result.along : result.over_time) {
      curve.x.push_back(along ? at.place[0] / scale.unit.size : at.time);
      // A gap where the curves do not cross.
      curve.y.push_back(at.crossing ? at.crossing->ratio : std::nan(""));
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace

Chart error_chart(const ReadStudy& read, const std::vector<const ConvergenceSeries*>& group) {
  Chart chart = titled(read, group.front()->time);
  const bool is_length = group.front()->axis == "horizon" || group.front()->axis == "spacing";
  const LengthScale scale(group.front()->parameters.front());
  const double unit = is_length ? scale.unit.size : 1.0;
  chart.x = {is_length ? scale.label(group.front()->axis) : group.front()->axis, AxisScale::logarithmic, {}, {}};
  if (group.front()->axis == "time step") chart.x.label += " [s]";
  chart.y = {norm_label(group.front()->quantity), AxisScale::logarithmic, {}, {}};
  for (const ConvergenceSeries* series : group) {
    Curve curve{series->name, {}, series->errors, CurveStyle::dots_on_line, -1};
    for (const double value : series->parameters) curve.x.push_back(value / unit);
    if (std::isfinite(series->rate)) {
      curve.name += (curve.name.empty() ? "" : ", ") + fmt::format("rate {:.2f}", series->rate);
    }
    chart.curves.push_back(std::move(curve));
  }
  // Rates of a horizon ratio are those of 1/m, which the axis does not show.
  if (group.front()->axis == "horizon ratio") return chart;
  // Below the lowest curve nothing is in the triangle's way.
  const auto last_error = [](const ConvergenceSeries* series) {
    return std::isnan(series->errors.back()) ? HUGE_VAL : series->errors.back();
  };
  const auto lowest = std::min_element(group.begin(), group.end(),
                                       [&](const auto* a, const auto* b) { return last_error(a) < last_error(b); });
  add_triangle(chart, chart.curves[static_cast<std::size_t>(lowest - group.begin())], (*lowest)->rate);
  return chart;
}

Chart probe_chart(const ReadStudy& read, const StudySummary& summary, std::size_t probe, std::size_t time) {
  Chart chart = titled(read, read.study.times[time]);
  chart.x.label = "horizon ratio m";
  chart.y.label = "temperature at " + read.study.probes[probe].name;
  std::map<std::string, Curve> curves;
  std::vector<std::string> order;
  std::vector<double> references;
  for (const StudyRow& row : summary.rows) {
    if (row.time != time) continue;
    const StudyRun& run = read.runs[row.run];
    std::string name = read.study.variants.size() > 1 ? read.study.variants[run.variant].name + ", " : "";
    name += horizon_name(run.horizon_ratio * run.spacing);
    if (!curves.contains(name)) order.push_back(name);
    Curve& curve = curves[name];
    curve.name = name;
    curve.style = CurveStyle::dots_on_line;
    curve.x.push_back(run.horizon_ratio);
    curve.y.push_back(row.probes[probe]);
    if (std::isfinite(row.references[probe])) references.push_back(row.references[probe]);
  }
  for (const std::string& name : order) chart.curves.push_back(curves[name]);
  if (!references.empty() && !std::holds_alternative<FinestReference>(read.study.reference)) {
    add_references(chart, references);
  }
  return chart;
}

Chart profile_chart(const ReadStudy& read, const StudySummary& summary, const std::vector<std::size_t>& runs,
                    std::size_t time) {
  Chart chart = titled(read, read.study.times[time]);
  const LengthScale scale = body_scale(read);
  chart.x.label = scale.label(read.study.line ? "distance along the line" : "x");
  chart.y.label = "temperature";
  for (const std::size_t n : runs) {
    const Solution& solution = *summary.results[n].solution;
    const Solution* finest = finest_run(read, summary.results, read.runs[n].variant);
    const ComparedTemperatures compared = compare(read, solution, time, finest);
    if (compared.places.empty()) continue;
    const std::vector<double> x = distances(read, compared.places, scale.unit.size);
    chart.curves.push_back({run_name(read.study, read.runs[n]), x, compared.computed, CurveStyle::line, -1});
    if (n != runs.back() || std::holds_alternative<FinestReference>(read.study.reference)) continue;
    chart.curves.push_back({"reference", x, compared.reference, CurveStyle::dashed, 7});
  }
  return chart;
}

Chart crossing_chart(const ReadStudy& read, const IntersectionResult& result) {
  const IntersectionOptions& options = *read.study.intersection;
  const LocatedCrossing& at = result.chosen;
  Chart chart = titled(read, at.time);
  if (read.study.variants.size() > 1) chart.title += ", " + result.variant;
  chart.x.label = "horizon ratio m";
  chart.y.label = "temperature";
  const std::vector<double>& m = options.horizon_ratios;
  const auto [least, most] = std::minmax_element(m.begin(), m.end());
  for (std::size_t h = 0; h < 2; ++h) {
    const std::array<double, 3>& values = h == 0 ? at.first : at.second;
    const int colour = static_cast<int>(h);
    Curve line{horizon_name(options.horizons[h]), {}, {}, CurveStyle::line, colour};
    for (int n = 0; n <= parabola_places; ++n) {
      line.x.push_back(*least + (*most - *least) * n / parabola_places);
      line.y.push_back(parabola_at({m[0], m[1], m[2]}, values, line.x.back()));
    }
    chart.curves.push_back(std::move(line));
    chart.curves.push_back({"", m, {values.begin(), values.end()}, CurveStyle::dots, colour});
  }
  if (at.crossing) {
    chart.curves.push_back({"they cross at m = " + rounded_text(at.crossing->ratio, 4),
                            {at.crossing->ratio},
                            {at.crossing->temperature},
                            CurveStyle::dots,
                            2});
  }
  if (std::isfinite(at.reference)) chart.curves.push_back(level("reference", *least, *most, at.reference));
  return chart;
}

Chart crossings_along_chart(const ReadStudy& read, const StudySummary& summary) {
  return crossings_chart(read, summary, true);
}

Chart crossings_over_time_chart(const ReadStudy& read, const StudySummary& summary) {
  return crossings_chart(read, summary, false);
}

Chart rerun_chart(const ReadStudy& read, const IntersectionResult& result) {
  Chart chart = titled(read, result.chosen.time);
  const LengthScale scale = body_scale(read);
  chart.x.label = scale.label("x");
  chart.y.label = "temperature − reference";
  const auto add = [&](const std::string& name, const RunQuality& run) {
    Curve curve{
        name + ", m = " + rounded_text(run.horizon_ratio, 4), {}, run.differences, CurveStyle::dots_on_line, -1};
    for (const double x : run.x) curve.x.push_back(x / scale.unit.size);
    if (curve.x.size() > 200) curve.style = CurveStyle::line;
    chart.curves.push_back(std::move(curve));
  };
  add("rerun", *result.rerun);
  if (result.single) add("single fine run", *result.single);
  return chart;
}

}  // namespace peritherm
