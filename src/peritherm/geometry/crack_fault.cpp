#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "peritherm/geometry/coordinates.hpp"
#include "peritherm/geometry/crack.hpp"
#include "peritherm/geometry/plane_polygon.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

std::string number_fault(const Crack& crack, int dimension) {
  if (!zero_to_one.holds(crack.transmission))
    return "'transmission' must lie between 0 and 1. 0 insulates, 1 conducts fully";
  if (!not_negative.holds(crack.start_time)) return "'start_time' must not be negative. Leave it out for the start";
  if (!crack.tip_speed) return {};
  if (dimension == 1) return "a crack in 1-D is a position and cannot grow. Leave out 'tip_speed'";
  if (!positive.holds(*crack.tip_speed)) return "'tip_speed' must be positive. Leave it out for a standing crack";
  return {};
}

std::string times_fault(const std::vector<double>& times, std::size_t others, const std::string& of_others) {
  if (times.empty()) return "'contact.times' is empty. Give at least one time";
  if (times.size() != others) {
    return "'contact.times' and '" + of_others + "' have " + std::to_string(times.size()) + " and " +
           std::to_string(others) + " entries. Give one for each time";
  }
  if (std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) != times.end())
    return "'contact.times' must ascend. Sort them, each once";
  return {};
}

std::string fault_of(const ContactAtTimes& contact) {
  return times_fault(contact.times, contact.shares.size(), "contact.shares");
}

std::string fault_of(const ContactByOpening& contact) {
  return times_fault(contact.times, contact.openings.size(), "contact.openings");
}

std::string fault_of(const GapConvection&) { return {}; }

std::string fault_of(const GapRadiation& gap) {
  if (gap.emissivities.size() != 2) return "'gap.emissivities' needs one entry for each face. Give two";
  if (gap.emissivities[0] == 0.0 || gap.emissivities[1] == 0.0)
    return "'gap.emissivities' must be positive. Leave out 'gap' if nothing is radiated";
  if (gap.temperature && gap.absolute_zero != 0.0)
    return "'gap.absolute_zero' says nothing beside 'gap.temperature', which is absolute. Leave one out";
  return {};
}

template <class Variant>
std::string fault_of_any(const std::optional<Variant>& chosen) {
  return chosen ? std::visit([](const auto& kind) { return fault_of(kind); }, *chosen) : std::string();
}

std::string disc_fault(const Disc& disc, int dimension) {
  if (dimension != 3) return "a disc needs three dimensions. Give 'points' instead";
  if (std::string fault = find_fault("'centre' of the disc", disc.centre, 3); !fault.empty()) return fault;
  if (std::string fault = find_fault("'normal' of the disc", disc.normal, 3); !fault.empty()) return fault;
  if (length(to_point(disc.normal)) == 0.0) return "'normal' of the disc has no direction. Give an entry that is not 0";
  if (!positive.holds(disc.radius)) return "'radius' of the disc must be positive. Give a length above 0";
  return {};
}

/// The corner farthest from the first spans the plane's first axis; the one farthest from that line its normal.
struct Plane {
  double size = 0.0;   ///< largest distance from the first corner [m]
  double width = 0.0;  ///< largest distance from the first axis [m]
  Point normal{};
};

Plane plane_of(const std::vector<Point>& corners) {
  Plane plane;
  Point axis{};
  for (const Point& corner : corners) {
    const Point arm = difference(corner, corners[0]);
    if (length(arm) <= plane.size) continue;
    plane.size = length(arm);
    axis = scaled(arm, 1.0 / plane.size);
  }
  for (const Point& corner : corners) {
    const Point normal = cross(axis, difference(corner, corners[0]));
    if (length(normal) <= plane.width) continue;
    plane.width = length(normal);
    plane.normal = scaled(normal, 1.0 / plane.width);
  }
  return plane;
}

std::string polygon_fault(const std::vector<Point>& corners) {
  if (corners.front() == corners.back())
    return "the last corner repeats the first. Leave it out; the polygon closes itself";
  const Plane plane = plane_of(corners);
  if (plane.width <= 1e-6 * plane.size) return "the corners lie on one line. Give a polygon with an area";
  for (const Point& corner : corners) {
    if (std::abs(dot(difference(corner, corners[0]), plane.normal)) > 1e-6 * plane.size) {
      return "the corners do not lie in one plane. Split the crack into several plane ones";
    }
  }
  const auto largest = std::max_element(plane.normal.begin(), plane.normal.end(),
                                        [](double a, double b) { return std::abs(a) < std::abs(b); });
  const auto dropped = static_cast<std::size_t>(largest - plane.normal.begin());
  std::vector<std::array<double, 2>> projected;
  for (const Point& corner : corners) projected.push_back({corner[(dropped + 1) % 3], corner[(dropped + 2) % 3]});
  if (std::abs(twice_signed_area(projected)) <= 1e-6 * plane.size * plane.width) {
    return "the corners enclose no area. Give them in order around the crack";
  }
  if (crosses_itself(projected)) return "the edges of the crack meet or cross. Give the corners in order around it";
  return {};
}

std::string points_fault(const Crack& crack, int dimension) {
  for (std::size_t k = 0; k < crack.points.size(); ++k) {
    const std::string name = "point " + std::to_string(k + 1);
    if (std::string fault = find_fault(name, crack.points[k], dimension); !fault.empty()) return fault;
  }
  const std::size_t count = crack.points.size();
  if (dimension == 1) return count == 1 ? "" : "a crack in 1-D is one position. Give exactly one point";
  if (count == 1) {
    return dimension == 2 ? "a crack of a single point has no length. Give at least two points"
                          : "a crack of a single point has no area. Give at least three points";
  }
  const auto repeated = std::adjacent_find(crack.points.begin(), crack.points.end());
  if (repeated != crack.points.end()) {
    return "points " + std::to_string(repeated - crack.points.begin() + 1) + " and " +
           std::to_string(repeated - crack.points.begin() + 2) + " are the same. Leave one out";
  }
  if (dimension == 2) return {};
  if (count == 2) return "a crack of two points has no area in 3-D. Give at least three points";
  std::vector<Point> corners;
  for (const Coordinates& point : crack.points) corners.push_back(to_point(point));
  return polygon_fault(corners);
}

}  // namespace

std::string find_fault(const Crack& crack, int dimension) {
  if (crack.disc && !crack.points.empty()) return "both 'points' and 'disc' are given. Leave one out";
  if (!crack.disc && crack.points.empty()) {
    return dimension == 3 ? "neither 'points' nor 'disc' is given. Say where the crack is"
                          : "'points' is missing. Say where the crack is";
  }
  if (std::string fault = number_fault(crack, dimension); !fault.empty()) return fault;
  if (std::string fault = fault_of_any(crack.gap); !fault.empty()) return fault;
  if (std::string fault = fault_of_any(crack.contact); !fault.empty()) return fault;
  if (follows_temperatures(crack) && (crack.tip_speed || crack.start_time > 0.0 || crack.contact))
    return "'gap' radiates by the faces' own temperatures, and so far only where the crack stands and stays open. Give "
           "gap.temperature, or leave out tip_speed, start_time and contact";
  return crack.disc ? disc_fault(*crack.disc, dimension) : points_fault(crack, dimension);
}

}  // namespace peritherm
