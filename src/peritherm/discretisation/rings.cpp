#include "peritherm/discretisation/rings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "peritherm/base/text.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
/// Between points of neighbouring circles, so that they do not stand in rows.
constexpr double golden_angle = 2.399963229728653;
/// Spacings between points of a surface: as far as linear traces of both sides resolve, near which rows of a system of
/// contacts are still far from dependent.
constexpr double surface_spacing = 1.5;

Point on_circle(const Point& centre, double radius, double angle) {
  return {centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle), 0.0};
}

class RingBuilder {
 public:
  RingBuilder(const Grid& box, const PartBackground& background, const std::vector<PartRegion>& regions,
              std::vector<Issue>& issues)
      : box_(box), background_(background), regions_(regions), issues_(issues) {}

  DividedBody build() {
    body_.dimension = box_.dimension;
    const std::size_t faults = issues_.size();
    inspect_body();
    for (const PartRegion& region : regions_) inspect(region);
    if (issues_.size() > faults) return {};
    centre_ = to_point(ball_of(regions_.front()).centre);
    for (std::size_t n = 0; n < regions_.size(); ++n) add_disc(n);
    return std::move(body_);
  }

 private:
  static const Ball& ball_of(const PartRegion& region) { return std::get<Ball>(region.shape); }
  double spacing_of(const PartRegion& region) const { return region.spacing > 0.0 ? region.spacing : box_.spacing; }

  void refuse(const PartRegion& region, const std::string& problem, const std::string& hint) {
    issues_.push_back({region.where, "region '" + region.name + "' " + problem, hint});
  }

  void inspect_body() {
    if (box_.dimension != 2) {
      issues_.push_back(
          {{}, "rings of points need a body in 2-D", "Use points = \"grid\"; surfaces may cut its cells"});
    }
    if (background_.material != no_material) {
      issues_.push_back({{},
                         "a body with rings of points has a material outside them",
                         "Leave the rest of the box void, or use points = \"grid\" throughout"});
    }
  }

  void inspect(const PartRegion& region) {
    const bool empty = region.material == no_material;
    if (region.points != PartPoints::rings && !empty) {
      return refuse(region, "stands on a grid beside rings of points",
                    "Use points = \"rings\" for all regions, or none");
    }
    if (!std::holds_alternative<Ball>(region.shape)) {
      return refuse(region, "is no ball, but its points stand on rings", "Give a ball, or use points = \"grid\"");
    }
    const Ball& ball = ball_of(region);
    if (const auto* outer = std::get_if<Ball>(&regions_.front().shape)) {
      const Point away = difference(to_point(ball.centre), to_point(outer->centre));
      if (length(away) > 1e-9 * box_.spacing) {
        refuse(region, "does not have the centre of '" + regions_.front().name + "'", "Give rings one centre");
      }
    }
    for (int axis = 0; axis < box_.dimension; ++axis) {
      const double low = ball.centre[static_cast<std::size_t>(axis)] - ball.radius - box_.origin[axis];
      const double over = std::max(-low, low + 2.0 * ball.radius - box_.length(axis));
      if (over > 1e-9 * box_.spacing) {
        return refuse(region, "reaches out of the box by " + shortest(over) + " m", "Let the box hold all of the ball");
      }
    }
    inspect_width(region);
  }

  /// Later discs are cut out of this one.
  double inner_radius(std::size_t number) const {
    double inner = 0.0;
    for (std::size_t n = number + 1; n < regions_.size(); ++n) {
      if (std::holds_alternative<Ball>(regions_[n].shape)) inner = std::max(inner, ball_of(regions_[n]).radius);
    }
    return inner;
  }

  void inspect_width(const PartRegion& region) {
    const auto number = static_cast<std::size_t>(&region - regions_.data());
    const double width = ball_of(region).radius - inner_radius(number);
    if (region.material == no_material || width >= 0.5 * spacing_of(region)) return;
    refuse(region, "has no points: less than a spacing of it is left by later regions",
           "Give regions inside one another from the largest to the smallest, some spacings apart");
  }

  void add_disc(std::size_t number) {
    const PartRegion& region = regions_[number];
    const double outer = ball_of(region).radius;
    const double inner = inner_radius(number);
    const int outside = next_part_;
    const bool empty = region.material == no_material;
    if (!empty) {
      add_rings(region, inner, outer);
      next_part_ = static_cast<int>(body_.parts.size()) - 1;
    } else {
      next_part_ = -1;
    }
    const double coarser = std::max(empty ? 0.0 : spacing_of(region), outside < 0 ? 0.0 : body_.parts[outside].spacing);
    if (outside >= 0) add_circle(outer, coarser, -1.0, outside, next_part_);
    if (outside < 0 && !empty) add_circle(outer, coarser, 1.0, next_part_, -1);
  }

  void add_rings(const PartRegion& region, double inner, double outer) {
    SubDomain part;
    part.name = region.name;
    part.material = region.material;
    part.spacing = spacing_of(region);
    part.horizon = region.horizon > 0.0 ? region.horizon : background_.horizon;
    const int rings = std::max(1, static_cast<int>(std::lround((outer - inner) / part.spacing)));
    const double width = (outer - inner) / rings;
    for (int ring = 0; ring < rings; ++ring) {
      const double radius = inner + (ring + 0.5) * width;
      const int count = std::max(3, static_cast<int>(std::lround(two_pi * radius / part.spacing)));
      for (int n = 0; n < count; ++n) {
        part.positions.push_back(on_circle(centre_, radius, two_pi * n / count + ring * golden_angle));
        part.volumes.push_back(two_pi * radius * width / count);
      }
    }
    body_.parts.push_back(std::move(part));
  }

  /// Points on a circle; `side`: 1 if normals out of `first` point away from the centre, else −1.
  void add_circle(double radius, double spacing, double side, int first, int second) {
    const int count = std::max(4, static_cast<int>(std::lround(two_pi * radius / (surface_spacing * spacing))));
    for (int n = 0; n < count; ++n) {
      const double angle = two_pi * n / count;
      const Point normal{side * std::cos(angle), side * std::sin(angle), 0.0};
      body_.surface.push_back({on_circle(centre_, radius, angle), normal, two_pi * radius / count, first, second, -1});
    }
  }

  const Grid& box_;
  const PartBackground& background_;
  const std::vector<PartRegion>& regions_;
  std::vector<Issue>& issues_;
  Point centre_{};
  int next_part_ = -1;  ///< the disc just added; −1: nothing
  DividedBody body_;
};

}  // namespace

DividedBody divide_into_rings(const Grid& box, const PartBackground& background, const std::vector<PartRegion>& regions,
                              std::vector<Issue>& issues) {
  return RingBuilder(box, background, regions, issues).build();
}

}  // namespace peritherm
