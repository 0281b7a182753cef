#include <algorithm>
#include <map>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/checker.hpp"

namespace peritherm {
namespace {

using Boundaries = std::vector<BoundaryOptions>;

bool holds_temperature(const BoundaryOptions& boundary) {
  return std::holds_alternative<HeldTemperature>(boundary.condition);
}

std::string face_name(Face face) { return "the face " + std::string(name_of(face)); }

bool check_place(Checker& checker, const std::string& key, const BoundaryOptions& boundary) {
  if (!boundary.face && !boundary.where) {
    checker.add(key, "has neither face nor where", "Say where it applies, e.g. face = \"x_min\"");
    return false;
  }
  if (!checker.grid) return false;
  const int dimension = checker.grid->dimension;
  if (boundary.face && axis_of(*boundary.face) >= dimension) {
    std::string faces;
    for (const auto& [face, name] : EnumNames<Face>::values) {
      if (axis_of(face) < dimension) faces += (faces.empty() ? "" : ", ") + std::string(name);
    }
    checker.add(key + ".face",
                "a " + std::to_string(dimension) + "-D body has no face '" + std::string(name_of(*boundary.face)) + "'",
                "Choose one of: " + faces);
    return false;
  }
  return !boundary.where || checker.accept(key + ".where", find_fault(*boundary.where, dimension));
}

void check_selection(Checker& checker, const std::string& key, const BoundaryOptions& boundary) {
  const Grid& grid = *checker.grid;
  if (!boundary.where || grid.size() > largest_search) return;
  const auto selected = [&boundary, slack = checker.search_slack()](const Point& place) {
    return contains(*boundary.where, place, slack);
  };
  if (boundary.face) {
    if (any_wall_point(grid, *boundary.face, selected)) return;
    return checker.add(key + ".where", "selects no point of " + face_name(*boundary.face),
                       "Move or enlarge it so that it covers a part of the face");
  }
  // Of a two-field body it selects surface, which is looked at once the body is divided.
  if (checker.problem.nonlocality.model == Model::two_field) return;
  if (!any_point(grid, selected)) {
    checker.add(key + ".where", "contains no point of the body", "Move or enlarge it, or choose smaller cells");
  }
}

/// How what passes a face is imposed: by fictitious points anywhere, by points inside on whole faces only.
void check_outside(Checker& checker, const std::string& key, const BoundaryOptions& boundary) {
  const Outside outside = outside_of(boundary.condition);
  if (outside == Outside::mirror) return;
  const std::string name = '"' + std::string(name_of(outside)) + '"';
  const bool is_flux = std::holds_alternative<PrescribedFlux>(boundary.condition);
  if (!boundary.face) {
    if (is_flux) checker.add(key + ".imposed", name + " belongs to a face", "Leave it out, or give face");
  } else if (boundary.where) {
    checker.add(key + ".imposed", name + " applies to a whole face", "Leave where out, or choose \"mirror\"");
  } else if (is_flux && outside == Outside::natural) {
    checker.add(key + ".imposed", "\"natural\" lets no heat pass, so there is no flux to prescribe",
                "Choose one of: mirror, slaved, flux_formula");
  }
}

/// Points that follow the first one farther in than a horizon need it, whatever stands at the other end.
void check_room_to_follow(Checker& checker, const std::string& key, const BoundaryOptions& boundary) {
  if (outside_of(boundary.condition) != Outside::slaved || !checker.sound("nonlocality")) return;
  const Grid& grid = *checker.grid;
  const NonlocalityOptions& options = checker.problem.nonlocality;
  if (checker.grid_stands_in || options.horizon.has_value() == options.horizon_ratio.has_value()) return;
  // What makes no stencil has been reported with the horizon.
  int tied = 0;
  try {
    const StencilOptions stencil = stencil_options_of(checker.problem);
    tied = slaved_points(make_stencil(stencil, grid.spacing, grid.dimension), stencil.horizon, grid.spacing);
  } catch (const Error&) {
    return;
  }
  const int points = grid.count(axis_of(*boundary.face));
  if (points > 2 * tied) return;
  checker.add(key + ".imposed",
              "\"slaved\" ties the " + std::to_string(tied) + " outermost points to the next one, and the body has " +
                  std::to_string(points) + " across",
              "Choose at least " + std::to_string(2 * tied + 1) + " points, a smaller horizon, or \"mirror\"");
}

void check_condition(Checker& checker, const std::string& key, const BoundaryOptions& boundary) {
  if (std::holds_alternative<Insulated>(boundary.condition) && !boundary.face) {
    checker.add(key, "an insulated boundary needs a face", "Give face; inside the body use a [[crack]] or void");
  }
  check_outside(checker, key, boundary);
  const auto* held = std::get_if<HeldTemperature>(&boundary.condition);
  if (held == nullptr) return;
  if (!boundary.face && held->imposed.value_or(Imposed::mirror) != Imposed::mirror) {
    checker.add(key + ".imposed", "does not belong to a boundary without a face, whose points are held themselves",
                "Leave it out, or give face");
  } else if (held->thickness && held->imposed != Imposed::inner) {
    checker.add(key + ".thickness", "belongs to imposed = \"inner\" only",
                "Leave it out, or choose imposed = \"inner\"");
  }
}

/// Finds entries that claim the same place; each later one is reported once.
class Claims {
 public:
  Claims(const Grid& grid, const Boundaries& boundaries, std::vector<std::size_t> candidates)
      : grid_(grid), boundaries_(boundaries), candidates_(std::move(candidates)) {}

  /// Never ends a search, so that every place is looked at.
  bool operator()(const Point& place) {
    std::size_t first = boundaries_.size();
    for (const std::size_t i : candidates_) {
      if (boundaries_[i].where && !contains(*boundaries_[i].where, place, slack_of(grid_))) continue;
      if (first == boundaries_.size()) {
        first = i;
      } else {
        later_.emplace(i, first);
      }
    }
    return false;
  }

  const std::map<std::size_t, std::size_t>& later() const { return later_; }

 private:
  const Grid& grid_;
  const Boundaries& boundaries_;
  std::vector<std::size_t> candidates_;
  std::map<std::size_t, std::size_t> later_;  ///< an entry, and an earlier one that it overlaps
};

void report(Checker& checker, const Claims& claims, const std::string& place) {
  for (const auto& [later, earlier] : claims.later()) {
    checker.add(entry("boundary", later), "overlaps " + entry("boundary", earlier) + " on " + place,
                "Choose parts that share no point (edges of a shape belong to it), or leave one out");
  }
}

void check_overlaps(Checker& checker, const std::vector<std::size_t>& sound) {
  const Grid& grid = *checker.grid;
  const Boundaries& boundaries = checker.problem.boundaries;
  std::map<Face, std::vector<std::size_t>> on_face;
  std::vector<std::size_t> held;
  for (const std::size_t i : sound) {
    if (boundaries[i].face) {
      on_face[*boundaries[i].face].push_back(i);
    } else if (holds_temperature(boundaries[i])) {
      held.push_back(i);
    }
  }
  if (grid.size() > largest_search) return;
  for (const auto& [face, candidates] : on_face) {
    if (candidates.size() < 2) continue;
    Claims claims(grid, boundaries, candidates);
    any_wall_point(grid, face, claims);
    report(checker, claims, face_name(face));
  }
  if (held.size() < 2) return;
  Claims claims(grid, boundaries, held);
  any_point(grid, claims);
  report(checker, claims, "some points");
}

}  // namespace

void check_boundaries(Checker& checker) {
  std::vector<std::size_t> sound;
  const Boundaries& boundaries = checker.problem.boundaries;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const std::string key = entry("boundary", i);
    if (!checker.sound(key)) continue;
    check_condition(checker, key, boundaries[i]);
    if (!check_place(checker, key, boundaries[i])) continue;
    check_selection(checker, key, boundaries[i]);
    if (boundaries[i].face) check_room_to_follow(checker, key, boundaries[i]);
    sound.push_back(i);
  }
  if (checker.grid) check_overlaps(checker, sound);
}

}  // namespace peritherm
