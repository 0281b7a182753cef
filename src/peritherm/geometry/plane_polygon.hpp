#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace peritherm {

/// Distance in the plane of (x, y) from the segment between two corners (anything with two entries).
template <class Corner>
double distance_from_edge(const Corner& first, const Corner& second, double x, double y) {
  const double along_x = second[0] - first[0];
  const double along_y = second[1] - first[1];
  const double square = along_x * along_x + along_y * along_y;
  const double foot = ((x - first[0]) * along_x + (y - first[1]) * along_y) / square;
  const double inside = square > 0.0 ? std::clamp(foot, 0.0, 1.0) : 0.0;
  return std::hypot(x - first[0] - inside * along_x, y - first[1] - inside * along_y);
}

/// Is (x, y) inside (even-odd rule) or at most `slack` away from an edge?
template <class Corners>
bool plane_polygon_contains(const Corners& corners, double x, double y, double slack) {
  bool inside = false;
  for (std::size_t k = 0, before = corners.size() - 1; k < corners.size(); before = k++) {
    const auto& p = corners[before];
    const auto& q = corners[k];
    if (y < std::min(p[1], q[1]) - slack || y > std::max(p[1], q[1]) + slack) continue;
    const bool straddles = (p[1] > y) != (q[1] > y);
    if (straddles && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])) inside = !inside;
    const bool near = x >= std::min(p[0], q[0]) - slack && x <= std::max(p[0], q[0]) + slack;
    if (near && distance_from_edge(p, q, x, y) <= slack) return true;
  }
  return inside;
}

/// Twice the signed area, positive if the corners run counter-clockwise.
template <class Corners>
double twice_signed_area(const Corners& corners) {
  double sum = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto& p = corners[k];
    const auto& q = corners[(k + 1) % corners.size()];
    // Relative to the first corner, so that a polygon far from the origin loses no digits.
    sum += (p[0] - corners[0][0]) * (q[1] - corners[0][1]) - (q[0] - corners[0][0]) * (p[1] - corners[0][1]);
  }
  return sum;
}

/// Largest extent along an axis of the plane.
template <class Corners>
double extent_of(const Corners& corners) {
  double extent = 0.0;
  for (const auto& corner : corners) {
    extent = std::max({extent, std::abs(corner[0] - corners[0][0]), std::abs(corner[1] - corners[0][1])});
  }
  return extent;
}

/// Which side of the line through two corners the third lies on: -1, 0 or 1.
template <class Corner>
int side_of(const Corner& first, const Corner& second, const Corner& third) {
  const double area = (second[0] - first[0]) * (third[1] - first[1]) - (second[1] - first[1]) * (third[0] - first[0]);
  return area > 0.0 ? 1 : (area < 0.0 ? -1 : 0);
}

/// Do two closed segments have a point in common?
template <class Corner>
bool segments_meet(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  for (int axis = 0; axis < 2; ++axis) {
    if (std::max(a[axis], b[axis]) < std::min(c[axis], d[axis])) return false;
    if (std::max(c[axis], d[axis]) < std::min(a[axis], b[axis])) return false;
  }
  return side_of(a, b, c) * side_of(a, b, d) <= 0 && side_of(c, d, a) * side_of(c, d, b) <= 0;
}

/// Do two edges meet anywhere but at the corner that neighbours share?
template <class Corners>
bool crosses_itself(const Corners& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto& p = corners[i];
    const auto& q = corners[(i + 1) % n];
    const auto& r = corners[(i + 2) % n];
    const double turn_back = (q[0] - p[0]) * (r[0] - q[0]) + (q[1] - p[1]) * (r[1] - q[1]);
    if (side_of(p, q, r) == 0 && turn_back < 0.0) return true;
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segments_meet(p, q, corners[j], corners[(j + 1) % n])) return true;
    }
  }
  return false;
}

}  // namespace peritherm
