#pragma once

#include <string>
#include <variant>
#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"

namespace peritherm {

/// Axis-aligned box, edges included.
struct Box {
  Coordinates from;  ///< lower corner [m]
  Coordinates to;    ///< upper corner [m]
  static constexpr std::string_view name = "box";
  static constexpr std::string_view help = "axis-aligned box (1-D: interval), edges included";
  static constexpr auto options() {
    return std::tuple{required("from", &Box::from, "m", any_number, "lower corner"),
                      required("to", &Box::to, "m", any_number, "upper corner")};
  }
  bool operator==(const Box&) const = default;
};

/// Ball (2-D: disc, 1-D: interval), surface included.
struct Ball {
  Coordinates centre;   ///< [m]
  double radius = 0.0;  ///< [m]
  static constexpr std::string_view name = "ball";
  static constexpr std::string_view help = "ball (2-D: disc), surface included";
  static constexpr auto options() {
    return std::tuple{required("centre", &Ball::centre, "m", any_number, "centre"),
                      required("radius", &Ball::radius, "m", positive, "radius")};
  }
  bool operator==(const Ball&) const = default;
};

/// Finite solid cylinder between two end points of its axis, surface included. In 2-D: a strip with square ends.
struct Cylinder {
  Coordinates from;     ///< one end of the axis [m]
  Coordinates to;       ///< other end of the axis [m]
  double radius = 0.0;  ///< [m]
  static constexpr std::string_view name = "cylinder";
  static constexpr std::string_view help = "solid cylinder between two points (2-D: strip), surface included";
  static constexpr auto options() {
    return std::tuple{required("from", &Cylinder::from, "m", any_number, "one end of the axis"),
                      required("to", &Cylinder::to, "m", any_number, "other end of the axis"),
                      required("radius", &Cylinder::radius, "m", positive, "radius")};
  }
  bool operator==(const Cylinder&) const = default;
};

/// All points with normal · x ≤ offset |normal|.
struct HalfSpace {
  Coordinates normal;   ///< outward normal, any length
  double offset = 0.0;  ///< signed distance of the plane from the coordinate origin along the normal [m]
  static constexpr std::string_view name = "half_space";
  static constexpr std::string_view help = "all points with (normal / |normal|) . x <= offset";
  static constexpr auto options() {
    return std::tuple{
        required("normal", &HalfSpace::normal, "", any_number, "outward normal, any length"),
        optional("offset", &HalfSpace::offset, "m", any_number, "distance of the plane from x = 0 along the normal")};
  }
  bool operator==(const HalfSpace&) const = default;
};

/// Simple polygon in the x-y plane (3-D: the prism over it), edges included.
struct Polygon {
  std::vector<Coordinates> points;  ///< corners in order, two entries each [m]
  static constexpr std::string_view name = "polygon";
  static constexpr std::string_view help = "polygon in the x-y plane (3-D: the prism over it), edges included";
  static constexpr auto options() {
    return std::tuple{required("points", &Polygon::points, "m", any_number, "corners in order, at least 3")};
  }
  bool operator==(const Polygon&) const = default;
};

using Shape = std::variant<Box, Ball, Cylinder, HalfSpace, Polygon>;  ///< the list

/// Is the point inside or on the surface? Points up to `slack` [m] outside count as on the surface.
bool contains(const Shape& shape, const Point& point, double slack);

/// Appends the shares u in (0, 1) of the way from a to b at which the surface is crossed, in any order.
void append_crossings(const Shape& shape, const Point& a, const Point& b, std::vector<double>& shares);

/// Height above the surface, negative inside; its size is at most the distance, and is the distance but near edges [m].
double height_above(const Shape& shape, const Point& point);

/// Appends the heights above each of the surfaces that bound the shape, which is where none of them is positive: sides
/// of a box, mantle and ends of a cylinder; others have one [m].
void append_heights(const Shape& shape, const Point& point, std::vector<double>& heights);

/// Does the surface come as near to the point as `distance` [m]? Errs towards yes.
bool surface_within(const Shape& shape, const Point& point, double distance);

/// Outward unit normal at a place on the surface where something goes out of the shape in a direction of any length.
/// Where smooth pieces of the surface meet within `slack` [m]: the direction of the sum of those through which it goes
/// outwards, the others being grazed or entered. 0 if there are none.
Point surface_normal(const Shape& shape, const Point& place, const Point& outwards, double slack);

/// What is wrong with the shape in a body of this dimension; empty if nothing is.
std::string find_fault(const Shape& shape, int dimension);

}  // namespace peritherm
