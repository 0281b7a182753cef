#include "peritherm/discretisation/face_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/geometry/plane_polygon.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double on_line = 1e-9;   ///< spacings
constexpr double on_piece = 1e-6;  ///< spacings; corners belong to the crack, so that none leaks

Point any_direction_across(const Point& a) {
  return unit_vector(cross(std::abs(a[0]) > 0.5 ? Point{0.0, 1.0, 0.0} : Point{1.0, 0.0, 0.0}, a));
}

}  // namespace

FacePiece::FacePiece(int dimension, std::vector<Point> corners, const Point& normal, double radius,
                     std::vector<bool> joined, double shift, double strength, double exchange)
    : dimension_(dimension),
      corners_(std::move(corners)),
      normal_(normal),
      radius_(radius),
      joined_(std::move(joined)),
      shift_(shift),
      strength_(strength),
      exchange_(exchange) {
  lower_.fill(-infinite);
  upper_.fill(infinite);
  if (dimension_ == 2) {
    tangents_[0] = {normal_[1], -normal_[0], 0.0};
    length_ = length(difference(corners_[1], corners_[0]));
  } else if (dimension_ == 3) {
    tangents_[0] = radius_ > 0.0 ? any_direction_across(normal_) : unit_vector(difference(corners_[1], corners_[0]));
    tangents_[1] = cross(normal_, tangents_[0]);
    for (const Point& corner : corners_) {
      const Point arm = difference(corner, corners_[0]);
      plane_corners_.push_back({dot(arm, tangents_[0]), dot(arm, tangents_[1])});
    }
  }
}

double FacePiece::height(const Point& x) const { return dot(difference(x, corners_[0]), normal_); }

Point FacePiece::mirrored(const Point& x) const { return added(x, scaled(normal_, -2.0 * height(x))); }

/// Distance in the plane to an edge; infinite if there is none that counts.
double FacePiece::distance_to_edges(double along, double across, bool fronts_only) const {
  double nearest = infinite;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    if (fronts_only && joined_[k]) continue;
    const Point& first = corners_[k];
    const Point& second = corners_[(k + 1) % corners_.size()];
    const Point x = added(corners_[0], added(scaled(tangents_[0], along), scaled(tangents_[1], across)));
    const Point edge = difference(second, first), arm = difference(x, first);
    const double share = std::clamp(dot(arm, edge) / dot(edge, edge), 0.0, 1.0);
    nearest = std::min(nearest, length(difference(arm, scaled(edge, share))));
  }
  return nearest;
}

double FacePiece::depth_in_polygon(double along, double across) const {
  if (radius_ > 0.0) return radius_ - std::hypot(along, across);
  const bool inside = plane_polygon_contains(plane_corners_, along, across, on_piece);
  return inside ? distance_to_edges(along, across, true) : -distance_to_edges(along, across, false);
}

double FacePiece::depth(const Point& x) const {
  const Point arm = difference(x, corners_[0]);
  if (dimension_ == 1) return infinite;
  if (dimension_ == 3) return depth_in_polygon(dot(arm, tangents_[0]), dot(arm, tangents_[1]));
  const double along = dot(arm, tangents_[0]);
  if (joined_[0] && along < -on_piece) return -infinite;
  if (joined_[1] && along > length_ + on_piece) return -infinite;
  return std::min(joined_[0] ? infinite : along, joined_[1] ? infinite : length_ - along);
}

double FacePiece::ramp(double depth) const { return std::clamp(depth - shift_ + 0.5, 0.0, 1.0); }

double FacePiece::share_on(const Point& x) const {
  if (dimension_ != 2) return strength_ * ramp(depth(x));
  const double along = dot(difference(x, corners_[0]), tangents_[0]);
  if (joined_[0] && along < -on_piece) return 0.0;
  if (joined_[1] && along > length_ + on_piece) return 0.0;
  const double first = joined_[0] ? 1.0 : ramp(along), last = joined_[1] ? 1.0 : ramp(length_ - along);
  return strength_ * std::max(0.0, first + last - 1.0);
}

double FacePiece::share_at(const Point& x) const { return is_in_box(x) ? share_on(x) : 0.0; }

bool FacePiece::is_in_box(const Point& x) const {
  for (int axis = 0; axis < dimension_; ++axis) {
    if (x[axis] < lower_[axis] - on_piece || x[axis] > upper_[axis] + on_piece) return false;
  }
  return true;
}

bool FacePiece::crosses_plane(const Point& a, const Point& b, double& place, Point& x) const {
  const double height_a = height(a), height_b = height(b);
  // Places on the line ahead of a tip count as above it, whatever their rounding.
  if ((height_a >= -on_line) == (height_b >= -on_line)) return false;
  place = std::clamp(height_a / (height_a - height_b), 0.0, 1.0);
  x = between(a, b, place);
  return is_in_box(x);
}

FacePiece::Cut FacePiece::cut(const Point& a, const Point& b, double conductivity) const {
  Cut found;
  Point x;
  if (!crosses_plane(a, b, found.place, x)) return {};
  found.share = share_on(x);
  if (exchange_ > 0.0) {
    const double passed = exchange_ * std::abs(dot(difference(b, a), normal_));
    found.share *= conductivity / (passed + conductivity);
  }
  return found;
}

double FacePiece::jump(double conductivity) const {
  return exchange_ > 0.0 && strength_ == 1.0 ? conductivity / exchange_ : 0.0;
}

bool FacePiece::meets(const Point& a, const Point& b, double ahead) const {
  double place = 0.0;
  Point x;
  return crosses_plane(a, b, place, x) && depth(x) >= -ahead;
}

double FacePiece::distance_to(const Point& x) const {
  const double above = height(x);
  if (dimension_ == 1) return std::abs(above);
  const Point arm = difference(x, corners_[0]);
  const double along = dot(arm, tangents_[0]);
  if (dimension_ == 2) return std::hypot(above, along - std::clamp(along, 0.0, length_));
  const double inside = depth_in_polygon(along, dot(arm, tangents_[1]));
  return std::hypot(above, std::min(0.0, inside));
}

double FacePiece::distance_to_tip(const Point& x) const {
  if (dimension_ == 1) return infinite;
  if (dimension_ == 2) {
    double nearest = infinite;
    for (int end = 0; end < 2; ++end) {
      if (!joined_[end]) nearest = std::min(nearest, length(difference(x, corners_[end])));
    }
    return nearest;
  }
  const Point arm = difference(x, corners_[0]);
  const double along = dot(arm, tangents_[0]), across = dot(arm, tangents_[1]);
  const double in_plane = radius_ > 0.0 ? radius_ - std::hypot(along, across) : distance_to_edges(along, across, true);
  return std::hypot(height(x), in_plane);
}

FacePiece FacePiece::image(int axis, double wall) const {
  const auto reflect = [axis, wall](Point x) {
    x[axis] = 2.0 * wall - x[axis];
    return x;
  };
  FacePiece other = *this;
  for (Point& corner : other.corners_) corner = reflect(corner);
  other.normal_[axis] = -normal_[axis];
  for (Point& tangent : other.tangents_) tangent[axis] = -tangent[axis];
  other.lower_[axis] = 2.0 * wall - upper_[axis];
  other.upper_[axis] = 2.0 * wall - lower_[axis];
  return other;
}

void FacePiece::confine(const Point& lower, const Point& upper) {
  lower_ = lower;
  upper_ = upper;
}

bool FacePiece::touches(const Point& x, double tolerance) const { return is_in_box(x) && distance_to(x) <= tolerance; }

std::array<Point, 2> FacePiece::bounds() const {
  std::array<Point, 2> box{corners_[0], corners_[0]};
  for (int axis = 0; axis < 3; ++axis) {
    for (const Point& corner : corners_) {
      box[0][axis] = std::min(box[0][axis], corner[axis]);
      box[1][axis] = std::max(box[1][axis], corner[axis]);
    }
    const double half = radius_ * std::sqrt(std::max(0.0, 1.0 - normal_[axis] * normal_[axis]));
    box[0][axis] -= half;
    box[1][axis] += half;
  }
  return box;
}

std::vector<FacePiece::Tip> FacePiece::tips() const {
  std::vector<Tip> found;
  if (dimension_ != 2) return found;
  if (!joined_[0]) found.push_back({corners_[0], scaled(tangents_[0], -1.0), false});
  if (!joined_[1]) found.push_back({corners_[1], tangents_[0], true});
  return found;
}

Point in_spacings(const Grid& grid, const Point& x) {
  Point place{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    place[axis] = (x[axis] - grid.origin[axis]) / grid.spacing - grid.first_depth();
  }
  return place;
}

}  // namespace peritherm
