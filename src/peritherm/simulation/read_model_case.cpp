#include <algorithm>
#include <cmath>
#include <regex>

#include "peritherm/base/text.hpp"
#include "peritherm/reduction/model_file.hpp"
#include "peritherm/simulation/displacement_series.hpp"
#include "peritherm/simulation/document.hpp"
#include "peritherm/simulation/locations.hpp"
#include "peritherm/simulation/model_case.hpp"
#include "peritherm/simulation/overrides.hpp"
#include "peritherm/simulation/schedule.hpp"

namespace peritherm {
namespace {

/// May the key be set without making another model?
bool is_question(const std::string& key) {
  static const std::regex known(
      R"((boundary\.[0-9]+\.(value|ambient)|source\.[0-9]+\.value|initial\.temperature|time\.end|title|numerics\.threads|output(\..*)?))");
  return std::regex_match(key, known);
}

/// The overrides that are questions; those of what is built in become issues.
std::vector<std::string> take_questions(const std::string& case_text, const std::vector<std::string>& overrides,
                                        std::vector<Issue>& issues) {
  std::vector<std::string> questions;
  toml::table root = toml::parse(case_text);
  for (const std::string& text : overrides) {
    std::vector<Issue> ignored;  // Reading the case tells what cannot be put in.
    const std::vector<AppliedOverride> applied = apply_overrides(root, {text}, ignored);
    if (applied.empty() || is_question(applied.front().key)) {
      questions.push_back(text);
      continue;
    }
    issues.push_back({{name_of_override(text), applied.front().key, 0, 0},
                      "the model was built with it",
                      "Reduce the case again with it. A model answers for values of boundaries and sources, "
                      "initial.temperature, time.end and output"});
  }
  return questions;
}

/// The model's own case with what is asked. Throws Error with `issues` and all that is wrong besides.
ReadCase read_question(const std::string& case_text, const std::string& file,
                       const std::vector<std::string>& overrides) {
  std::vector<Issue> issues;
  const std::vector<std::string> questions = take_questions(case_text, overrides, issues);
  ReadCase read;
  try {
    read = read_case(case_text, file, questions, CaseUse::answer);
  } catch (const Error& error) {
    issues.insert(issues.end(), error.issues().begin(), error.issues().end());
  }
  if (!issues.empty()) throw Error(std::move(issues));
  return read;
}

/// No crack grows for longer than this takes its tip [m].
double longest_growth(const Crack& crack) {
  if (crack.disc) return crack.disc->radius;
  double length = 0.0;
  for (std::size_t n = 1; n < crack.points.size(); ++n) {
    const Point from = to_point(crack.points[n - 1]), to = to_point(crack.points[n]);
    length += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  }
  return length;
}

/// Cracks and broken bonds that a model cannot know, since they come after the last time that it was built for.
std::vector<Issue> find_unknown_changes(const ReducedModel& model, const Problem& problem, const Locations& locations) {
  std::vector<Issue> issues;
  const double last = model.longest_time, end = problem.time.end;
  if (end <= last * (1.0 + 1e-12)) return issues;
  const auto add = [&](const std::string& what) {
    issues.push_back({find_location(locations, "time.end"),
                      what + " after " + shortest(last) + " s, the last time that the model was built for",
                      "Choose an end of at most " + shortest(last) + " s, or reduce the case again with this end"});
  };
  for (std::size_t n = 0; n < problem.cracks.size(); ++n) {
    const Crack& crack = problem.cracks[n];
    const std::string name = "crack " + std::to_string(n);
    if (crack.start_time >= last && crack.start_time < end) {
      add(name + " appears");
    } else if (crack.tip_speed && crack.start_time + longest_growth(crack) / *crack.tip_speed > last) {
      add(name + " may still grow");
    }
  }
  const auto& damage = problem.damage;
  if (damage && (damage->table || (damage->displacement && depends_on_time(*damage->displacement)))) {
    add("bonds may still break");
  }
  return issues;
}

std::vector<std::string> find_warnings(const ReducedModel& model, const Problem& problem) {
  std::vector<std::string> warnings;
  if (problem.time.end > model.longest_time * (1.0 + 1e-12)) {
    warnings.push_back("the model was built for " + shortest(model.longest_time) + " s, and the end is " +
                       shortest(problem.time.end) + " s; look at its estimated error");
  }
  const double first = march_times(problem).front();
  if (first < model.shortest_time * (1.0 - 1e-12)) {
    warnings.push_back("the model was built for times from " + shortest(model.shortest_time) +
                       " s after a jump on, and the first answer is for " + shortest(first) +
                       " s; look at its estimated error");
  }
  return warnings;
}

}  // namespace

ModelCase make_model_case(ReducedModel model, const std::filesystem::path& file,
                          const std::vector<std::string>& overrides) {
  ModelCase made;
  made.file = file;
  made.model = std::move(model);
  ReadCase inside = read_question(made.model.case_text, file.string() + ", its case", overrides);
  made.problem = std::move(inside.problem);
  made.locations = std::move(inside.locations);
  std::vector<Issue> unknown = find_unknown_changes(made.model, made.problem, made.locations);
  if (!unknown.empty()) throw Error(std::move(unknown));
  made.warnings = find_warnings(made.model, made.problem);
  return made;
}

ModelCase read_model_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return make_model_case(read_model(file), file, overrides);
}

}  // namespace peritherm
