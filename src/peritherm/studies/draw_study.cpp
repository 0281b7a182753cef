#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "peritherm/base/file.hpp"
#include "peritherm/output/chart.hpp"
#include "peritherm/output/labels.hpp"
#include "peritherm/studies/run_study.hpp"
#include "peritherm/studies/study_charts.hpp"
#include "peritherm/studies/study_errors.hpp"

namespace peritherm {
namespace {

constexpr int picture_width = 1000;  // Pixels.
constexpr std::size_t most_profiles = 6;

/// "horizon ratio" → "horizon_ratio": letters and digits of a name, fit for a file.
std::string file_word(const std::string& name) {
  std::string word;
  for (const char letter : name) {
    const bool plain =
        (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
    if (plain || letter == '-') word += letter;
    if (!plain && letter != '-' && !word.empty() && word.back() != '_') word += '_';
  }
  return word;
}

bool shows_anything(const Chart& chart) {
  const double least = chart.y.scale == AxisScale::logarithmic ? 0.0 : -HUGE_VAL;
  return std::any_of(chart.curves.begin(), chart.curves.end(), [least](const Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(), [least](double y) { return y > least && std::isfinite(y); });
  });
}

/// Saves charts under names that differ.
class Portfolio {
 public:
  Portfolio(std::filesystem::path folder, std::vector<std::filesystem::path>& files)
      : folder_(std::move(folder)), files_(files) {}

  void save(const Chart& chart, const std::string& name) {
    if (!shows_anything(chart)) return;
    if (files_of_mine_++ == 0) make_folder(folder_);
    std::string stem = file_word(name);
    for (int copy = 2; !taken_.insert(stem).second; ++copy) stem = file_word(name) + "-" + std::to_string(copy);
    save_chart(chart, picture_width, folder_ / (stem + ".png"));
    files_.push_back(folder_ / (stem + ".png"));
  }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path>& files_;
  std::set<std::string> taken_;
  int files_of_mine_ = 0;
};

std::string time_word(const ReadStudy& read, double time) {
  return read.study.times.size() > 1 ? " " + time_text(time).substr(4) : "";
}

void draw_errors(const ReadStudy& read, const StudySummary& summary, Portfolio& portfolio) {
  std::map<std::tuple<std::string, std::string, double>, std::vector<const ConvergenceSeries*>> groups;
  for (const ConvergenceSeries& series : summary.series) {
    groups[{series.axis, series.quantity, series.time}].push_back(&series);
  }
  for (const auto& [key, group] : groups) {
    const auto& [axis, quantity, time] = key;
    portfolio.save(error_chart(read, group), "error " + quantity + " by " + axis + time_word(read, time));
  }
}

void draw_m_curves(const ReadStudy& read, const StudySummary& summary, Portfolio& portfolio) {
  if (count_values(read.study.vary, StudyAxis::horizon_ratio) < 2) return;
  for (std::size_t p = 0; p < read.study.probes.size(); ++p) {
    for (std::size_t t = 0; t < read.study.times.size(); ++t) {
      portfolio.save(probe_chart(read, summary, p, t), "temperature " + read.study.probes[p].name +
                                                           " by horizon ratio" + time_word(read, read.study.times[t]));
    }
  }
}

/// Along a bar or the line of the study: a few runs from the coarsest to the finest, and the reference.
void draw_profiles(const ReadStudy& read, const StudySummary& summary, Portfolio& portfolio) {
  const bool is_bar = read.cases.front().body.size.size() == 1;
  if (read.runs.empty() || (!is_bar && !read.study.line)) return;
  std::vector<std::size_t> runs;
  const std::size_t step = std::max<std::size_t>(1, (read.runs.size() + most_profiles - 1) / most_profiles);
  for (std::size_t n = 0; n < read.runs.size(); n += step) {
    if (summary.results[n].solution) runs.push_back(n);
  }
  for (std::size_t t = 0; t < read.study.times.size(); ++t) {
    portfolio.save(profile_chart(read, summary, runs, t), "temperatures" + time_word(read, read.study.times[t]));
  }
}

void draw_intersections(const ReadStudy& read, const StudySummary& summary, Portfolio& portfolio) {
  for (const IntersectionResult& result : summary.intersections) {
    const std::string of = read.study.variants.size() > 1 ? " " + result.variant : "";
    portfolio.save(crossing_chart(read, result), "intersection" + of);
    if (result.rerun) portfolio.save(rerun_chart(read, result), "rerun errors" + of);
  }
  if (summary.intersections.empty()) return;
  portfolio.save(crossings_along_chart(read, summary), "intersecting ratio along x");
  if (read.study.times.size() > 1)
    portfolio.save(crossings_over_time_chart(read, summary), "intersecting ratio over time");
}

}  // namespace

void draw_study(const ReadStudy& read, const std::filesystem::path& folder, StudySummary& summary) {
  Portfolio portfolio(folder / "pictures", summary.files);
  draw_errors(read, summary, portfolio);
  draw_m_curves(read, summary, portfolio);
  draw_profiles(read, summary, portfolio);
  draw_intersections(read, summary, portfolio);
}

}  // namespace peritherm
