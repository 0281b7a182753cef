#pragma once

#include <array>
#include <functional>
#include <span>

#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/point_values.hpp"
#include "peritherm/output/material_jumps.hpp"

namespace peritherm {

/// The point of a grid that is nearest to a place.
GridIndex nearest_point(const Grid& grid, const Point& place);

/// A point of a grid and its share of a value between points.
struct WeightedPoint {
  std::size_t number = 0;
  double weight = 0.0;
};

/// What a value between points is made of; nothing where no point exists.
struct InterpolationWeights {
  std::array<WeightedPoint, 8> points;
  std::size_t count = 0;
  const WeightedPoint* begin() const { return points.data(); }
  const WeightedPoint* end() const { return points.data() + count; }
};

/// What `interpolate` sums up, without weights that are 0; `exists` tells which points were not cut away.
InterpolationWeights interpolation_weights(const Grid& grid, const Point& place,
                                           const std::function<bool(std::size_t number)>& exists);

/// Value of a field at a place inside the box: multilinear between the points around it, and carried on linearly
/// between the outermost points and the face. Next to points that were cut away (NaN) it is the value of the nearest
/// point of the cell that exists; NaN if there is none.
double interpolate(const Grid& grid, const PointValues& field, const Point& place);

/// The same beside interfaces at which the field jumps: points on the other side take no part, and where the cell has
/// others, the value is carried on linearly from the points of the place's side around it.
double interpolate(const Grid& grid, const PointValues& field, std::span<const MaterialIndex> materials,
                   const MaterialJumps& jumps, const Point& place);

}  // namespace peritherm
