#include "study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "text.hpp"

namespace peritherm::app {
namespace {

constexpr int name_width = 34;
constexpr int column_width = 11;

std::string figure(double value, const char* format = "{:.4g}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string parameter_text(const std::string& axis, double value) {
  if (axis == "horizon ratio") return fmt::format("{:.4g}", value);
  return quantity(value, axis == "time step" ? "s" : "m");
}

/// Pads by characters on the screen; fmt counts a letter such as δ or µ once as well.
std::string cell(const std::string& text, int width) { return fmt::format("{:>{}}", text, width); }

std::string series_text(const ConvergenceSeries& series) {
  const std::string title = series.quantity + (series.name.empty() ? "" : ", " + series.name);
  std::string text = fmt::format("  {:<{}}", title, name_width);
  for (const double error : series.errors) text += cell(figure(error), column_width);
  text += fmt::format("\n  {:<{}}", "", name_width + column_width);
  for (const double rate : series.rates) text += cell(figure(rate, "{:.2f}"), column_width);
  return text + "   rate " + figure(series.rate, "{:.2f}") + '\n';
}

/// Series of one axis and time, below a heading for each list of parameters.
std::string axis_text(const StudySummary& summary, const std::string& axis, double time) {
  std::string text;
  const ConvergenceSeries* last = nullptr;
  for (const ConvergenceSeries& series : summary.series) {
    if (series.axis != axis || series.time != time) continue;
    if (last == nullptr || last->parameters != series.parameters) {
      text += fmt::format("\nt = {}, by {}\n  {:<{}}", quantity(time, "s"), axis, "", name_width);
      for (const double value : series.parameters) text += cell(parameter_text(axis, value), column_width);
      text += '\n';
    }
    text += series_text(series);
    last = &series;
  }
  return text;
}

/// The last time of every axis; rates.csv has them all.
std::string all_series_text(const ReadStudy& read, const StudySummary& summary) {
  std::string text;
  std::vector<std::string> told;
  for (const ConvergenceSeries& series : summary.series) {
    if (std::find(told.begin(), told.end(), series.axis) != told.end()) continue;
    told.push_back(series.axis);
    text += axis_text(summary, series.axis, read.study.times.back());
  }
  if (!told.empty() && read.study.times.size() > 1) {
    text += fmt::format("\nthe other {} in rates.csv\n", read.study.times.size() == 2 ? "time stands" : "times stand");
  }
  return text;
}

std::string quality_text(const std::string& name, const RunQuality& run) {
  return fmt::format("  {:<24}{:>12}{:>10}{:>12}{:>12}{:>12}{:>12}\n", name, quantity(run.horizon, "m"),
                     figure(run.horizon_ratio), figure(run.points), figure(run.rms), figure(run.maximum),
                     figure(run.at_place));
}

std::string range_text(const std::vector<LocatedCrossing>& list) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  std::size_t count = 0;
  for (const LocatedCrossing& at : list) {
    if (!at.crossing) continue;
    ++count;
    least = std::min(least, at.crossing->ratio);
    most = std::max(most, at.crossing->ratio);
  }
  if (count == 0) return fmt::format("nowhere of {} places", list.size());
  return fmt::format("{:.3f} to {:.3f} ({} of {})", least, most, count, list.size());
}

std::string intersection_text(const ReadStudy& read, const IntersectionResult& result) {
  const std::string of = read.study.variants.size() > 1 ? " of " + result.variant : "";
  std::string text = fmt::format("\nIntersection{} at t = {}: ", of, quantity(result.chosen.time, "s"));
  if (result.chosen.crossing) {
    text += fmt::format("horizon ratio {:.4f}, T = {:.4f} there, reference {:.4f}\n", result.chosen.crossing->ratio,
                        result.chosen.crossing->temperature, result.chosen.reference);
  } else {
    text += "none\n";
  }
  text += "  along x " + range_text(result.along) + "; at the place over time " + range_text(result.over_time) + '\n';
  if (!result.rerun) return text;
  text += fmt::format("  {:<24}{:>12}{:>10}{:>12}{:>12}{:>12}{:>12}\n", "", "horizon", "ratio", "points", "rms error",
                      "max error", "at place");
  text += quality_text("rerun", *result.rerun);
  if (!result.single) return text;
  text += quality_text("single fine run", *result.single);
  text += fmt::format(
      "  the rerun is {:.2f} times as exact (rms); with its six runs it takes {:.2f} of the bonds, {:.2f} of "
      "the bond evaluations\n",
      result.single->rms / result.rerun->rms, result.cost(), result.evaluation_cost());
  return text;
}

}  // namespace

std::string study_heading(const ReadStudy& read) {
  std::string text;
  if (!read.study.title.empty()) text += read.study.title + '\n';
  std::string parts;
  const auto append = [&parts](std::size_t count, const std::string& one, const std::string& many) {
    if (count > 1) parts += (parts.empty() ? ": " : ", ") + counted(count, one, many);
  };
  append(read.study.variants.size(), "variant", "variants");
  append(count_values(read.study.vary, StudyAxis::horizon), "horizon", "horizons");
  append(count_values(read.study.vary, StudyAxis::horizon_ratio), "horizon ratio", "horizon ratios");
  append(count_values(read.study.vary, StudyAxis::spacing), "spacing", "spacings");
  append(count_values(read.study.vary, StudyAxis::time_step), "time step", "time steps");
  if (!read.runs.empty()) text += counted(read.runs.size(), "run", "runs") + parts + '\n';
  if (read.study.intersection) {
    text += counted(6 * read.study.variants.size(), "run", "runs") + " whose m-convergence curves are intersected\n";
  }
  return text;
}

std::string study_text(const ReadStudy& read, const StudySummary& summary, const std::filesystem::path& folder) {
  std::string text = all_series_text(read, summary);
  for (const IntersectionResult& result : summary.intersections) text += intersection_text(read, result);
  text += '\n';
  for (const TimeError& error : summary.time_errors) {
    text += fmt::format("error in time: {} with {} in the run with {} (largest difference)\n",
                        figure(error.difference, "{:.2g}"), error.how, error.run);
  }
  const std::string again = summary.reused > 0 ? fmt::format(", {} of them from before", summary.reused) : "";
  text += fmt::format("{} after {}: {}{}\nwritten to {}:\n", summary.status, duration_text(summary.wall),
                      counted(summary.runs, "run", "runs"), again, path_text(folder));
  for (const std::string& line : summarised_files(summary.files)) text += "  " + line + '\n';
  return text;
}

void StudyDisplay::show(const StudyProgress& progress) {
  if (style_ == ProgressDisplay::Style::silent || progress.runs == 0) return;
  std::string text = fmt::format("{} of {} done", progress.finished, counted(progress.runs, "run", "runs"));
  if (progress.share > 0.0 && progress.share < 1.0) {
    text += ", " + duration_text(progress.wall * (1.0 - progress.share) / progress.share) + " left";
  }
  if (style_ == ProgressDisplay::Style::live) {
    out_ << '\r' << text << "\033[K" << std::flush;
    line_open_ = true;
  } else if (progress.finished > 0) {
    out_ << text << std::endl;
  }
}

void StudyDisplay::close() {
  if (line_open_) out_ << "\r\033[K" << std::flush;
  line_open_ = false;
}

}  // namespace peritherm::app
