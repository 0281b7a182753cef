#include <optional>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/displacement_series.hpp"
#include "peritherm/simulation/displacement_table.hpp"

namespace peritherm {
namespace {

constexpr double most_looks = 1e6;

/// At the first, middle and last point along each axis, at the start, half way and at the end.
void check_component(Checker& checker, const std::string& key, const Profile& profile) {
  if (!checker.sound(key)) return;
  try {
    CompiledProfile compiled(profile);
    if (!checker.grid || !regions_are_sound(checker)) return;
    const Grid& grid = *checker.grid;
    const double end = checker.sound("time.end") ? checker.problem.time.end : 0.0;
    for (const double share : {0.0, 0.5, 1.0}) {
      for (const Point& place : sample_places(grid)) {
        if (!is_void(checker.problem, place, slack_of(grid))) compiled(place, share * end);
      }
    }
  } catch (const Error& error) {
    checker.add(key, error.issues().front().problem, error.issues().front().hint);
  }
}

/// Does any component depend on t? Unknown if one does not parse, which has been reported.
std::optional<bool> any_depends_on_time(const std::vector<Profile>& displacement) {
  try {
    return depends_on_time(displacement);
  } catch (const Error&) {
    return std::nullopt;
  }
}

void check_displacement(Checker& checker, const DamageOptions& damage) {
  const std::string key = "damage.displacement";
  const std::vector<Profile>& displacement = *damage.displacement;
  if (checker.grid && displacement.size() != static_cast<std::size_t>(checker.grid->dimension)) {
    checker.add(
        key,
        "has " + count_of(displacement.size()) + ", but the body is " + std::to_string(checker.grid->dimension) + "-D",
        "Give one number or expression per dimension");
  }
  for (std::size_t i = 0; i < displacement.size(); ++i) check_component(checker, entry(key, i), displacement[i]);
  const std::optional<bool> changes = any_depends_on_time(displacement);
  if (!checker.sound(key) || !checker.sound("damage.every") || !changes) return;
  if (!*changes) {
    if (damage.every) checker.add("damage.every", "displacement does not depend on t, one look is all", "Leave it out");
    return;
  }
  if (!damage.every) {
    return checker.add("damage", "displacement depends on t, and every is missing",
                       "Say how often to look at it, e.g. every = \"0.1 s\"");
  }
  if (!checker.sound("time.end") || checker.problem.time.end / *damage.every <= most_looks) return;
  checker.add("damage.every", "makes more than 1e6 looks until the end of the run", "Choose a longer period");
}

void check_table(Checker& checker, const std::string& path) {
  const std::string key = "damage.table";
  if (!checker.grid || checker.grid_stands_in || checker.grid->size() > largest_search) return;
  const Grid& grid = *checker.grid;
  const bool regions_sound = regions_are_sound(checker);
  DisplacementTable table(path, grid, [&](std::size_t point) {
    return regions_sound && !is_void(checker.problem, grid.position(grid.index(point)), slack_of(grid));
  });
  double first = 0.0, last = 0.0;
  std::vector<double> values;
  const bool any = table.next(first, values);
  for (last = first; table.next(last, values);) continue;
  const bool read = table.faults().empty();
  for (const auto& [problem, hint] : table.faults()) checker.add(key, problem, hint);
  if (!any) {
    if (read) checker.add(key, "'" + path + "' has no rows", "List every point of the body once at each time");
    return;
  }
  if (first > 0.0) {
    checker.add(key, "'" + path + "' begins at t = " + shortest(first) + " s, after the run does",
                "Let it begin at 0 or before");
  }
  // Where reading stopped says nothing of where the table ends.
  if (!read || !checker.sound("time.end")) return;
  const double end = checker.problem.time.end;
  if (last >= end * (1.0 - 1e-12)) return;
  checker.add(key, "'" + path + "' ends at t = " + shortest(last) + " s, before the run does",
              "Let it reach time.end, " + shortest(end) + " s");
}

}  // namespace

void check_damage(Checker& checker) {
  if (!checker.problem.damage) return;
  const DamageOptions& damage = *checker.problem.damage;
  if (checker.sound("damage.critical_elongation") && !positive.holds(damage.critical_elongation)) {
    checker.add("damage.critical_elongation", "must be positive", "Got " + shortest(damage.critical_elongation));
  }
  if (checker.sound("damage.transmission") && !zero_to_one.holds(damage.transmission)) {
    checker.add("damage.transmission", "must lie between 0 and 1", "Got " + shortest(damage.transmission));
  }
  if (damage.every && checker.sound("damage.every") && !positive.holds(*damage.every)) {
    checker.add("damage.every", "must be positive", "Got " + shortest(*damage.every) + " s");
  }
  if (damage.displacement.has_value() == damage.table.has_value()) {
    if (!checker.sound("damage.displacement") || !checker.sound("damage.table")) return;
    return checker.add("damage",
                       damage.table ? "has both displacement and table" : "has neither displacement nor table",
                       damage.table ? "Leave one of them out" : "Give one of them");
  }
  if (damage.table && damage.every) {
    checker.add("damage.every", "is for expressions; a table has times of its own", "Leave it out");
  }
  if (damage.displacement) {
    check_displacement(checker, damage);
  } else if (checker.sound("damage.table")) {
    check_table(checker, *damage.table);
  }
}

}  // namespace peritherm
