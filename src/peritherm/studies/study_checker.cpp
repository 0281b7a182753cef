#include "peritherm/studies/study_checker.hpp"

#include <algorithm>
#include <set>

#include "peritherm/base/text.hpp"
#include "peritherm/geometry/coordinates.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/locations.hpp"
#include "peritherm/simulation/overrides.hpp"

namespace peritherm {
namespace {

template <class Value>
void refuse_doubles(StudyChecker& checker, const std::string& key, const std::vector<Value>& values) {
  std::set<Value> seen;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!seen.insert(values[i]).second) checker.add(join_path(key, i), "stands in the list twice", "Leave one out");
  }
}

void check_axes(StudyChecker& checker) {
  const StudyAxes& axes = checker.read.study.vary;
  if (!checker.sound("vary")) return;
  refuse_doubles(checker, "vary.horizon", axes.horizons);
  refuse_doubles(checker, "vary.horizon_ratio", axes.horizon_ratios);
  refuse_doubles(checker, "vary.spacing", axes.spacings);
  refuse_doubles(checker, "vary.cells", axes.cells);
  refuse_doubles(checker, "vary.time_step", axes.time_steps);
  if (!axes.spacings.empty() && !axes.cells.empty())
    checker.add("vary", "has both spacing and cells", "Keep one of them");
  if (!axes.horizons.empty() && !axes.horizon_ratios.empty() && count_values(axes, StudyAxis::spacing) > 0) {
    checker.add("vary", "has horizon, horizon_ratio and spacing or cells, of which two give the third",
                "Leave one of them out");
  }
  std::size_t most = 0;
  for (const StudyAxis axis : study_axes) most = std::max(most, count_values(axes, axis));
  if (most < 2 && !checker.read.study.intersection && checker.sound("intersection")) {
    checker.add("vary", "has no list of two or more values, so there is nothing to compare",
                "Give two or more values of horizon, horizon_ratio, spacing, cells or time_step, or an [intersection]");
  }
}

void check_names(StudyChecker& checker) {
  const auto check_list = [&checker](const std::string& list, const auto& entries) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::string key = join_path(list, i) + ".name";
      if (!checker.sound(key)) continue;
      if (entries[i].name.empty()) checker.add(key, "is empty", "Give it a name");
      if (!seen.insert(entries[i].name).second) checker.add(key, "stands there twice", "Give each its own name");
    }
  };
  check_list("variant", checker.read.study.variants);
  check_list("probe", checker.read.study.probes);
}

void sort_times(StudyChecker& checker) {
  std::vector<double>& times = checker.read.study.times;
  refuse_doubles(checker, "times", times);
  const auto& intersection = checker.read.study.intersection;
  if (intersection && checker.sound("intersection.time")) times.push_back(intersection->time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

/// The study's own name for a key that it set: "set.0" or "variant.1.set.0"; empty if it did not.
std::string key_of_override(const Study& study, std::size_t variant, const std::string& file) {
  for (std::size_t i = 0; i < study.variants[variant].set.size(); ++i) {
    if (name_of_override(study.variants[variant].set[i]) == file) {
      return "variant." + std::to_string(variant) + ".set." + std::to_string(i);
    }
  }
  for (std::size_t i = 0; i < study.set.size(); ++i) {
    if (name_of_override(study.set[i]) == file) return "set." + std::to_string(i);
  }
  return {};
}

void add_case_issues(StudyChecker& checker, std::size_t variant, const std::vector<Issue>& found) {
  for (Issue issue : found) {
    const std::string own = key_of_override(checker.read.study, variant, issue.where.file);
    if (!own.empty()) {
      checker.add(own, (issue.where.key.empty() ? "" : issue.where.key + ": ") + issue.problem, issue.hint);
    } else if (issue.where.file.empty()) {
      checker.add("case", issue.problem, issue.hint);
    } else {
      const bool known = std::any_of(checker.issues.begin(), checker.issues.end(),
                                     [&issue](const Issue& other) { return to_string(other) == to_string(issue); });
      if (!known) checker.issues.push_back(std::move(issue));
    }
  }
}

/// A steady state has no times: it would stand in the tables again and again.
void check_steady_times(StudyChecker& checker) {
  if (!checker.sound("times")) return;
  const std::vector<double>& times = checker.read.study.times;
  if (std::count_if(times.begin(), times.end(), [](double time) { return time > 0.0; }) < 2) return;
  for (const Problem& problem : checker.read.cases) {
    if (!std::holds_alternative<SteadyState>(problem.time.integrator)) continue;
    return checker.add("times", "has several, but the case's integrator 'steady' has one answer for all of them",
                       "Keep one time, or choose another integrator");
  }
}

}  // namespace

bool StudyChecker::sound(std::string_view key) const {
  return std::none_of(broken.begin(), broken.end(), [key](const std::string& other) { return keys_touch(key, other); });
}

void StudyChecker::add(const std::string& key, std::string problem, std::string hint) {
  issues.push_back({find_location(locations, key), std::move(problem), std::move(hint)});
}

void StudyChecker::add_fault(const std::string& key, const std::string& fault) {
  if (fault.empty()) return;
  const auto end = fault.find(". ");
  add(key, fault.substr(0, end), end == std::string::npos ? "" : fault.substr(end + 2));
}

void check_study_lists(StudyChecker& checker) {
  check_axes(checker);
  check_names(checker);
  sort_times(checker);
  Study& study = checker.read.study;
  if (checker.sound("norms")) {
    refuse_doubles(checker, "norms", study.norms);
    if (study.norms.empty()) checker.add("norms", "is empty", "Name at least one, or leave it out");
  }
  if (study.variants.empty()) study.variants.push_back({"case", {}});
}

void read_study_cases(StudyChecker& checker) {
  const Study& study = checker.read.study;
  if (!checker.sound("case") || !checker.sound("set") || !checker.sound("variant")) return;
  const std::string path = (checker.folder / study.case_file).string();
  std::vector<Problem> cases;
  for (std::size_t v = 0; v < study.variants.size(); ++v) {
    std::vector<std::string> overrides = study.set;
    overrides.insert(overrides.end(), study.variants[v].set.begin(), study.variants[v].set.end());
    try {
      ReadCase read = read_case_file(path, overrides);
      cases.push_back(std::move(read.problem));
      checker.case_locations.push_back(std::move(read.locations));
    } catch (const Error& error) {
      add_case_issues(checker, v, error.issues());
      if (error.fault() == Fault::machine) break;  // The file is missing, for every variant.
    }
  }
  if (cases.size() != study.variants.size()) return;
  checker.read.cases = std::move(cases);
  if (checker.read.study.times.empty() && checker.sound("times")) {
    checker.read.study.times.push_back(checker.read.cases.front().time.end);
  }
  check_steady_times(checker);
  for (const Problem& problem : checker.read.cases) {
    if (problem.body.size.size() == checker.read.cases.front().body.size.size()) continue;
    checker.add("variant", "the variants differ in their dimension", "Make a study for each");
  }
}

}  // namespace peritherm
