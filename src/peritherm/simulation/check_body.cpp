#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/checker.hpp"

namespace peritherm {
namespace {

constexpr double cube_tolerance = 1e-6;  ///< how far cells may be from cubes, relative
constexpr double most_cells = 1e9;       ///< along one axis

std::string list_of(const std::vector<double>& numbers) {
  std::vector<std::string> words;
  for (const double number : numbers) words.push_back(shortest(number));
  return "[" + join(words) + "]";
}

/// For messages, where a length such as 0.03000000000000001 only disturbs.
std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

std::string list_of_rounded(const std::vector<double>& numbers) {
  std::vector<std::string> words;
  for (const double number : numbers) words.push_back(rounded(number));
  return "[" + join(words) + "]";
}

/// Cells along every axis if there are `first` along x; empty if they are no cubes.
std::vector<double> cubes(const Coordinates& size, double first) {
  std::vector<double> cells{first};
  for (std::size_t axis = 1; axis < size.size(); ++axis) {
    const double wanted = size[axis] / size[0] * first;
    cells.push_back(std::round(wanted));
    if (cells.back() < 1.0 || std::abs(wanted - cells.back()) > cube_tolerance * wanted) return {};
  }
  return cells;
}

/// Cells that are cubes, with a number along x as near as can be to the wanted one; empty if there are none near.
std::vector<double> nearest_cubes(const Coordinates& size, double wanted) {
  const double start = std::max(1.0, std::round(wanted));
  for (double distance = 0.0; distance <= std::min(start, 10000.0); ++distance) {
    if (start > distance) {
      if (auto fewer = cubes(size, start - distance); !fewer.empty()) return fewer;
    }
    if (auto more = cubes(size, start + distance); !more.empty()) return more;
  }
  return {};
}

void check_cells(Checker& checker) {
  const Coordinates& size = checker.problem.body.size;
  const std::vector<int>& cells = *checker.problem.body.cells;
  if (cells.size() != size.size()) {
    return checker.add("body.cells", "has " + count_of(cells.size()) + ", but size has " + std::to_string(size.size()),
                       "Give one number of cells per length");
  }
  if (std::any_of(cells.begin(), cells.end(), [](int count) { return count < 1; })) {
    return checker.add("body.cells", "must be positive", "Give at least one cell along each axis");
  }
  std::vector<double> edges;
  std::vector<double> fitting;
  for (std::size_t axis = 0; axis < size.size(); ++axis) {
    edges.push_back(size[axis] / cells[axis]);
    fitting.push_back(edges[0] * cells[axis]);
  }
  const auto [least, most] = std::minmax_element(edges.begin(), edges.end());
  if (*most - *least <= cube_tolerance * *most) return;
  const std::vector<double> nearest = nearest_cubes(size, cells[0]);
  std::string hint = "Choose size = " + list_of_rounded(fitting) + " m";
  if (!nearest.empty()) hint = "Choose cells = " + list_of(nearest) + ", or size = " + list_of_rounded(fitting) + " m";
  checker.add("body.cells", "cells are not cubes: their edges are " + list_of_rounded(edges) + " m", hint);
}

void check_spacing(Checker& checker) {
  const Coordinates& size = checker.problem.body.size;
  const double spacing = *checker.problem.body.spacing;
  std::vector<double> fitting;
  bool divides = true;
  for (const double length : size) {
    const double wanted = length / spacing;
    if (!(wanted <= most_cells)) {
      return checker.add("body.spacing", "makes more than 1e9 cells along an axis", "Choose a larger spacing");
    }
    const double cells = std::max(1.0, std::round(wanted));
    divides = divides && std::abs(wanted - cells) <= cube_tolerance * cells;
    fitting.push_back(cells * spacing);
  }
  if (divides) return;
  const std::vector<double> nearest = nearest_cubes(size, size[0] / spacing);
  std::string hint = "Choose size = " + list_of_rounded(fitting) + " m";
  if (!nearest.empty()) {
    hint = "Choose spacing = " + length_text(size[0] / nearest[0]) + " (cells = " + list_of(nearest) +
           "), or size = " + list_of_rounded(fitting) + " m";
  }
  checker.add("body.spacing", length_text(spacing) + " does not divide the size " + list_of(size) + " m", hint);
}

/// Size and origin; false if nothing else can be said about the body.
bool check_box(Checker& checker) {
  const BodyOptions& body = checker.problem.body;
  const std::size_t dimension = body.size.size();
  if (dimension < 1 || dimension > 3) {
    checker.add("body.size", "has " + std::to_string(dimension) + " entries", "Give 1, 2 or 3 lengths");
    return false;
  }
  if (!std::all_of(body.size.begin(), body.size.end(), positive.holds)) {
    checker.add("body.size", "must be positive", "Got " + list_of(body.size) + " m");
    return false;
  }
  if (body.origin && body.origin->size() != dimension) {
    checker.add("body.origin", "has " + count_of(body.origin->size()) + ", but size has " + std::to_string(dimension),
                "Give one coordinate per length");
    return false;
  }
  return true;
}

void check_count(Checker& checker, const Grid& grid) {
  constexpr auto most = static_cast<double>(std::numeric_limits<PointIndex>::max());
  double points = 1.0;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const int count = grid.count(axis);
    points *= count;
    if (count >= 2) continue;
    checker.add(checker.problem.body.cells ? "body.cells" : "body.spacing",
                std::string("leaves a single point along ") + "xyz"[axis], "Choose at least 2 cells along each axis");
  }
  if (points <= most) return;
  checker.add(checker.problem.body.cells ? "body.cells" : "body.spacing",
              "makes " + rounded(points) + " points, more than " + shortest(most), "Choose fewer cells");
}

/// A coarse grid over the same box, so that what does not fit the box is named beside cells that do not.
std::optional<Grid> stand_in_grid(const BodyOptions& body) {
  const double shortest_length = *std::min_element(body.size.begin(), body.size.end());
  const std::vector<double> cells = nearest_cubes(body.size, std::round(30.0 * body.size[0] / shortest_length));
  if (cells.empty() || *std::max_element(cells.begin(), cells.end()) > 1e5) return std::nullopt;
  Problem problem;
  problem.body = body;
  problem.body.spacing.reset();
  problem.body.cells = std::vector<int>(cells.begin(), cells.end());
  return make_grid(problem);
}

/// Could the box, its cells and its points be read? Regions and the material do not matter.
bool body_is_read(const Checker& checker) {
  return std::none_of(checker.broken.begin(), checker.broken.end(), [](const std::string& key) {
    const bool apart = key.starts_with("body.region") || key == "body.material";
    return key == "body" || (key.starts_with("body.") && !apart);
  });
}

/// Name of a material in the case, or a fault.
void check_material_name(Checker& checker, const std::string& key, const std::string& name) {
  const auto& materials = checker.problem.materials;
  if (!checker.sound(key) || materials.count(name) > 0) return;
  std::vector<std::string> names;
  for (const auto& [known, material] : materials) names.push_back(known);
  const std::string nearest = nearest_word(name, names);
  std::string hint = names.empty() ? "Add [materials." + name + "]" : "Choose one of: " + join(names);
  if (!nearest.empty()) hint = "Did you mean '" + nearest + "'?";
  checker.add(key, "material '" + name + "' does not exist", hint);
}

/// Does the horizon suffice for the rule of partial volumes, and the kernel for the self term?
bool check_quadrature(Checker& checker, const std::string& key, const std::string& name) {
  const Problem& problem = checker.problem;
  const PartialVolumes rule = *problem.nonlocality.partial_volumes;
  const double spacing = checker.grid->spacing;
  const double least = least_ratio(rule);
  const std::size_t before = checker.issues.size();
  if (horizon_of(problem) < least * spacing * (1.0 - 1e-9)) {
    const std::string smallest = problem.nonlocality.horizon ? length_text(least * spacing) : rounded(least);
    checker.add(key, name + " is too small for partial_volumes = \"" + std::string(name_of(rule)) + '"',
                "Choose at least " + smallest + ", or other partial_volumes");
  }
  const SelfTerm self = *problem.nonlocality.self_term;
  if (self != SelfTerm::none && problem.nonlocality.kernel.exponent != 2) {
    checker.add("nonlocality.self_term", '"' + std::string(name_of(self)) + "\" belongs to kernels with exponent 2",
                "Choose self_term = \"none\", or exponent = 2");
  }
  return checker.issues.size() == before;
}

}  // namespace

std::string length_text(double length) {
  if (length < 1e-6 || length >= 1.0) return rounded(length) + " m";
  return length < 1e-3 ? rounded(1e6 * length) + " um" : rounded(1e3 * length) + " mm";
}

void check_body(Checker& checker) {
  const BodyOptions& body = checker.problem.body;
  if (!body_is_read(checker)) return;
  const std::size_t before = checker.issues.size();
  const bool box = check_box(checker);
  if (body.cells.has_value() == body.spacing.has_value()) {
    return checker.add("body", body.cells ? "has both cells and spacing" : "has neither cells nor spacing",
                       body.cells ? "Leave one of them out" : "Give one of them");
  }
  if (!box) return;
  if (body.cells) {
    check_cells(checker);
  } else if (!positive.holds(*body.spacing)) {
    checker.add("body.spacing", "must be positive", "Got " + shortest(*body.spacing) + " m");
  } else {
    check_spacing(checker);
  }
  if (checker.issues.size() != before) {
    checker.grid = stand_in_grid(body);
    checker.grid_stands_in = true;
    return;
  }
  const Grid grid = make_grid(checker.problem);
  check_count(checker, grid);
  if (checker.issues.size() == before) checker.grid = grid;
}

void check_materials(Checker& checker) {
  const auto& materials = checker.problem.materials;
  if (materials.count("void") > 0) {
    checker.add("materials.void", "is no name for a material, it means cut away", "Choose another name");
  }
  if (materials.size() > 250) {
    checker.add("materials", "has " + std::to_string(materials.size()) + " entries", "Choose at most 250 materials");
  }
  const BodyOptions& body = checker.problem.body;
  if (body.material == "void" && checker.problem.nonlocality.model == Model::two_field) {
    // Rings, or parts in empty space.
  } else if (body.material == "void") {
    checker.add("body.material", "cannot be void", "Name a material, and cut away parts with [[body.region]]");
  } else if (checker.sound("materials") || !materials.empty()) {
    check_material_name(checker, "body.material", body.material);
  }
  for (std::size_t i = 0; i < body.regions.size(); ++i) {
    if (body.regions[i].material == "void") continue;
    check_material_name(checker, entry("body.region", i) + ".material", body.regions[i].material);
  }
}

void check_horizon(Checker& checker) {
  const NonlocalityOptions& options = checker.problem.nonlocality;
  if (!checker.sound("nonlocality")) return;
  if (options.horizon.has_value() == options.horizon_ratio.has_value()) {
    return checker.add("nonlocality",
                       options.horizon ? "has both horizon and horizon_ratio" : "has neither horizon nor horizon_ratio",
                       options.horizon ? "Leave one of them out" : "Give one of them");
  }
  if (!checker.grid || checker.grid_stands_in) return;
  const std::string key = options.horizon ? "nonlocality.horizon" : "nonlocality.horizon_ratio";
  const Grid& grid = *checker.grid;
  const double horizon = horizon_of(checker.problem);
  const std::string name =
      options.horizon ? "horizon " + length_text(horizon) : "horizon_ratio " + rounded(*options.horizon_ratio);
  if (!(horizon >= grid.spacing * (1.0 - 1e-9))) {
    return checker.add(
        key, name + " reaches no neighbour",
        options.horizon ? "Choose at least the spacing, " + length_text(grid.spacing) : "Choose at least 1");
  }
  // Two fields need no fictitious points, and have no partial volumes.
  if (checker.problem.nonlocality.model == Model::two_field) return;
  const int fewest = *std::min_element(grid.cells.begin(), grid.cells.begin() + grid.dimension);
  // Fictitious points mirror the body once, so they must not reach beyond its far side.
  if (std::ceil(horizon / grid.spacing + 0.5 - 1e-9) > fewest) {
    const std::string largest = options.horizon ? length_text((fewest - 0.5) * grid.spacing) : rounded(fewest - 0.5);
    return checker.add(
        key, name + " is too large for the body, whose shortest side has " + std::to_string(fewest) + " cells",
        "Choose at most " + largest);
  }
  if (!check_quadrature(checker, key, name)) return;
  try {
    make_stencil(stencil_options_of(checker.problem), grid.spacing, grid.dimension);
  } catch (const Error& error) {
    checker.add(key, error.issues().front().problem, error.issues().front().hint);
  }
}

void check_regions(Checker& checker) {
  const auto& regions = checker.problem.body.regions;
  if (!checker.grid) return;
  const Grid& grid = *checker.grid;
  const double slack = checker.search_slack();
  bool all_sound = checker.sound("body.region");
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::string key = entry("body.region", i) + ".shape";
    if (!checker.sound(key)) continue;
    if (!checker.accept(key, find_fault(regions[i].shape, grid.dimension))) {
      all_sound = false;
    } else if (grid.size() <= largest_search &&
               !any_point(grid, [&shape = regions[i].shape, slack](const Point& place) {
                 return contains(shape, place, slack);
               })) {
      checker.add(key, "contains no point of the body", "Move or enlarge it, or choose smaller cells");
    }
  }
  if (!all_sound || regions.empty() || grid.size() > largest_search) return;
  const Problem& problem = checker.problem;
  const bool any_left =
      any_point(grid, [&problem, &grid](const Point& place) { return !is_void(problem, place, slack_of(grid)); });
  if (!any_left) checker.add("body.region", "cuts away the whole body", "Leave some of it");
}

}  // namespace peritherm
