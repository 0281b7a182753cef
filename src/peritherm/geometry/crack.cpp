#include "peritherm/geometry/crack.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "peritherm/geometry/plane_polygon.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

constexpr double relative_tolerance = 1e-9;  // of the spacing
constexpr double nudge_over_tolerance = 1e3;

Point unit(const Point& a) { return scaled(a, 1.0 / length(a)); }

void add(Point& sum, const Point& a, double factor) {
  for (int axis = 0; axis < 3; ++axis) sum[axis] += factor * a[axis];
}

/// Left of the direction from one corner of a polyline to the next, of unit length.
Point left_normal(const Point& first, const Point& second) {
  return unit({first[1] - second[1], second[0] - first[0], 0.0});
}

/// Newell's sum: twice the vector area of a closed polygon, by the right-hand rule.
Point vector_area(const std::vector<Point>& corners) {
  Point sum{};
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    add(sum, cross(difference(corners[k], corners[0]), difference(corners[k + 1], corners[0])), 1.0);
  }
  return sum;
}

/// A unit vector at right angles to another one.
Point any_normal_to(const Point& a) {
  const bool leans_to_x = std::abs(a[0]) > 0.5;
  return unit(cross(leans_to_x ? Point{0.0, 1.0, 0.0} : Point{1.0, 0.0, 0.0}, a));
}

}  // namespace

CrackSurface::CrackSurface(const Crack& crack, int dimension, double spacing)
    : dimension_(dimension),
      tolerance_(relative_tolerance * spacing),
      transmission_(crack.transmission),
      start_time_(crack.start_time),
      tip_speed_(crack.tip_speed.value_or(0.0)) {
  assert(find_fault(crack, dimension).empty());
  for (const Coordinates& point : crack.points) points_.push_back(to_point(point));
  if (crack.disc) {
    points_ = {to_point(crack.disc->centre)};
    radius_ = crack.disc->radius;
    normal_ = unit(to_point(crack.disc->normal));
    along_ = any_normal_to(normal_);
    across_ = cross(normal_, along_);
  } else if (dimension == 3) {
    normal_ = unit(vector_area(points_));
    along_ = unit(difference(points_[1], points_[0]));
    across_ = cross(normal_, along_);
    for (const Point& point : points_) plane_corners_.push_back(in_plane(point));
  }
  adjusts_tips_ = !crack.tip_shift || std::holds_alternative<AutomaticTipShift>(*crack.tip_shift);
  if (follows_temperatures(crack)) radiating_ = std::get<GapRadiation>(*crack.gap);
  if (crack.gap) gap_coefficient_ = peritherm::gap_coefficient(*crack.gap, first_mean_temperature);
  if (crack.contact) contact_changes_ = peritherm::contact_changes(*crack.contact);
  measure_segments();
  too_short_ = dimension > 1 && full_length() < spacing;
  mirrors_ = crack.faces == Faces::mirror && !too_short_;
  lower_ = upper_ = points_[0];
  for (int axis = 0; axis < 3; ++axis) {
    for (const Point& point : points_) {
      lower_[axis] = std::min(lower_[axis], point[axis]);
      upper_[axis] = std::max(upper_[axis], point[axis]);
    }
    const double half_width = radius_ * std::sqrt(std::max(0.0, 1.0 - normal_[axis] * normal_[axis]));
    lower_[axis] -= half_width;
    upper_[axis] += half_width;
  }
}

/// Lengths and directions of a polyline's segments.
void CrackSurface::measure_segments() {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    arc_.push_back(k == 0 ? 0.0 : arc_.back() + length(difference(points_[k], points_[k - 1])));
  }
  for (std::size_t k = 0; dimension_ == 2 && k + 1 < points_.size(); ++k) {
    const double segment_length = arc_[k + 1] - arc_[k];
    directions_.push_back(
        {(points_[k + 1][0] - points_[k][0]) / segment_length, (points_[k + 1][1] - points_[k][1]) / segment_length});
  }
  parts_.resize(std::max<std::size_t>(1, directions_.size()));
  std::iota(parts_.begin(), parts_.end(), 0);
  closed_ = dimension_ == 2 && points_.front() == points_.back();
}

std::array<double, 2> CrackSurface::in_plane(const Point& x) const {
  const Point arm = difference(x, points_[0]);
  return {dot(arm, along_), dot(arm, across_)};
}

bool CrackSurface::contains(const Point& x) const {
  const auto [along, across] = in_plane(x);
  if (radius_ > 0.0) return std::hypot(along, across) <= radius_ + tolerance_;
  return plane_polygon_contains(plane_corners_, along, across, tolerance_);
}

double CrackSurface::time_after(double grown_length) const {
  return tip_speed_ > 0.0 ? start_time_ + std::max(0.0, grown_length) / tip_speed_ : start_time_;
}

double CrackSurface::height_above(int part, const Point& x) const {
  if (dimension_ == 3) return dot(difference(x, points_[0]), normal_);
  if (dimension_ == 1) return x[0] - points_[0][0];
  const auto k = static_cast<std::size_t>(part);
  return directions_[k][0] * (x[1] - points_[k][1]) - directions_[k][1] * (x[0] - points_[k][0]);
}

Point CrackSurface::normal_of(int part) const {
  if (dimension_ == 3) return normal_;
  if (dimension_ == 1) return {1.0, 0.0, 0.0};
  const auto& direction = directions_[static_cast<std::size_t>(part)];
  return {-direction[1], direction[0], 0.0};
}

void CrackSurface::set_mean_temperature(double mean) {
  gap_coefficient_ = peritherm::gap_coefficient(*radiating_, mean);
}

double CrackSurface::transmission(double across, double conductivity) const {
  if (gap_coefficient_ == 0.0) return transmission_;
  const double exchanged = gap_coefficient_ * std::abs(across);
  return transmission_ + (1.0 - transmission_) * exchanged / (exchanged + conductivity);
}

double CrackSurface::contact(double time) const {
  double share = 0.0;
  for (const ContactChange& change : contact_changes_) share = change.time <= time ? change.share : share;
  return share;
}

double CrackSurface::length_to(const Point& x, std::span<const int> parts) const {
  if (dimension_ == 1) return 0.0;
  if (dimension_ == 3) {
    const auto [along, across] = in_plane(x);
    return radius_ > 0.0 ? std::hypot(along, across) : across;
  }
  double nearest = HUGE_VAL, found = 0.0;
  for (const int part : parts) {
    const auto k = static_cast<std::size_t>(part);
    const double distance = distance_from_edge(points_[k], points_[k + 1], x[0], x[1]);
    if (distance >= nearest) continue;
    nearest = distance;
    const double place = directions_[k][0] * (x[0] - points_[k][0]) + directions_[k][1] * (x[1] - points_[k][1]);
    const double longest = k + 2 < points_.size() ? arc_[k + 1] - arc_[k] : HUGE_VAL;
    found = arc_[k] + std::clamp(place, k == 0 ? -HUGE_VAL : 0.0, longest);
  }
  return found;
}

double CrackSurface::end_time() const {
  return tip_speed_ > 0.0 ? start_time_ + full_length() / tip_speed_ : start_time_;
}

double CrackSurface::full_length() const {
  double longest = dimension_ == 2 ? arc_.back() : radius_;
  for (const auto& corner : plane_corners_) longest = std::max(longest, corner[1]);
  return longest;
}

std::optional<CrackPassage> CrackSurface::passage(const Point& a, const Point& b, std::span<const int> parts) const {
  for (int axis = 0; axis < dimension_; ++axis) {
    if (std::max(a[axis], b[axis]) < lower_[axis] - tolerance_) return std::nullopt;
    if (std::min(a[axis], b[axis]) > upper_[axis] + tolerance_) return std::nullopt;
  }
  // Both directions of a bond must give the same bits.
  const bool ordered = a < b;
  const Point& first = ordered ? a : b;
  const Point& second = ordered ? b : a;
  if (dimension_ == 3) return passage_3d(first, second);
  if (dimension_ == 2) return passage_2d(first, second, parts);
  const double position = points_[0][0] - tolerance_;
  if ((first[0] >= position) == (second[0] >= position)) return std::nullopt;
  return CrackPassage{start_time_, 0};
}

// A point that lies on the line of a segment, beyond its ends, counts as on its left: a bond along that line
// crosses nothing, whatever the rounding of its ends.
std::optional<CrackPassage> CrackSurface::passage_2d(const Point& a, const Point& b, std::span<const int> parts) const {
  std::optional<CrackPassage> earliest;
  for (const int part : parts) {
    const double height_a = height_above(part, a);
    const double height_b = height_above(part, b);
    if ((height_a >= -tolerance_) == (height_b >= -tolerance_)) continue;
    const auto k = static_cast<std::size_t>(part);
    const double segment_length = arc_[k + 1] - arc_[k];
    const Point x = between(a, b, std::clamp(height_a / (height_a - height_b), 0.0, 1.0));
    const double place = directions_[k][0] * (x[0] - points_[k][0]) + directions_[k][1] * (x[1] - points_[k][1]);
    // Corners belong to the crack, so that none leaks; its two ends do not.
    const double first = k == 0 && !closed_ ? tolerance_ : -tolerance_;
    const double last = k + 2 == points_.size() && !closed_ ? -tolerance_ : tolerance_;
    if (place < first || place > segment_length + last) continue;
    const double time = time_after(arc_[k] + place);
    if (!earliest || time < earliest->time) earliest = CrackPassage{time, part};
  }
  return earliest;
}

std::optional<CrackPassage> CrackSurface::passage_3d(const Point& a, const Point& b) const {
  const double height_a = height_above(0, a);
  const double height_b = height_above(0, b);
  if ((height_a >= -tolerance_) == (height_b >= -tolerance_)) return std::nullopt;
  const Point x = between(a, b, std::clamp(height_a / (height_a - height_b), 0.0, 1.0));
  if (!contains(x)) return std::nullopt;
  const auto [along, across] = in_plane(x);
  return CrackPassage{time_after(radius_ > 0.0 ? std::hypot(along, across) : across), 0};
}

void CrackSurface::nudge(const Point& point, Point& shift, std::span<const int> parts) const {
  for (int axis = 0; axis < dimension_; ++axis) {
    if (point[axis] < lower_[axis] - tolerance_ || point[axis] > upper_[axis] + tolerance_) return;
  }
  const double distance = nudge_over_tolerance * tolerance_;
  if (dimension_ == 1) {
    shift[0] += distance;
  } else if (dimension_ == 3) {
    const bool in_crack_plane = std::abs(height_above(0, point)) <= tolerance_;
    if (in_crack_plane && contains(point)) add(shift, normal_, distance);
  } else {
    Point normals{};
    Point last{};
    for (const int part : parts) {
      // Far from the line is far from the segment, and cheaper to tell.
      if (std::abs(height_above(part, point)) > 2.0 * tolerance_) continue;
      const auto k = static_cast<std::size_t>(part);
      if (distance_from_edge(points_[k], points_[k + 1], point[0], point[1]) > tolerance_) continue;
      last = left_normal(points_[k], points_[k + 1]);
      add(normals, last, 1.0);
    }
    if (last == Point{}) return;
    // Where a polyline turns straight back the normals cancel, and either side will do.
    add(shift, length(normals) > 1e-6 ? unit(normals) : last, distance);
  }
}

std::array<Point, 2> CrackSurface::bounds() const { return {lower_, upper_}; }

}  // namespace peritherm
