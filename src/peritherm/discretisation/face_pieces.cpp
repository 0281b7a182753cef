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

double FacePiece::depth_in_polygon(double along, double across) const {
  if (radius_ > 0.0) return radius_ - std::hypot(along, across);
  const bool inside = plane_polygon_contains(plane_corners_, along, across, on_piece);
  double nearest = infinite;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    if (inside && joined_[k]) continue;
    const Point& first = corners_[k];
    const Point& second = corners_[(k + 1) % corners_.size()];
    const Point x = added(corners_[0], added(scaled(tangents_[0], along), scaled(tangents_[1], across)));
    const Point edge = difference(second, first), arm = difference(x, first);
    const double share = std::clamp(dot(arm, edge) / dot(edge, edge), 0.0, 1.0);
    nearest = std::min(nearest, length(difference(arm, scaled(edge, share))));
  }
  return inside ? nearest : -nearest;
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

double FacePiece::ramp(double depth) const { return strength_ * std::clamp(depth - shift_ + 0.5, 0.0, 1.0); }

double FacePiece::share_at(const Point& x) const { return is_in_box(x) ? ramp(depth(x)) : 0.0; }

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
  found.share = ramp(depth(x));
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
  return std::hypot(height(x), depth_in_polygon(dot(arm, tangents_[0]), dot(arm, tangents_[1])));
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

namespace {

/// A piece before it is known which of its ends are tips.
struct PieceDraft {
  std::size_t crack;
  std::vector<Point> corners;
  Point normal;
  double radius;
  std::vector<bool> joined;
};

constexpr double same_place = 1e-3;  ///< spacings; no grid tells such places apart

/// What of a segment or polygon lies inside the box: Sutherland and Hodgman's clip, wall by wall.
std::vector<Point> clipped_to_box(const Body& body, std::vector<Point> corners, bool closed) {
  for (int face = 0; face < 2 * body.grid.dimension; ++face) {
    const int axis = face / 2;
    const double wall = face % 2 == 0 ? -body.grid.first_depth() : body.grid.cells[axis] - body.grid.first_depth();
    const auto depth = [&](const Point& x) { return face % 2 == 0 ? x[axis] - wall : wall - x[axis]; };
    std::vector<Point> inside;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (depth(corners[k]) >= 0.0) inside.push_back(corners[k]);
      if (!closed && k + 1 == corners.size()) break;
      const Point& next = corners[(k + 1) % corners.size()];
      const double here = depth(corners[k]), there = depth(next);
      if ((here >= 0.0) == (there >= 0.0)) continue;
      inside.push_back(between(corners[k], next, here / (here - there)));
    }
    corners = std::move(inside);
  }
  const auto same = [](const Point& a, const Point& b) { return length(difference(a, b)) < on_piece; };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  while (closed && corners.size() > 1 && same(corners.front(), corners.back())) corners.pop_back();
  return corners;
}

void append_drafts(const Body& body, std::size_t crack, std::vector<PieceDraft>& drafts) {
  const CrackSurface& surface = body.cracks[crack];
  std::vector<Point> corners = surface.corners(HUGE_VAL);
  for (Point& corner : corners) corner = in_spacings(body.grid, corner);
  if (corners.empty()) return;
  const double radius = surface.radius(HUGE_VAL) / body.grid.spacing;
  if (body.grid.dimension != 2) {
    if (body.grid.dimension == 3 && radius == 0.0) corners = clipped_to_box(body, std::move(corners), true);
    if (body.grid.dimension == 3 && radius == 0.0 && corners.size() < 3) return;
    std::vector<bool> joined(corners.size(), false);
    drafts.push_back({crack, std::move(corners), surface.normal_of(0), radius, std::move(joined)});
    return;
  }
  const bool closed = length(difference(corners.front(), corners.back())) < same_place;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    std::vector<Point> segment = clipped_to_box(body, {corners[k], corners[k + 1]}, false);
    if (segment.size() < 2 || !(length(difference(segment[1], segment[0])) > same_place)) continue;
    drafts.push_back({crack,
                      std::move(segment),
                      surface.normal_of(static_cast<int>(k)),
                      0.0,
                      {k > 0 || closed, k + 2 < corners.size() || closed}});
  }
}

/// Where an end is on a wall, on another crack or beyond, the crack has no tip.
class TipSearch {
 public:
  TipSearch(const Body& body, const std::vector<PieceDraft>& drafts, std::span<const double> shifts)
      : body_(body), drafts_(drafts), shifts_(shifts) {
    for (const PieceDraft& draft : drafts) {
      pieces_.emplace_back(body.grid.dimension, draft.corners, draft.normal, draft.radius, draft.joined, 0.0);
    }
    for (int axis = 0; axis < body.grid.dimension; ++axis) {
      lower_[axis] = -body.grid.first_depth();
      upper_[axis] = body.grid.cells[axis] - body.grid.first_depth();
    }
  }

  std::vector<bool> joined(std::size_t n) const {
    std::vector<bool> found = drafts_[n].joined;
    const std::vector<Point>& corners = drafts_[n].corners;
    for (std::size_t k = 0; k < found.size() && body_.grid.dimension > 1; ++k) {
      if (body_.grid.dimension == 2) {
        found[k] = found[k] || ends_on_something(n, corners[k]) || overshoots(n, corners[k], corners[1 - k]);
        continue;
      }
      const Point& next = corners[(k + 1) % corners.size()];
      found[k] = drafts_[n].radius == 0.0 && ends_on_something(n, corners[k]) && ends_on_something(n, next) &&
                 ends_on_something(n, between(corners[k], next, 0.5));
    }
    return found;
  }

  const Point& lower() const { return lower_; }
  const Point& upper() const { return upper_; }

 private:
  bool ends_on_something(std::size_t n, const Point& x) const {
    for (int axis = 0; axis < body_.grid.dimension; ++axis) {
      if (x[axis] < lower_[axis] + same_place || x[axis] > upper_[axis] - same_place) return true;
    }
    for (std::size_t other = 0; other < pieces_.size(); ++other) {
      if (!are_neighbours(n, other) && pieces_[other].touches(x, same_place)) return true;
    }
    return false;
  }

  /// Pieces of one polyline that share a corner, or are the same.
  bool are_neighbours(std::size_t n, std::size_t other) const {
    const std::size_t between_them = n > other ? n - other : other - n;
    return between_them == 0 || (between_them == 1 && drafts_[n].crack == drafts_[other].crack);
  }

  /// An end that juts out beyond another piece by less than tips are pulled back by would open the junction.
  bool overshoots(std::size_t n, const Point& end, const Point& inner) const {
    const double reach = std::max(0.0, shifts_[drafts_[n].crack]) + 1.0;
    const Point before = between(end, inner, std::min(1.0, reach / length(difference(inner, end))));
    for (std::size_t other = 0; other < pieces_.size(); ++other) {
      if (!are_neighbours(n, other) && pieces_[other].meets(before, end, 0.0)) return true;
    }
    return false;
  }

  const Body& body_;
  const std::vector<PieceDraft>& drafts_;
  std::span<const double> shifts_;
  std::vector<FacePiece> pieces_;
  Point lower_{}, upper_{};
};

/// Adds what mirrors show of the pieces, axis by axis; a piece in the wall itself has no image of its own.
void append_images(const Body& body, const TipSearch& box, double reach, std::vector<FacePiece>& pieces) {
  for (int axis = 0; axis < body.grid.dimension; ++axis) {
    const std::size_t count = pieces.size();
    for (const int side : {0, 1}) {
      if (body.walls[2 * axis + side].open) continue;
      const double wall = side == 0 ? box.lower()[axis] : box.upper()[axis];
      for (std::size_t n = 0; n < count; ++n) {
        const auto bounds = pieces[n].bounds();
        const double gap = side == 0 ? bounds[0][axis] - wall : wall - bounds[1][axis];
        const double thickness = bounds[1][axis] - bounds[0][axis];
        const bool in_wall = thickness < 1e-6 && std::abs(gap) < 1e-6;
        if (gap < reach && !in_wall) pieces.push_back(pieces[n].image(axis, wall));
      }
    }
  }
}

}  // namespace

Point in_spacings(const Grid& grid, const Point& x) {
  Point place{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    place[axis] = (x[axis] - grid.origin[axis]) / grid.spacing - grid.first_depth();
  }
  return place;
}

std::vector<FacePiece> make_face_pieces(const Body& body, std::span<const double> shifts, double reach,
                                        const CrackChoice& choice) {
  std::vector<PieceDraft> drafts;
  for (std::size_t crack = 0; crack < body.cracks.size(); ++crack) {
    if (choice.there.empty() || choice.there[crack]) append_drafts(body, crack, drafts);
  }
  const TipSearch search(body, drafts, shifts);
  std::vector<FacePiece> pieces;
  for (std::size_t n = 0; n < drafts.size(); ++n) {
    const PieceDraft& draft = drafts[n];
    if (shifts[draft.crack] < 0.0) continue;
    const CrackSurface& crack = body.cracks[draft.crack];
    const double open = 1.0 - (choice.touching ? crack.contact(choice.time) : 0.0);
    pieces.emplace_back(body.grid.dimension, draft.corners, draft.normal, draft.radius, search.joined(n),
                        shifts[draft.crack], open * (1.0 - crack.transmission()),
                        crack.gap_coefficient() * body.grid.spacing);
    pieces.back().set_crack(draft.crack);
    pieces.back().confine(search.lower(), search.upper());
  }
  append_images(body, search, reach, pieces);
  return pieces;
}

}  // namespace peritherm
