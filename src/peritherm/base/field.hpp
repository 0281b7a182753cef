#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace peritherm {

using Point = std::array<double, 3>;         ///< position [m]; unused directions are 0
using Coordinates = std::vector<double>;     ///< position as the user wrote it: one entry per dimension
using Field = std::span<double>;             ///< one value per point
using ConstField = std::span<const double>;  ///< one value per point, read only
using PointIndex = std::int32_t;             ///< local to a rank
using BondIndex = std::int64_t;              ///< bonds of a rank exceed 2³¹ before points do

/// The first three coordinates, missing ones 0.
inline Point to_point(const Coordinates& coordinates) {
  Point point{};
  for (std::size_t axis = 0; axis < coordinates.size() && axis < 3; ++axis) {
    point[axis] = coordinates[axis];
  }
  return point;
}

}  // namespace peritherm
