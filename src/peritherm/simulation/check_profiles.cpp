#include <algorithm>
#include <optional>
#include <vector>

#include "peritherm/physics/profile.hpp"
#include "peritherm/simulation/checker.hpp"

namespace peritherm {
namespace {

/// A profile of the problem and the places where it will be used.
struct UsedProfile {
  std::string key;
  const Profile& profile;
  std::optional<Face> face;
  std::optional<Shape> where;
  std::string at_start{};  ///< what it is at the start, if it is used there only
  bool everywhere = true;  ///< else on surfaces inside the body, whose places are not known yet
};

/// Places all over the body; on a face for those that are used there.
std::vector<Point> places_of_use(const Grid& grid, const UsedProfile& used) {
  std::vector<Point> places;
  for (Point place : sample_places(grid)) {
    if (used.face && axis_of(*used.face) < grid.dimension) {
      const auto across = static_cast<std::size_t>(axis_of(*used.face));
      place[across] = grid.origin[across] + (is_upper(*used.face) ? grid.length(axis_of(*used.face)) : 0.0);
    }
    if (!used.where || contains(*used.where, place, slack_of(grid))) places.push_back(place);
  }
  return places;
}

void check_profile(Checker& checker, const UsedProfile& used) {
  if (!checker.sound(used.key)) return;
  try {
    CompiledProfile compiled(used.profile);
    if (!used.at_start.empty() && compiled.depends_on_time()) {
      checker.add(used.key, "the " + used.at_start + " at the start cannot depend on t", "Use x, y and z only");
    } else if (std::holds_alternative<SteadyState>(checker.problem.time.integrator) && compiled.depends_on_time()) {
      checker.add(used.key, "depends on t, so there is no steady state",
                  "Leave t out, or choose another integrator than \"steady\"");
    }
    const std::string owner = used.key.substr(0, used.key.rfind('.'));
    if (!used.everywhere || !shape_is_sound(checker, owner, used.where)) return;
    for (const Point& place : places_of_use(*checker.grid, used)) compiled(place, 0.0);
  } catch (const Error& error) {
    checker.add(used.key, error.issues().front().problem, error.issues().front().hint);
  }
}

/// Calls `visit(key, profile)` for the profiles among the options of an alternative.
template <Described T, class Visitor>
void for_each_profile(const T& owner, const Visitor& visit) {
  std::apply(
      [&owner, &visit](const auto&... option) {
        [[maybe_unused]] const auto look = [&owner, &visit]<class Value>(const Option<T, Value>& candidate) {
          if constexpr (std::is_same_v<Value, Profile>) visit(candidate.key, owner.*candidate.member);
        };
        (look(option), ...);
      },
      T::options());
}

}  // namespace

void check_profiles(Checker& checker) {
  const Problem& problem = checker.problem;
  check_profile(checker, {"initial.temperature", problem.initial.temperature, {}, {}, "temperature"});
  for (std::size_t axis = 0; problem.initial.heat_flux && axis < problem.initial.heat_flux->size(); ++axis) {
    check_profile(checker, {entry("initial.heat_flux", axis), (*problem.initial.heat_flux)[axis], {}, {}, "flux"});
  }
  for (std::size_t i = 0; i < problem.sources.size(); ++i) {
    const HeatSource& source = problem.sources[i];
    const std::string key = entry("source", i);
    check_profile(checker, {key + ".value", source.value, {}, source.where});
    if (!source.where || !checker.grid || !checker.sound(key + ".where")) continue;
    const Grid& grid = *checker.grid;
    if (!checker.accept(key + ".where", find_fault(*source.where, grid.dimension))) continue;
    if (grid.size() > largest_search) continue;
    const bool reaches = any_point(grid, [&source, slack = checker.search_slack()](const Point& place) {
      return contains(*source.where, place, slack);
    });
    if (!reaches) checker.add(key + ".where", "contains no point of the body", "Move or enlarge it");
  }
  for (std::size_t i = 0; i < problem.boundaries.size(); ++i) {
    const BoundaryOptions& boundary = problem.boundaries[i];
    const std::string key = entry("boundary", i);
    std::visit(
        [&checker, &boundary, &key](const auto& condition) {
          for_each_profile(condition, [&checker, &boundary, &key](std::string_view name, const Profile& profile) {
            check_profile(checker, {key + '.' + std::string(name), profile, boundary.face, boundary.where});
          });
        },
        boundary.condition);
  }
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
    std::visit(
        [&checker, key = entry("contact", c)](const auto& law) {
          for_each_profile(law, [&checker, &key](std::string_view name, const Profile& profile) {
            check_profile(checker, {key + '.' + std::string(name), profile, {}, {}, {}, false});
          });
        },
        problem.contacts[c].law);
  }
}

}  // namespace peritherm
