#include "peritherm/simulation/check.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/simulation/checker.hpp"
#include "peritherm/simulation/locations.hpp"

namespace peritherm {

bool Checker::sound(std::string_view key) const {
  return std::none_of(broken.begin(), broken.end(), [key](const std::string& other) { return keys_touch(key, other); });
}

void Checker::add(const std::string& key, std::string problem_text, std::string hint) {
  issues.push_back({find_location(locations, key), std::move(problem_text), std::move(hint)});
}

bool Checker::accept(const std::string& key, const std::string& fault) {
  if (fault.empty()) return true;
  const auto end = fault.find(". ");
  if (end == std::string::npos) {
    add(key, fault);
  } else {
    add(key, fault.substr(0, end), fault.substr(end + 2));
  }
  return false;
}

std::string entry(const std::string& list, std::size_t index) { return list + '.' + std::to_string(index); }

bool regions_are_sound(const Checker& checker) {
  const auto& regions = checker.problem.body.regions;
  return checker.sound("body.region") && std::all_of(regions.begin(), regions.end(), [&](const BodyRegion& region) {
           return find_fault(region.shape, checker.grid->dimension).empty();
         });
}

bool is_void(const Problem& problem, const Point& place, double slack) {
  const auto& regions = problem.body.regions;
  const auto last = std::find_if(regions.rbegin(), regions.rend(), [&place, slack](const BodyRegion& region) {
    return contains(region.shape, place, slack);
  });
  return last != regions.rend() && last->material == "void";
}

bool shape_is_sound(const Checker& checker, const std::string& key, const std::optional<Shape>& shape) {
  return checker.grid && checker.sound(key) && (!shape || find_fault(*shape, checker.grid->dimension).empty());
}

std::vector<Point> sample_places(const Grid& grid) {
  std::vector<Point> places;
  const int combinations = grid.dimension == 1 ? 3 : grid.dimension == 2 ? 9 : 27;
  for (int number = 0; number < combinations; ++number) {
    GridIndex index{};
    for (int axis = 0, rest = number; axis < grid.dimension; ++axis, rest /= 3) {
      index[static_cast<std::size_t>(axis)] = rest % 3 * (grid.count(axis) - 1) / 2;
    }
    places.push_back(grid.position(index));
  }
  return places;
}

Grid make_grid(const Problem& problem) {
  const BodyOptions& body = problem.body;
  Grid grid;
  grid.dimension = static_cast<int>(body.size.size());
  grid.placement = body.points.value_or(choices_of(problem.nonlocality.scheme).points);
  grid.origin = to_point(body.origin.value_or(Coordinates{}));
  for (std::size_t axis = 0; axis < body.size.size(); ++axis) {
    grid.cells[axis] =
        body.cells ? (*body.cells)[axis] : static_cast<int>(std::lround(body.size[axis] / *body.spacing));
  }
  grid.spacing = body.size[0] / grid.cells[0];
  return grid;
}

double horizon_of(const Problem& problem) {
  const NonlocalityOptions& options = problem.nonlocality;
  return options.horizon ? *options.horizon : *options.horizon_ratio * make_grid(problem).spacing;
}

StencilOptions stencil_options_of(const Problem& problem) {
  const NonlocalityOptions& options = problem.nonlocality;
  const SchemeChoices choices = choices_of(options.scheme);
  return {options.kernel, horizon_of(problem), options.partial_volumes.value_or(choices.partial_volumes),
          options.calibration.value_or(choices.calibration), options.self_term.value_or(choices.self_term)};
}

std::vector<Issue> find_faults(const Problem& given, const Locations& locations, const std::vector<std::string>& broken,
                               CaseUse use) {
  const Problem problem = resolved(given);
  Checker checker{problem, locations, broken, use, std::nullopt, false, {}};
  check_body(checker);
  check_materials(checker);
  check_model(checker, given);
  check_horizon(checker);
  check_regions(checker);
  check_contacts(checker);
  check_boundaries(checker);
  check_profiles(checker);
  check_cracks(checker);
  // A model holds for the cracks and bonds that it was made with, wherever their table is now.
  if (use != CaseUse::answer) check_damage(checker);
  check_outputs(checker);
  check_numerics(checker);
  if (use != CaseUse::answer) check_reduction(checker);
  if (problem.nonlocality.model == Model::two_field && checker.issues.empty() && broken.empty())
    check_division(checker);
  return std::move(checker.issues);
}

std::vector<Issue> find_faults(const Problem& problem, const Locations& locations, CaseUse use) {
  return find_faults(problem, locations, {}, use);
}

void check(const Problem& problem, const Locations& locations, CaseUse use) {
  std::vector<Issue> issues = find_faults(problem, locations, use);
  if (!issues.empty()) throw Error(std::move(issues));
}

}  // namespace peritherm
