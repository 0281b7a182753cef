#pragma once

#include <cmath>

#include "peritherm/base/field.hpp"

namespace peritherm {

inline Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point added(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
inline Point scaled(const Point& a, double factor) { return {factor * a[0], factor * a[1], factor * a[2]}; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// The point at the share u of the way from a to b.
inline Point between(const Point& a, const Point& b, double u) {
  return {a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1]), a[2] + u * (b[2] - a[2])};
}

inline Point unit_vector(const Point& x) {
  const double size = length(x);
  return size > 0.0 ? scaled(x, 1.0 / size) : Point{};
}

}  // namespace peritherm
