#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/place_buckets.hpp"
#include "peritherm/discretisation/sub_domains.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// Lengths in horizons may fall short by this.
constexpr double thickness_slack = 1e-6;

/// Surface of one part in buckets as wide as its horizon.
class PartSurface {
 public:
  PartSurface(const DividedBody& body, int part, double width)
      : dimension_(body.dimension), width_(width), pieces_(body.dimension, width) {
    for (const SurfacePoint& piece : body.surface) {
      if (piece.first == part || piece.second == part) pieces_.add(piece.position, &piece);
    }
  }

  /// Distance from the nearest piece of surface, but at most a bucket's width.
  double depth(const Point& x) const {
    double nearest = width_;
    pieces_.for_each_near(x, [&](const SurfacePoint* piece) { nearest = std::min(nearest, distance(*piece, x)); });
    return nearest;
  }

 private:
  /// From a plane disc about as large as the piece.
  double distance(const SurfacePoint& point, const Point& x) const {
    const Point arm = difference(x, point.position);
    const double height = dot(arm, point.normal);
    const double lateral = std::sqrt(std::max(0.0, dot(arm, arm) - height * height));
    const double radius = dimension_ == 2 ? 0.5 * point.area : std::sqrt(0.5 * point.area);
    return std::hypot(height, std::max(0.0, lateral - radius));
  }

  int dimension_;
  double width_;
  PlaceBuckets<const SurfacePoint*> pieces_;
};

ThinPart thickness_of_rod(const SubDomain& part) {
  double length_of_part = 0.0;
  for (const double volume : part.volumes) length_of_part += volume;
  return {0, length_of_part, 4.0 * part.horizon};
}

/// Points stand half a spacing below a surface; twice the largest depth is the thickness, to a spacing.
ThinPart thickness_of_part(const DividedBody& body, std::size_t number) {
  const SubDomain& part = body.parts[number];
  const PartSurface surface(body, static_cast<int>(number), part.horizon);
  const double enough = part.horizon * (1.0 - thickness_slack) - 0.5 * part.spacing;
  double deepest = 0.0;
  for (const Point& x : part.positions) {
    deepest = std::max(deepest, surface.depth(x));
    if (deepest >= enough) break;
  }
  return {number, 2.0 * deepest + part.spacing, 2.0 * part.horizon};
}

}  // namespace

std::vector<ThinPart> find_thin_parts(const DividedBody& body) {
  std::vector<ThinPart> thin;
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    ThinPart found = body.dimension == 1 ? thickness_of_rod(body.parts[p]) : thickness_of_part(body, p);
    found.part = p;
    if (found.thickness < (1.0 - thickness_slack) * found.needed) thin.push_back(found);
  }
  return thin;
}

}  // namespace peritherm
