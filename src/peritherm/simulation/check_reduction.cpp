#include <algorithm>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/displacement_series.hpp"

namespace peritherm {
namespace {

const std::string retained_key = "reduction.retained";

void check_every(Checker& checker, const std::vector<int>& every) {
  const std::string key = retained_key + ".every";
  if (!checker.sound(key)) return;
  if (every.empty()) {
    return checker.add(key, "is empty, so it retains no point", "Give one number, or one per axis: every = [2, 2]");
  }
  const Grid& grid = *checker.grid;
  if (every.size() != 1 && every.size() != static_cast<std::size_t>(grid.dimension)) {
    return checker.add(key,
                       "has " + count_of(every.size()) + ", but the body is " + std::to_string(grid.dimension) + "-D",
                       "Give one number, or one per axis");
  }
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const auto number = std::min<std::size_t>(static_cast<std::size_t>(axis), every.size() - 1);
    if (every[number] < 1) {
      checker.add(entry(key, number), "must be positive", "Got " + std::to_string(every[number]));
    } else if (!checker.grid_stands_in && every[number] >= grid.count(axis)) {
      checker.add(entry(key, number),
                  "every " + std::to_string(every[number]) + "th point along " + "xyz"[axis] + " is too few, for the " +
                      "body has " + std::to_string(grid.count(axis)) + " there",
                  "Choose a smaller number");
    }
    if (every.size() == 1) break;
  }
}

void check_retained_region(Checker& checker, const std::string& key, const RetainedRegion& region) {
  if (checker.sound(key + ".every") && region.every < 1) {
    checker.add(key + ".every", "must be positive", "Got " + std::to_string(region.every));
  }
  if (!checker.sound(key + ".shape")) return;
  const Grid& grid = *checker.grid;
  if (!checker.accept(key + ".shape", find_fault(region.shape, grid.dimension)) || grid.size() > largest_search) return;
  const double slack = checker.search_slack();
  const bool reaches =
      any_point(grid, [&region, slack](const Point& place) { return contains(region.shape, place, slack); });
  if (!reaches) checker.add(key + ".shape", "contains no point of the body", "Move or enlarge it");
}

void check_retained_place(Checker& checker, const std::string& key, const Coordinates& place) {
  if (!checker.sound(key)) return;
  const Grid& grid = *checker.grid;
  if (place.size() != static_cast<std::size_t>(grid.dimension)) {
    checker.add(key, "has " + count_of(place.size()) + ", but the body is " + std::to_string(grid.dimension) + "-D",
                "Give one coordinate per dimension");
  } else if (!in_box(grid, to_point(place))) {
    checker.add(key, "is outside the body", box_text(grid));
  } else if (regions_are_sound(checker) && is_void(checker.problem, to_point(place), slack_of(grid))) {
    checker.add(key, "is in a part that is cut away", "Move it into the body");
  }
}

void check_share(Checker& checker, double share) {
  const std::string key = retained_key + ".share";
  if (!checker.sound(key)) return;
  if (!zero_to_one.holds(share)) return checker.add(key, "must lie between 0 and 1", "Got " + shortest(share));
  const auto points = static_cast<double>(checker.grid->size());
  if (checker.grid_stands_in || share * points >= 1.0) return;
  checker.add(key, "is less than one point of " + std::to_string(checker.grid->size()) + ", so it retains none",
              "Choose a larger share, e.g. 0.1");
}

void check_retained(Checker& checker, const RetainedPoints& retained) {
  if (!checker.grid) return;
  if (retained.every) check_every(checker, *retained.every);
  for (std::size_t i = 0; i < retained.regions.size(); ++i) {
    check_retained_region(checker, entry(retained_key + ".region", i), retained.regions[i]);
  }
  for (std::size_t i = 0; i < retained.points.size(); ++i) {
    check_retained_place(checker, entry(retained_key + ".points", i), retained.points[i]);
  }
  if (retained.share) check_share(checker, *retained.share);
}

void check_shortest_time(Checker& checker, const std::optional<double>& time) {
  const std::string key = "reduction.shortest_time";
  if (!time || !checker.sound(key)) return;
  if (!positive.holds(*time)) return checker.add(key, "must be positive", "Got " + shortest(*time) + " s");
  if (!checker.sound("time.end") || *time < checker.problem.time.end) return;
  checker.add(key, "is not before the end of the run",
              "Choose a time below time.end, " + shortest(checker.problem.time.end) + " s, or leave it out");
}

void check_shifts(Checker& checker, const std::optional<std::vector<double>>& shifts) {
  const std::string key = "reduction.shifts";
  if (!shifts || !checker.sound(key)) return;
  if (shifts->empty()) checker.add(key, "is empty", "Give at least one rate, or leave it out");
  for (std::size_t i = 0; i < shifts->size(); ++i) {
    if (!positive.holds((*shifts)[i])) {
      checker.add(entry(key, i), "must be positive", "Got " + shortest((*shifts)[i]) + " 1/s");
    } else if (std::find(shifts->begin(), shifts->begin() + static_cast<std::ptrdiff_t>(i), (*shifts)[i]) !=
               shifts->begin() + static_cast<std::ptrdiff_t>(i)) {
      checker.add(entry(key, i), "stands in the list twice", "Leave one out");
    }
  }
}

void check_modes(Checker& checker, int modes) {
  const std::string key = "reduction.modes";
  if (!checker.sound(key) || !checker.grid || checker.grid_stands_in) return;
  const std::size_t points = checker.grid->size();
  if (modes < 1) return checker.add(key, "must be positive", "Got " + std::to_string(modes));
  if (static_cast<std::size_t>(modes) < points) return;
  checker.add(key, "is more than the body has points, " + std::to_string(points), "Choose a smaller number");
}

/// The keys of [reduction] itself.
template <class Method>
void check_method(Checker& checker, const Method& method) {
  if constexpr (requires { method.tolerance; }) {
    if (checker.sound("reduction.tolerance") && !reduction_tolerance.holds(method.tolerance)) {
      checker.add("reduction.tolerance", std::string(reduction_tolerance.text), "Got " + shortest(method.tolerance));
    }
  }
  if constexpr (requires { method.most_unknowns; }) {
    if (checker.sound("reduction.most_unknowns") && method.most_unknowns < 1) {
      checker.add("reduction.most_unknowns", "must be positive", "Got " + std::to_string(method.most_unknowns));
    }
  }
  if constexpr (requires { method.shortest_time; }) check_shortest_time(checker, method.shortest_time);
  if constexpr (requires { method.shifts; }) check_shifts(checker, method.shifts);
  if constexpr (requires { method.retained; }) check_retained(checker, method.retained);
  if constexpr (requires { method.modes; }) check_modes(checker, method.modes);
}

const std::string growth_hint =
    "Leave it out, or reduce with type = \"proper_orthogonal\", which holds for this growth and this load only";

void check_standing(Checker& checker) {
  const auto& cracks = checker.problem.cracks;
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    const std::string key = entry("crack", i);
    if (!checker.sound(key)) continue;
    const bool late = cracks[i].start_time > 0.0 && cracks[i].start_time < checker.problem.time.end;
    if (!cracks[i].tip_speed && !late) continue;
    checker.add(key + (cracks[i].tip_speed ? ".tip_speed" : ".start_time"),
                std::string("a crack that ") + (cracks[i].tip_speed ? "grows" : "appears") +
                    " changes the equations in time, and a reduced model has but one set of them",
                growth_hint);
  }
  const auto& damage = checker.problem.damage;
  if (!damage || !checker.sound("damage")) return;
  try {
    if (!damage->table && (!damage->displacement || !depends_on_time(*damage->displacement))) return;
  } catch (const Error&) {
    return;  // That it does not parse has been reported.
  }
  checker.add(damage->table ? "damage.table" : "damage.displacement",
              "bonds that break in time change the equations, and a reduced model has but one set of them",
              growth_hint);
}

/// No set of equations is linear that follows the temperatures of faces.
void check_linear(Checker& checker) {
  const auto& cracks = checker.problem.cracks;
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    const std::string key = entry("crack", i);
    if (!checker.sound(key) || !follows_temperatures(cracks[i])) continue;
    checker.add(key + ".gap", "radiates by the faces' own temperatures, and a reduced model is linear in these",
                "Give the mean of both, gap.temperature");
  }
}

/// Can a model be made of the case?
void check_reducible(Checker& checker, const ReductionMethod& method) {
  const Problem& problem = checker.problem;
  if (!std::holds_alternative<ProperOrthogonal>(method)) check_standing(checker);
  check_linear(checker);
  if (std::holds_alternative<SteadyState>(problem.time.integrator) && checker.sound("time.integrator")) {
    checker.add("time.integrator", "a steady state has no course in time that a model could answer",
                "Choose \"auto\", and time.end as long as the slowest change takes");
  }
  if (!checker.sound("boundary") || !checker.sound("nonlocality") || !checker.grid || checker.grid_stands_in) return;
  if (is_symmetric(problem)) return;
  checker.add("boundary",
              "reduced models need bonds that conduct the same both ways, and " + std::string(one_sided_reason),
              "Impose all boundaries with \"mirror\", or choose another scheme");
}

}  // namespace

void check_reduction(Checker& checker) {
  const std::optional<ReductionOptions>& reduction = checker.problem.reduction;
  if (!reduction || !checker.sound("reduction.type")) return;
  std::visit([&checker](const auto& method) { check_method(checker, method); }, reduction->method);
  if (checker.use == CaseUse::reduce) check_reducible(checker, reduction->method);
}

}  // namespace peritherm
