#pragma once

#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/point_values.hpp"

namespace peritherm {

/// Value of a field at a place inside the box: multilinear between the points around it, and carried on linearly
/// between the outermost points and the face. Next to points that were cut away (NaN) it is the value of the nearest
/// point of the cell that exists; NaN if there is none.
double interpolate(const Grid& grid, const PointValues& field, const Point& place);

}  // namespace peritherm
