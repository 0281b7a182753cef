#include <algorithm>
#include <cmath>
#include <numbers>

#include "peritherm/geometry/crack.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

std::vector<Point> grown_polyline(const std::vector<Point>& points, const std::vector<double>& arc, double grown) {
  std::vector<Point> line{points[0]};
  for (std::size_t k = 1; k < points.size() && arc[k - 1] < grown; ++k) {
    const double part = (grown - arc[k - 1]) / (arc[k] - arc[k - 1]);
    line.push_back(part < 1.0 ? between(points[k - 1], points[k], part) : points[k]);
  }
  return line;
}

/// Sutherland and Hodgman's clip of a polygon to the corners with depth ≤ limit.
std::vector<Point> clipped(const std::vector<Point>& corners, const std::vector<double>& depths, double limit) {
  std::vector<Point> result;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t next = (k + 1) % corners.size();
    const bool inside = depths[k] <= limit;
    if (inside) result.push_back(corners[k]);
    if (inside == (depths[next] <= limit)) continue;
    result.push_back(between(corners[k], corners[next], (limit - depths[k]) / (depths[next] - depths[k])));
  }
  return result;
}

std::vector<Point> circle(const Point& centre, const Point& along, const Point& across, double radius) {
  constexpr int corners = 64;
  std::vector<Point> result;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners;
    Point x = centre;
    for (int axis = 0; axis < 3; ++axis) {
      x[axis] += radius * (std::cos(angle) * along[axis] + std::sin(angle) * across[axis]);
    }
    result.push_back(x);
  }
  return result;
}

}  // namespace

std::vector<Point> CrackSurface::corners(double time) const {
  const bool grows = tip_speed_ > 0.0;
  if (time < start_time_ || (grows && time == start_time_ && dimension_ > 1)) return {};
  if (!grows || dimension_ == 1 || radius_ > 0.0) return points_;
  const double grown = (time - start_time_) * tip_speed_;
  if (dimension_ == 2) return grown_polyline(points_, arc_, grown);
  std::vector<double> depths;
  for (const auto& corner : plane_corners_) depths.push_back(corner[1]);
  return clipped(points_, depths, grown);
}

double CrackSurface::radius(double time) const {
  return tip_speed_ > 0.0 ? std::min(radius_, std::max(0.0, time - start_time_) * tip_speed_) : radius_;
}

std::vector<std::vector<Point>> CrackSurface::outline(double time) const {
  std::vector<Point> shape = corners(time);
  if (shape.empty()) return {};
  if (radius_ > 0.0) return {circle(points_[0], along_, across_, radius(time))};
  return {std::move(shape)};
}

std::vector<CrackTip> CrackSurface::tips(double time) const {
  if (dimension_ != 2) return {};
  const std::vector<std::vector<Point>> lines = outline(time);
  if (lines.empty() || lines[0].front() == lines[0].back()) return {};
  const std::vector<Point>& line = lines[0];
  return {{0, line.front(), unit_vector(difference(line[0], line[1]))},
          {1, line.back(), unit_vector(difference(line.back(), line[line.size() - 2])),
           line.back() == points_.back() ? 0.0 : tip_speed_}};
}

}  // namespace peritherm
