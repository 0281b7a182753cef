#pragma once

#include <vector>

#include "peritherm/geometry/vector.hpp"

namespace peritherm {

/// The corners that a polyline in the plane needs to stay within a distance of all given ones: the algorithm of Douglas
/// and Peucker (1973). First and last corners stay; at least one corner is given.
std::vector<Point> simplified(const std::vector<Point>& corners, double distance);

}  // namespace peritherm
