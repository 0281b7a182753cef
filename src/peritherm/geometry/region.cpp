#include "peritherm/geometry/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/geometry/plane_polygon.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

bool is_inside(const Box& box, const Point& x, double slack) {
  for (std::size_t axis = 0; axis < box.from.size(); ++axis) {
    if (x[axis] < box.from[axis] - slack || x[axis] > box.to[axis] + slack) return false;
  }
  return true;
}

bool is_inside(const Ball& ball, const Point& x, double slack) {
  double square = 0.0;
  for (std::size_t axis = 0; axis < ball.centre.size(); ++axis) {
    square += (x[axis] - ball.centre[axis]) * (x[axis] - ball.centre[axis]);
  }
  const double limit = ball.radius + slack;
  return square <= limit * limit;
}

bool is_inside(const Cylinder& cylinder, const Point& x, double slack) {
  const Point from = to_point(cylinder.from);
  const Point axis = difference(to_point(cylinder.to), from);
  const Point arm = difference(x, from);
  const double axis_length = length(axis);
  const double height = dot(arm, axis) / axis_length;
  if (height < -slack || height > axis_length + slack) return false;
  const double limit = cylinder.radius + slack;
  const Point radial = difference(arm, scaled(axis, height / axis_length));
  return dot(radial, radial) <= limit * limit;
}

bool is_inside(const HalfSpace& half_space, const Point& x, double slack) {
  double height = 0.0;
  double square = 0.0;
  for (std::size_t axis = 0; axis < half_space.normal.size(); ++axis) {
    height += half_space.normal[axis] * x[axis];
    square += half_space.normal[axis] * half_space.normal[axis];
  }
  return height <= (half_space.offset + slack) * std::sqrt(square);
}

bool is_inside(const Polygon& polygon, const Point& x, double slack) {
  return plane_polygon_contains(polygon.points, x[0], x[1], slack);
}

/// The way from a to b, and where to put the shares found on it.
struct Walk {
  Point a;
  Point b;
  Point step;    ///< from a to b
  double slack;  ///< far above rounding: a share too many is harmless, one too few is not
  std::vector<double>& shares;
};

/// A division by zero gives an infinite or undefined share, which is refused like any other outside (0, 1).
template <class Form>
void append_if_on(const Form& form, const Walk& walk, double u) {
  if (!(u > 0.0 && u < 1.0)) return;
  if (is_inside(form, between(walk.a, walk.b, u), walk.slack)) walk.shares.push_back(u);
}

/// Solutions of square u² + 2 half u + rest = 0, computed without cancellation.
template <class Form>
void append_roots(const Form& form, const Walk& walk, double square, double half, double rest) {
  const double discriminant = half * half - square * rest;
  if (!(discriminant >= 0.0)) return;
  const double larger = -(half + std::copysign(std::sqrt(discriminant), half));
  append_if_on(form, walk, larger / square);
  append_if_on(form, walk, rest / larger);
}

void append(const Box& box, const Walk& walk) {
  for (std::size_t axis = 0; axis < box.from.size(); ++axis) {
    append_if_on(box, walk, (box.from[axis] - walk.a[axis]) / walk.step[axis]);
    append_if_on(box, walk, (box.to[axis] - walk.a[axis]) / walk.step[axis]);
  }
}

void append(const Ball& ball, const Walk& walk) {
  const Point arm = difference(walk.a, to_point(ball.centre));
  append_roots(ball, walk, dot(walk.step, walk.step), dot(arm, walk.step), dot(arm, arm) - ball.radius * ball.radius);
}

void append(const Cylinder& cylinder, const Walk& walk) {
  const Point from = to_point(cylinder.from);
  const Point axis = difference(to_point(cylinder.to), from);
  const Point arm = difference(walk.a, from);
  const double square = dot(axis, axis);
  const double rise = dot(walk.step, axis);
  append_if_on(cylinder, walk, -dot(arm, axis) / rise);
  append_if_on(cylinder, walk, (square - dot(arm, axis)) / rise);
  const Point radial_arm = difference(arm, scaled(axis, dot(arm, axis) / square));
  const Point radial_step = difference(walk.step, scaled(axis, rise / square));
  append_roots(cylinder, walk, dot(radial_step, radial_step), dot(radial_arm, radial_step),
               dot(radial_arm, radial_arm) - cylinder.radius * cylinder.radius);
}

void append(const HalfSpace& half_space, const Walk& walk) {
  const Point normal = to_point(half_space.normal);
  const double height = half_space.offset * length(normal) - dot(normal, walk.a);
  append_if_on(half_space, walk, height / dot(normal, walk.step));
}

void append(const Polygon& polygon, const Walk& walk) {
  for (std::size_t k = 0; k < polygon.points.size(); ++k) {
    const Coordinates& p = polygon.points[k];
    const Coordinates& q = polygon.points[(k + 1) % polygon.points.size()];
    const double edge_x = q[0] - p[0];
    const double edge_y = q[1] - p[1];
    const double area = walk.step[0] * edge_y - walk.step[1] * edge_x;
    const double u = ((p[0] - walk.a[0]) * edge_y - (p[1] - walk.a[1]) * edge_x) / area;
    if (!(u > 0.0 && u < 1.0)) continue;
    const Point x = between(walk.a, walk.b, u);
    if (distance_from_edge(p, q, x[0], x[1]) <= walk.slack) walk.shares.push_back(u);
  }
}

// visit_heights(form, x, visit): numbers whose size is at most the distance of x from one of the surfaces; x is inside
// where none is positive.

template <class Visit>
void visit_heights(const Box& box, const Point& x, const Visit& visit) {
  for (std::size_t axis = 0; axis < box.from.size(); ++axis) {
    visit(box.from[axis] - x[axis]);
    visit(x[axis] - box.to[axis]);
  }
}

template <class Visit>
void visit_heights(const Ball& ball, const Point& x, const Visit& visit) {
  visit(length(difference(x, to_point(ball.centre))) - ball.radius);
}

template <class Visit>
void visit_heights(const Cylinder& cylinder, const Point& x, const Visit& visit) {
  const Point from = to_point(cylinder.from);
  const Point axis = difference(to_point(cylinder.to), from);
  const Point arm = difference(x, from);
  const double axis_length = length(axis);
  const double along = dot(arm, axis) / axis_length;
  visit(length(difference(arm, scaled(axis, along / axis_length))) - cylinder.radius);
  visit(-along);
  visit(along - axis_length);
}

template <class Visit>
void visit_heights(const HalfSpace& half_space, const Point& x, const Visit& visit) {
  const Point normal = to_point(half_space.normal);
  visit(dot(normal, x) / length(normal) - half_space.offset);
}

template <class Visit>
void visit_heights(const Polygon& polygon, const Point& x, const Visit& visit) {
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.points.size(); ++k) {
    const Coordinates& next = polygon.points[(k + 1) % polygon.points.size()];
    distance = std::min(distance, distance_from_edge(polygon.points[k], next, x[0], x[1]));
  }
  visit(is_inside(polygon, x, 0.0) ? -distance : distance);
}

}  // namespace

double height_above(const Shape& shape, const Point& point) {
  double highest = -std::numeric_limits<double>::infinity();
  const auto keep_highest = [&](double height) { highest = std::max(highest, height); };
  std::visit([&](const auto& form) { visit_heights(form, point, keep_highest); }, shape);
  return highest;
}

void append_heights(const Shape& shape, const Point& point, std::vector<double>& heights) {
  const auto append = [&](double height) { heights.push_back(height); };
  std::visit([&](const auto& form) { visit_heights(form, point, append); }, shape);
}

bool surface_within(const Shape& shape, const Point& point, double distance) {
  return std::abs(height_above(shape, point)) <= distance;
}

bool contains(const Shape& shape, const Point& point, double slack) {
  return std::visit([&](const auto& form) { return is_inside(form, point, slack); }, shape);
}

void append_crossings(const Shape& shape, const Point& a, const Point& b, std::vector<double>& shares) {
  const Point step = difference(b, a);
  const Walk walk{a, b, step, 1e-6 * length(step), shares};
  std::visit([&](const auto& form) { append(form, walk); }, shape);
}

}  // namespace peritherm
