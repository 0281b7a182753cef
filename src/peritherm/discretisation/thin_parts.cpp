#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "peritherm/discretisation/sub_domains.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// Lengths in horizons may fall short by this.
constexpr double thickness_slack = 1e-6;

/// Surface of one part in buckets as wide as its horizon.
class SurfaceBuckets {
 public:
  SurfaceBuckets(const DividedBody& body, int part, double width) : dimension_(body.dimension), width_(width) {
    for (const SurfacePoint& point : body.surface) {
      if (point.first == part || point.second == part) points_[key(bucket_of(point.position))].push_back(&point);
    }
  }

  /// Distance from the nearest piece of surface, but at most a bucket's width.
  double depth(const Point& x) const {
    const GridIndex centre = bucket_of(x);
    const int reach[] = {1, dimension_ > 1 ? 1 : 0, dimension_ > 2 ? 1 : 0};
    double nearest = width_;
    for (int dz = -reach[2]; dz <= reach[2]; ++dz) {
      for (int dy = -reach[1]; dy <= reach[1]; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const auto found = points_.find(key({centre[0] + dx, centre[1] + dy, centre[2] + dz}));
          if (found == points_.end()) continue;
          for (const SurfacePoint* point : found->second) nearest = std::min(nearest, distance(*point, x));
        }
      }
    }
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

  GridIndex bucket_of(const Point& x) const {
    GridIndex bucket{};
    for (int axis = 0; axis < dimension_; ++axis) bucket[axis] = static_cast<int>(std::floor(x[axis] / width_));
    return bucket;
  }

  static std::int64_t key(const GridIndex& bucket) {
    constexpr std::int64_t stride = std::int64_t{1} << 21;
    return (bucket[2] * stride + bucket[1]) * stride + bucket[0];
  }

  int dimension_;
  double width_;
  std::unordered_map<std::int64_t, std::vector<const SurfacePoint*>> points_;
};

ThinPart thickness_of_rod(const SubDomain& part) {
  double length_of_part = 0.0;
  for (const double volume : part.volumes) length_of_part += volume;
  return {0, length_of_part, 4.0 * part.horizon};
}

/// Points stand half a spacing below a surface; twice the largest depth is the thickness, to a spacing.
ThinPart thickness_of_part(const DividedBody& body, std::size_t number) {
  const SubDomain& part = body.parts[number];
  const SurfaceBuckets surface(body, static_cast<int>(number), part.horizon);
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
