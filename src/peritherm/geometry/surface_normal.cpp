#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "peritherm/geometry/plane_polygon.hpp"
#include "peritherm/geometry/region.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// A smooth piece of a surface near the place that is asked about.
struct SurfacePiece {
  Point normal;     ///< outward, of length 1; 0 at the centre of something round
  double distance;  ///< of the place from the piece, or less where the place is far beyond its edge
};
using SurfacePieces = std::vector<SurfacePiece>;

void append_pieces(const Box& box, const Point& x, SurfacePieces& pieces) {
  for (std::size_t axis = 0; axis < box.from.size(); ++axis) {
    Point normal{};
    normal[axis] = -1.0;
    pieces.push_back({normal, std::abs(box.from[axis] - x[axis])});
    normal[axis] = 1.0;
    pieces.push_back({normal, std::abs(box.to[axis] - x[axis])});
  }
}

void append_pieces(const Ball& ball, const Point& x, SurfacePieces& pieces) {
  Point arm = difference(x, to_point(ball.centre));
  for (std::size_t axis = ball.centre.size(); axis < arm.size(); ++axis) arm[axis] = 0.0;
  pieces.push_back({unit_vector(arm), std::abs(length(arm) - ball.radius)});
}

void append_pieces(const Cylinder& cylinder, const Point& x, SurfacePieces& pieces) {
  const Point from = to_point(cylinder.from);
  const Point axis = difference(to_point(cylinder.to), from);
  const Point direction = unit_vector(axis);
  const Point arm = difference(x, from);
  const double height = dot(arm, direction);
  const Point radial = difference(arm, scaled(direction, height));
  pieces.push_back({unit_vector(radial), std::abs(length(radial) - cylinder.radius)});
  pieces.push_back({scaled(direction, -1.0), std::abs(height)});
  pieces.push_back({direction, std::abs(height - length(axis))});
}

void append_pieces(const HalfSpace& half_space, const Point&, SurfacePieces& pieces) {
  pieces.push_back({unit_vector(to_point(half_space.normal)), 0.0});
}

void append_pieces(const Polygon& polygon, const Point& x, SurfacePieces& pieces) {
  const double turn = twice_signed_area(polygon.points) > 0.0 ? 1.0 : -1.0;
  for (std::size_t k = 0; k < polygon.points.size(); ++k) {
    const Coordinates& p = polygon.points[k];
    const Coordinates& q = polygon.points[(k + 1) % polygon.points.size()];
    const Point normal = unit_vector({turn * (q[1] - p[1]), turn * (p[0] - q[0]), 0.0});
    pieces.push_back({normal, distance_from_edge(p, q, x[0], x[1])});
  }
}

}  // namespace

Point surface_normal(const Shape& shape, const Point& place, const Point& outwards, double slack) {
  SurfacePieces pieces;
  std::visit([&](const auto& form) { append_pieces(form, place, pieces); }, shape);
  double nearest = std::numeric_limits<double>::infinity();
  for (const SurfacePiece& piece : pieces) nearest = std::min(nearest, piece.distance);
  const double grazing = 1e-9 * length(outwards);
  Point sum{};
  for (const SurfacePiece& piece : pieces) {
    if (piece.distance > nearest + slack || dot(piece.normal, outwards) <= grazing) continue;
    for (std::size_t axis = 0; axis < sum.size(); ++axis) sum[axis] += piece.normal[axis];
  }
  return unit_vector(sum);
}

}  // namespace peritherm
