#pragma once

#include <optional>
#include <string>
#include <vector>

#include "peritherm/simulation/check.hpp"

namespace peritherm {

/// What the rules share: the problem, the grid once it is known, and the list of faults.
struct Checker {
  const Problem& problem;  ///< with everything filled in that its scheme decides
  const Locations& locations;
  const std::vector<std::string>& broken;  ///< keys that could not be read; rules on them would only echo that
  CaseUse use = CaseUse::run;
  std::optional<Grid> grid;     ///< once the body has passed its rules
  bool grid_stands_in = false;  ///< the body's own cells are wrong; the grid is a coarse one over its box
  std::vector<Issue> issues;

  /// Within this distance of a point a shape counts as containing it: rounding, or a whole cell of a coarse grid [m].
  double search_slack() const { return grid->spacing * (grid_stands_in ? 1.0 : 1e-9); }

  /// Was everything under the key, and the key itself, read without an issue?
  bool sound(std::string_view key) const;
  void add(const std::string& key, std::string problem_text, std::string hint = {});
  /// The same for "what is wrong. How to mend it"; nothing if the text is empty. True if nothing was wrong.
  bool accept(const std::string& key, const std::string& fault);
};

/// A length with a unit that keeps the number short.
std::string length_text(double length);

/// `find_faults` for a case of which some keys could not be read.
std::vector<Issue> find_faults(const Problem& problem, const Locations& locations,
                               const std::vector<std::string>& broken, CaseUse use = CaseUse::run);

void check_body(Checker& checker);       ///< dimension, cells; sets the grid
void check_materials(Checker& checker);  ///< names
void check_horizon(Checker& checker);
void check_regions(Checker& checker);
void check_contacts(Checker& checker);  ///< names of regions and contacts
/// Conductivities, and what the model would have to ignore. `given`: the problem before anything was filled in.
void check_model(Checker& checker, const Problem& given);
void check_division(Checker& checker);  ///< of a two-field body: thickness, contacts that touch
void check_boundaries(Checker& checker);
void check_profiles(Checker& checker);  ///< initial temperature, sources, boundary values
void check_cracks(Checker& checker);
void check_damage(Checker& checker);  ///< displacements, and the whole of a table
void check_outputs(Checker& checker);
void check_numerics(Checker& checker);
void check_reduction(Checker& checker);  ///< its own keys, and whether the case can be reduced if it is to be

/// Is the place in the box of the grid?
bool in_box(const Grid& grid, const Point& place);
/// "The body reaches in x from 0 to 1, …".
std::string box_text(const Grid& grid);

/// Sources and boundaries whose shape has no fault are worth a look at their points.
bool shape_is_sound(const Checker& checker, const std::string& key, const std::optional<Shape>& shape);

/// "1 entry", "3 entries".
inline std::string count_of(std::size_t entries) {
  return std::to_string(entries) + (entries == 1 ? " entry" : " entries");
}

/// "body.region" + 2 → "body.region.2".
std::string entry(const std::string& list, std::size_t index);

/// Could all regions be read, and do they suit the grid, which must be known?
bool regions_are_sound(const Checker& checker);

/// Material at a place is cut away. The shapes of all regions must be without fault.
bool is_void(const Problem& problem, const Point& place, double slack);

/// Points on the surface of a shape may be off by rounding.
inline double slack_of(const Grid& grid) { return 1e-9 * grid.spacing; }

/// First, middle and last point along each axis.
std::vector<Point> sample_places(const Grid& grid);

/// Grids beyond this are not searched point by point [points]; a search of this many takes about a second.
inline constexpr std::size_t largest_search = 100'000'000;

/// Calls `holds(position)` for every point until it is true; says if it ever was.
template <class Predicate>
bool any_point(const Grid& grid, Predicate&& holds) {
  for (int k = 0; k < grid.count(2); ++k) {
    for (int j = 0; j < grid.count(1); ++j) {
      for (int i = 0; i < grid.count(0); ++i) {
        if (holds(grid.position({i, j, k}))) return true;
      }
    }
  }
  return false;
}

/// The same for the places on a face above its first layer of points.
template <class Predicate>
bool any_wall_point(const Grid& grid, Face face, Predicate&& holds) {
  const auto across = static_cast<std::size_t>(axis_of(face));
  Grid wall = grid;
  wall.origin[across] += is_upper(face) ? grid.length(axis_of(face)) : 0.0;
  wall.cells[across] = 1;
  return any_point(wall, [&holds, &wall, across](Point place) {
    place[across] = wall.origin[across];
    return holds(place);
  });
}

}  // namespace peritherm
