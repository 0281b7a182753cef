#include <algorithm>
#include <cmath>

#include "peritherm/base/text.hpp"
#include "peritherm/geometry/coordinates.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/locations.hpp"
#include "peritherm/studies/field_file.hpp"
#include "peritherm/studies/intersection.hpp"
#include "peritherm/studies/study_checker.hpp"
#include "peritherm/studies/study_errors.hpp"

namespace peritherm {
namespace {

bool inside_body(const Grid& grid, const Point& place) {
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double depth = place[axis] - grid.origin[axis];
    if (depth < -1e-9 * grid.length(axis) || depth > (1.0 + 1e-9) * grid.length(axis)) return false;
  }
  return true;
}

void check_place(StudyChecker& checker, const std::string& key, const Coordinates& place) {
  if (!checker.sound(key)) return;
  const Grid grid = make_grid(checker.read.cases.front());
  const std::string fault = find_fault("the place", place, grid.dimension);
  if (!fault.empty()) return checker.add_fault(key, fault);
  if (!inside_body(grid, to_point(place))) {
    std::vector<std::string> sizes;
    for (int axis = 0; axis < grid.dimension; ++axis) {
      sizes.push_back(shortest(grid.origin[axis]) + " to " + shortest(grid.origin[axis] + grid.length(axis)) + " m");
    }
    checker.add(key, "lies outside of the body", "The body reaches from " + join(sizes, ", and from "));
  }
}

void check_line(StudyChecker& checker) {
  const Study& study = checker.read.study;
  if (!study.line || !checker.sound("line")) return;
  if (study.where) checker.add("line", "stands beside where", "Keep one of them");
  check_place(checker, "line.from", study.line->from);
  check_place(checker, "line.to", study.line->to);
  if (study.line->from == study.line->to) checker.add("line", "begins where it ends", "Give two different ends");
}

void check_table(StudyChecker& checker, const ResultsReference& reference) {
  const std::string key = "reference.file";
  const Grid grid = make_grid(checker.read.cases.front());
  try {
    const std::string path = (checker.folder / reference.file).string();
    checker.read.table = path.ends_with(".vti") ? read_field_file(path) : read_result_table(path, grid.dimension);
  } catch (const Error& error) {
    return checker.add(key, error.issues().front().problem, error.issues().front().hint);
  }
  const ResultTable& table = *checker.read.table;
  for (const ResultTable::Moment& moment : table.moments) {
    for (const Point& place : moment.places) {
      if (inside_body(grid, place)) continue;
      return checker.add(key, "holds a place at x = " + shortest(place[0]) + " m outside of the body",
                         "Give a file of the same body, in metres");
    }
  }
  if (!table.timed && checker.read.study.times.size() > 1) {
    return checker.add(key,
                       "has no column t, but the study has " + count_of(checker.read.study.times.size()) + " in times",
                       "Add a column t [s], or keep one time");
  }
  for (const double time : checker.read.study.times) {
    if (table.find(time) != nullptr) continue;
    std::vector<std::string> known;
    for (const auto& moment : table.moments) known.push_back(shortest(moment.time));
    checker.add(key, "has nothing for t = " + shortest(time) + " s", "It holds t = " + join(known) + " s");
  }
}

void check_exact(StudyChecker& checker, const ExactReference& reference) {
  const Grid grid = make_grid(checker.read.cases.front());
  Point middle = grid.origin;
  for (int axis = 0; axis < grid.dimension; ++axis) middle[axis] += 0.5 * grid.length(axis);
  const bool has_horizon = std::visit(
      [](const auto& chosen) {
        return requires { chosen.horizon; };
      },
      reference.solution);
  if (reference.horizon_of_run && !has_horizon) {
    checker.add("reference.horizon_of_run", "asks for a solution that has a horizon", "Leave it out");
  }
  const std::string fault = find_fault(reference.solution, grid.dimension);
  if (!fault.empty()) return checker.add_fault("reference.solution", fault);
  try {
    checker.read.exact = make_temperature(reference.solution);
    for (const double time : checker.read.study.times) checker.read.exact(middle, time);
  } catch (const Error& error) {
    checker.add("reference.solution", error.issues().front().problem, error.issues().front().hint);
  }
}

/// What one run of the product takes from the lists.
RunChoice choice_of(const StudyAxes& axes, const std::array<int, 4>& entries) {
  const auto pick = [](const auto& values, int entry) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    return values.empty() || entry < 0 ? std::optional<Value>{}
                                       : std::optional<Value>{values[static_cast<std::size_t>(entry)]};
  };
  return {pick(axes.horizons, entries[0]), pick(axes.horizon_ratios, entries[1]), pick(axes.spacings, entries[2]),
          pick(axes.cells, entries[2]), pick(axes.time_steps, entries[3])};
}

/// Key of the study that is to blame for a fault of a run; empty: the case's own.
std::string blamed_key(const StudyAxes& axes, const std::array<int, 4>& entries, const std::string& key) {
  const auto named = [&](StudyAxis axis, const std::string& name) {
    const int entry = entries[static_cast<std::size_t>(axis)];
    return entry < 0 ? std::string{} : join_path("vary." + name, static_cast<std::size_t>(entry));
  };
  const bool about_ratio = keys_touch(key, "nonlocality");
  const bool about_grid = keys_touch(key, "body.cells") || keys_touch(key, "body.spacing");
  std::vector<std::string> candidates;
  if (about_ratio)
    candidates = {named(StudyAxis::horizon_ratio, "horizon_ratio"), named(StudyAxis::horizon, "horizon")};
  if (about_grid) candidates = {named(StudyAxis::horizon, "horizon")};
  if (about_ratio || about_grid) {
    candidates.push_back(named(StudyAxis::spacing, axes.cells.empty() ? "spacing" : "cells"));
  }
  if (about_grid) candidates.push_back(named(StudyAxis::horizon_ratio, "horizon_ratio"));
  if (keys_touch(key, "time")) candidates = {named(StudyAxis::time_step, "time_step")};
  const auto found = std::find_if(candidates.begin(), candidates.end(), [](const auto& text) { return !text.empty(); });
  return found == candidates.end() ? "" : *found;
}

/// `blame(key)` names the key of the study that makes the case's own key faulty; empty: none does.
template <class Blame>
void add_run_issues(StudyChecker& checker, const std::vector<Issue>& faults, const Blame& blame) {
  for (Issue issue : faults) {
    const std::string blamed = blame(issue.where.key);
    if (!blamed.empty()) {
      issue.problem = "makes a case that cannot run: " + issue.where.key + ": " + issue.problem;
      issue.where = find_location(checker.locations, blamed);
    }
    const bool known = std::any_of(checker.issues.begin(), checker.issues.end(),
                                   [&issue](const Issue& other) { return to_string(other) == to_string(issue); });
    if (!known) checker.issues.push_back(std::move(issue));
  }
}

std::vector<Issue> faults_of_choice(const StudyChecker& checker, std::size_t variant, const RunChoice& choice) {
  const Study& study = checker.read.study;
  const Problem& base = checker.read.cases[variant];
  const Locations& locations = checker.case_locations[variant];
  if (makes_too_many_cells(base, choice)) {
    return {{find_location(locations, "body.cells"), "makes more than 1e9 cells along an axis", "Choose fewer cells"}};
  }
  return find_faults(apply_choice(base, choice, study.tolerance, study.times.back()), locations);
}

void make_run(StudyChecker& checker, std::size_t variant, const std::array<int, 4>& entries) {
  const Study& study = checker.read.study;
  const RunChoice choice = choice_of(study.vary, entries);
  const std::vector<Issue> faults = faults_of_choice(checker, variant, choice);
  if (!faults.empty()) {
    return add_run_issues(checker, faults,
                          [&](const std::string& key) { return blamed_key(study.vary, entries, key); });
  }
  StudyRun run =
      describe_run(apply_choice(checker.read.cases[variant], choice, study.tolerance, study.times.back()), variant);
  run.entries = entries;
  checker.read.runs.push_back(std::move(run));
}

/// Calls visit(entries) for every combination, the last axis fastest.
template <class Visit>
void for_each_combination(const StudyAxes& axes, const Visit& visit) {
  std::array<int, 4> entries{}, counts{};
  for (std::size_t a = 0; a < 4; ++a) {
    counts[a] = static_cast<int>(count_values(axes, study_axes[a]));
    entries[a] = counts[a] == 0 ? -1 : 0;
  }
  while (true) {
    visit(entries);
    std::size_t axis = 4;
    while (axis > 0) {
      --axis;
      if (counts[axis] == 0) continue;
      if (++entries[axis] < counts[axis]) break;
      entries[axis] = 0;
      if (axis == 0) return;
    }
    if (std::all_of(entries.begin(), entries.end(), [](int entry) { return entry <= 0; })) return;
  }
}

/// Key of the intersection that is to blame for a fault of one of its runs.
std::string blamed_intersection_key(const IntersectionOptions& options, double shortest_side, std::size_t run,
                                    const std::string& key) {
  const bool is_single = run >= 6;
  const double horizon = is_single ? options.single->horizon : options.horizons[run / 3];
  const double ratio = is_single ? options.single->horizon_ratio : options.horizon_ratios[run % 3];
  const std::string horizon_key =
      is_single ? "intersection.single.horizon" : join_path("intersection.horizon", run / 3);
  const std::string ratio_key =
      is_single ? "intersection.single.horizon_ratio" : join_path("intersection.horizon_ratio", run % 3);
  if (keys_touch(key, "body.cells")) return horizon_key;
  // What reaches through the whole body is too large a horizon; else too few neighbours make the fault.
  const bool too_large = horizon + 1.5 * horizon / ratio > shortest_side;
  return keys_touch(key, "nonlocality") ? (too_large ? horizon_key : ratio_key) : "";
}

void check_intersection_runs(StudyChecker& checker) {
  const IntersectionOptions& options = *checker.read.study.intersection;
  const std::vector<RunChoice> choices = intersection_choices(options);
  for (std::size_t v = 0; v < checker.read.cases.size(); ++v) {
    const Coordinates& size = checker.read.cases[v].body.size;
    const double shortest_side = *std::min_element(size.begin(), size.end());
    for (std::size_t run = 0; run < choices.size(); ++run) {
      std::vector<Issue> faults = faults_of_choice(checker, v, choices[run]);
      const auto blame = [&](const std::string& key) {
        return blamed_intersection_key(options, shortest_side, run, key);
      };
      for (Issue& fault : faults) {
        // The case's own advice is about the ratio.
        if (blame(fault.where.key).find(".horizon_ratio") == std::string::npos && !blame(fault.where.key).empty()) {
          fault.hint = "Choose another horizon";
        }
      }
      add_run_issues(checker, faults, blame);
    }
  }
}

/// Places whose temperature is compared with that of a table must be places of it.
void check_place_of_table(StudyChecker& checker, const std::string& key, const Coordinates& place) {
  if (!checker.sound(key) || place.size() != checker.read.cases.front().body.size.size()) return;
  for (const double time : checker.read.study.times) {
    const ResultTable::Moment* moment = checker.read.table->find(time);
    if (moment == nullptr || moment->temperature_at(to_point(place), slack_of_places(checker.read))) continue;
    return checker.add(key, "is no place of the table of results at t = " + shortest(time) + " s",
                       "Choose a place that the table holds, or leave it out");
  }
}

void check_places_of_table(StudyChecker& checker) {
  const Study& study = checker.read.study;
  for (std::size_t i = 0; i < study.probes.size(); ++i) {
    check_place_of_table(checker, join_path("probe", i) + ".at", study.probes[i].at);
  }
  if (study.intersection) check_place_of_table(checker, "intersection.at", study.intersection->at);
}

bool takes_steps(StudyChecker& checker) {
  const StudyAxes& axes = checker.read.study.vary;
  if (axes.time_steps.empty()) return true;
  for (std::size_t v = 0; v < checker.read.cases.size(); ++v) {
    if (takes_a_step(checker.read.cases[v].time.integrator)) continue;
    const std::string_view name =
        std::visit([](const auto& options) { return options.name; }, checker.read.cases[v].time.integrator);
    checker.add("vary.time_step", "the case's integrator '" + std::string(name) + "' has no fixed step",
                "Choose euler or rk4, for instance by set = [\"time.integrator=rk4\"]");
    return false;
  }
  return true;
}

}  // namespace

void check_study_places(StudyChecker& checker) {
  if (!checker.has_case()) return;
  const Study& study = checker.read.study;
  const int dimension = make_grid(checker.read.cases.front()).dimension;
  if (study.where && checker.sound("where")) checker.add_fault("where", find_fault(*study.where, dimension));
  check_line(checker);
  for (std::size_t i = 0; i < study.probes.size(); ++i) {
    check_place(checker, join_path("probe", i) + ".at", study.probes[i].at);
  }
}

void check_study_reference(StudyChecker& checker) {
  if (!checker.has_case() || !checker.sound("reference")) return;
  const StudyReference& reference = checker.read.study.reference;
  if (const auto* results = std::get_if<ResultsReference>(&reference)) check_table(checker, *results);
  if (checker.read.table) check_places_of_table(checker);
  if (const auto* exact = std::get_if<ExactReference>(&reference)) check_exact(checker, *exact);
  if (std::holds_alternative<ResultsReference>(reference) && checker.read.study.line) {
    checker.add("line", "stands beside a table of results, at whose places errors are taken", "Leave it out");
  }
}

void check_intersection(StudyChecker& checker) {
  const auto& intersection = checker.read.study.intersection;
  if (!intersection || !checker.sound("intersection")) return;
  const auto check_count = [&checker](const std::string& key, const std::vector<double>& values, std::size_t wanted) {
    if (values.size() != wanted) {
      checker.add(key, "has " + count_of(values.size()), "Give " + std::to_string(wanted) + " different ones");
    } else if (std::vector sorted = values; std::sort(sorted.begin(), sorted.end()),
                                            std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      checker.add(key, "holds a value twice", "Give " + std::to_string(wanted) + " different ones");
    }
  };
  const std::size_t issues_before = checker.issues.size();
  check_count("intersection.horizon", intersection->horizons, 2);
  check_count("intersection.horizon_ratio", intersection->horizon_ratios, 3);
  if (checker.has_case() && checker.sound("times") && checker.issues.size() == issues_before) {
    check_intersection_runs(checker);
  }
  if (checker.has_case()) check_place(checker, "intersection.at", intersection->at);
  if (checker.sound("reference") && std::holds_alternative<FinestReference>(checker.read.study.reference)) {
    checker.add("intersection", "asks for a reference that does not come from the runs themselves",
                "Choose reference = { type = \"exact\", … } or { type = \"results\", … }");
  }
}

void make_study_runs(StudyChecker& checker) {
  const Study& study = checker.read.study;
  if (!checker.has_case() || !checker.sound("vary") || !checker.sound("times") || study.times.empty()) return;
  if (!takes_steps(checker)) return;
  const StudyAxes& axes = study.vary;
  if (!axes.horizons.empty() && !axes.horizon_ratios.empty() && count_values(axes, StudyAxis::spacing) > 0) return;
  if (axes == StudyAxes{}) return;
  for (std::size_t v = 0; v < checker.read.cases.size(); ++v) {
    for_each_combination(axes, [&checker, v](const std::array<int, 4>& entries) { make_run(checker, v, entries); });
  }
}

void check_where_of_runs(StudyChecker& checker) {
  const ReadStudy& read = checker.read;
  // Other faults keep runs and tables from being there.
  if (!read.study.where || !checker.issues.empty()) return;
  const auto compares = [&read](const StudyRun& run) { return has_places(read, make_grid(run.problem)); };
  if (std::any_of(read.runs.begin(), read.runs.end(), compares)) return;
  for (std::size_t v = 0; read.study.intersection && v < read.cases.size(); ++v) {
    const std::vector<StudyRun> runs = intersection_runs(read, v);
    if (std::any_of(runs.begin(), runs.end(), compares)) return;
  }
  checker.add("where", "holds no place at which any run is compared",
              "Move the shape into the body, or make it larger");
}

}  // namespace peritherm
