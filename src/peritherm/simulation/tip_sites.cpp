#include "peritherm/simulation/tip_sites.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "peritherm/geometry/plane_polygon.hpp"
#include "peritherm/geometry/vector.hpp"
#include "peritherm/output/interpolation.hpp"
#include "peritherm/simulation/checker.hpp"

namespace peritherm {
namespace {

using Polyline = std::vector<Point>;

/// Farther away the first terms about a tip describe a field no better, and points are plenty [horizons].
constexpr double widest_clearing = 4.0;
/// Nearer than this is there [spacings]; more than what carries cracks beyond the faces that they end on.
constexpr double slack_in_spacings = 1e-4;

/// What is around a tip, at one time.
class TipClearing {
 public:
  TipClearing(const Geometry& geometry, const std::vector<Polyline>& lines)
      : body_(geometry.body),
        held_by_(geometry.held_by),
        lines_(lines),
        horizon_(geometry.stencil_options.horizon),
        slack_(slack_in_spacings * geometry.body.grid.spacing) {}

  bool is_free(const CrackTip& tip, std::size_t crack) const {
    if (distance_to_faces(tip.position) <= slack_ || body_.material_at(tip.position) == no_material) return false;
    for (std::size_t other = 0; other < lines_.size(); ++other) {
      const Polyline rest = other == crack ? behind_the_stretch(tip, lines_[crack]) : lines_[other];
      if (distance_to(rest, tip.position) <= slack_) return false;
    }
    return true;
  }

  TipSite look_around(const CrackTip& tip, std::size_t crack, double time) {
    TipSite site;
    site.crack = static_cast<int>(crack);
    site.end = tip.end;
    site.position = tip.position;
    site.direction = tip.direction;
    // Points on a crack belong to its left, looking from its first to its last point.
    site.angle_on_crack = tip.end == 1 ? std::numbers::pi : -std::numbers::pi;
    site.horizon = horizon_;
    const MaterialIndex material = body_.material_at(tip.position);
    site.conductivity = body_.materials[material].conductivity;
    site.growth = tip.speed * volumetric_heat_capacity(body_.materials[material]) / site.conductivity;
    const CrackSurface& surface = body_.cracks[crack];
    if (surface.transmission() > 0.0) site.fault = "the faces of the crack conduct";
    if (surface.gap_coefficient() > 0.0) site.fault = "the faces of the crack exchange heat";
    if (surface.contact(time) > 0.0) site.fault = "the faces of the crack touch";
    site.clear_radius = widest_clearing * horizon_;
    restrict(site, distance_to_faces(tip.position), 0.0, "a face of the body");
    for (std::size_t other = 0; other < lines_.size(); ++other) {
      if (other != crack) restrict(site, distance_to(lines_[other], tip.position), horizon_, "another crack");
    }
    const Polyline rest = behind_the_stretch(tip, lines_[crack]);
    restrict(site, distance_to(rest, tip.position), horizon_,
             rest.size() == 1 ? "the other end of the crack" : "a corner of the crack");
    if (site.growth > 0.0) restrict(site, 2.0 / site.growth, 0.0, "where heat lags behind the growing tip");
    restrict_to_points(site, material);
    return site;
  }

 private:
  double distance_to_faces(const Point& place) const {
    double least = HUGE_VAL;
    for (int axis = 0; axis < 2; ++axis) {
      const double depth = place[axis] - body_.grid.origin[axis];
      least = std::min({least, depth, body_.grid.length(axis) - depth});
    }
    return least;
  }

  static double distance_to(const Polyline& line, const Point& place) {
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < line.size(); ++k) {
      least = std::min(least, distance_from_edge(line[k], line[std::min(k + 1, line.size() - 1)], place[0], place[1]));
    }
    return least;
  }

  /// A crack from the end of the straight part that leads to a tip on: a single point if all of it is straight.
  Polyline behind_the_stretch(const CrackTip& tip, Polyline line) const {
    if (tip.end == 0) std::reverse(line.begin(), line.end());
    while (line.size() > 1) {
      const Point arm = difference(tip.position, line[line.size() - 2]);
      const double off = arm[0] * tip.direction[1] - arm[1] * tip.direction[0];
      const double onward = dot(difference(line.back(), line[line.size() - 2]), tip.direction);
      if (std::abs(off) > slack_ || onward <= 0.0) break;
      line.pop_back();
    }
    return line;
  }

  /// Within `margin` of what stands at a distance, the field is disturbed.
  static void restrict(TipSite& site, double distance, double margin, const std::string& what) {
    const double radius = std::max(0.0, distance - margin);
    if (radius >= site.clear_radius) return;
    site.clear_radius = radius;
    site.limit = what + ", " + length_text(distance) + " away";
  }

  /// Points of other materials and cut-away ones lie outside; those that are held at most on the rim.
  void restrict_to_points(TipSite& site, MaterialIndex material) const {
    const Grid& grid = body_.grid;
    const Point reach{site.clear_radius, site.clear_radius, 0.0};
    const GridIndex low = nearest_point(grid, difference(site.position, reach));
    const GridIndex high = nearest_point(grid, added(site.position, reach));
    double other = HUGE_VAL, held = HUGE_VAL;
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const std::size_t number = grid.number({i, j, 0});
        const double distance = length(difference(grid.position({i, j, 0}), site.position));
        if (body_.material_of[number] != material) other = std::min(other, distance);
        if (held_by_[number] != HeldPoints::free) held = std::min(held, distance);
      }
    }
    // The interface may be as much as a spacing nearer.
    restrict(site, other, grid.spacing, "another material");
    restrict(site, held, 0.0, "held points");
  }

  const Body& body_;
  const HeldPoints& held_by_;
  const std::vector<Polyline>& lines_;
  double horizon_;
  double slack_;
};

}  // namespace

std::vector<TipSite> tip_sites(const Geometry& geometry, double time) {
  const Body& body = geometry.body;
  if (body.grid.dimension != 2) return {};
  std::vector<Polyline> lines;
  for (const CrackSurface& crack : body.cracks) {
    const auto outline = crack.outline(time);
    lines.push_back(outline.empty() ? Polyline{} : outline[0]);
  }
  TipClearing clearing(geometry, lines);
  std::vector<TipSite> sites;
  for (std::size_t crack = 0; crack < body.cracks.size(); ++crack) {
    for (const CrackTip& tip : body.cracks[crack].tips(time)) {
      if (clearing.is_free(tip, crack)) sites.push_back(clearing.look_around(tip, crack, time));
    }
  }
  return sites;
}

}  // namespace peritherm
