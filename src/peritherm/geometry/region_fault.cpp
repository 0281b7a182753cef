#include <algorithm>
#include <cmath>

#include "peritherm/base/text.hpp"
#include "peritherm/geometry/coordinates.hpp"
#include "peritherm/geometry/plane_polygon.hpp"
#include "peritherm/geometry/region.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

std::string radius_fault(double radius) {
  if (positive.holds(radius)) return {};
  return "'radius' must be positive. Give a length above 0";
}

std::string fault_of(const Box& box, int dimension) {
  if (std::string fault = find_fault("'from'", box.from, dimension); !fault.empty()) return fault;
  if (std::string fault = find_fault("'to'", box.to, dimension); !fault.empty()) return fault;
  for (int axis = 0; axis < dimension; ++axis) {
    if (box.from[axis] < box.to[axis]) continue;
    return "'from' (" + shortest(box.from[axis]) + ") is not below 'to' (" + shortest(box.to[axis]) + ") along " +
           "xyz"[axis] + ". Give the lower corner first";
  }
  return {};
}

std::string fault_of(const Ball& ball, int dimension) {
  if (std::string fault = find_fault("'centre'", ball.centre, dimension); !fault.empty()) return fault;
  return radius_fault(ball.radius);
}

std::string fault_of(const Cylinder& cylinder, int dimension) {
  if (dimension < 2) return "a cylinder needs at least two dimensions. Use a box in 1-D";
  if (std::string fault = find_fault("'from'", cylinder.from, dimension); !fault.empty()) return fault;
  if (std::string fault = find_fault("'to'", cylinder.to, dimension); !fault.empty()) return fault;
  if (cylinder.from == cylinder.to) return "'from' and 'to' are the same point. Give the two ends of the axis";
  return radius_fault(cylinder.radius);
}

std::string fault_of(const HalfSpace& half_space, int dimension) {
  if (std::string fault = find_fault("'normal'", half_space.normal, dimension); !fault.empty()) return fault;
  if (length(to_point(half_space.normal)) == 0.0)
    return "'normal' has no direction. Give at least one entry that is not 0";
  if (!std::isfinite(half_space.offset)) return "'offset' is not finite. Give an ordinary number";
  return {};
}

std::string fault_of(const Polygon& polygon, int dimension) {
  if (dimension < 2) return "a polygon needs at least two dimensions. Use a box in 1-D";
  const auto& corners = polygon.points;
  if (corners.size() < 3) return "a polygon of fewer than three corners has no area. Give at least three";
  for (const Coordinates& corner : corners) {
    if (corner.size() != 2) return "a corner of a polygon has two entries, x and y. Leave out or add the others";
    if (!is_finite(corner)) return "a corner of the polygon is not finite. Give ordinary numbers";
  }
  if (corners.front() == corners.back())
    return "the last corner repeats the first. Leave it out; the polygon closes itself";
  if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) {
    return "two neighbouring corners are the same point. Leave one out";
  }
  const double extent = extent_of(corners);
  if (std::abs(twice_signed_area(corners)) <= 1e-12 * extent * extent) {
    return "the polygon has no area. Give corners that do not lie on one line or cancel each other";
  }
  if (crosses_itself(corners)) return "the edges of the polygon meet or cross. Give the corners in order around it";
  return {};
}

}  // namespace

std::string find_fault(const Shape& shape, int dimension) {
  return std::visit([&](const auto& form) { return fault_of(form, dimension); }, shape);
}

}  // namespace peritherm
