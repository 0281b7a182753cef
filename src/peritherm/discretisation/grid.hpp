#pragma once

#include <array>

#include "peritherm/base/describe.hpp"
#include "peritherm/base/field.hpp"
#include "peritherm/geometry/face.hpp"

namespace peritherm {

/// Where the points of a grid stand.
enum class PointPlacement {
  centres,  ///< in the middle of the cells; all volumes alike
  boundary  ///< on the corners of the cells; half, quarter and eighth volumes on faces, edges and corners
};

template <>
struct EnumNames<PointPlacement> {
  static constexpr std::array<std::pair<PointPlacement, std::string_view>, 2> values{
      {{PointPlacement::centres, "centres"}, {PointPlacement::boundary, "boundary"}}};
};

/// With how much of its cell a point on a face outside which nothing stands counts. Fictitious points complete the
/// cells on all other faces.
enum class BoundaryVolumes {
  partial,  ///< the part inside the box
  whole     ///< all of it: a skin of half a cell around the body [bobaru2012, section 3]
};

template <>
struct EnumNames<BoundaryVolumes> {
  static constexpr std::array<std::pair<BoundaryVolumes, std::string_view>, 2> values{
      {{BoundaryVolumes::partial, "partial"}, {BoundaryVolumes::whole, "whole"}}};
};

using GridIndex = std::array<int, 3>;  ///< place of a point along x, y, z; 0 along unused axes

/// Uniform grid of cubic cells over a box. Points are numbered with x fastest.
struct Grid {
  int dimension = 1;
  double spacing = 1.0;      ///< [m]
  GridIndex cells{1, 1, 1};  ///< 1 along unused axes
  Point origin{};            ///< lower corner of the box [m]
  PointPlacement placement = PointPlacement::centres;

  /// Number of points along an axis.
  int count(int axis) const {
    return axis < dimension && placement == PointPlacement::boundary ? cells[axis] + 1 : cells[axis];
  }
  std::size_t size() const {
    return static_cast<std::size_t>(count(0)) * static_cast<std::size_t>(count(1)) * static_cast<std::size_t>(count(2));
  }
  /// Length of the box along an axis [m].
  double length(int axis) const { return spacing * cells[axis]; }
  /// Depth of the first layer of points below a face, in spacings: 1/2 or 0.
  double first_depth() const { return placement == PointPlacement::boundary ? 0.0 : 0.5; }

  std::size_t number(const GridIndex& p) const {
    return static_cast<std::size_t>(p[0]) +
           static_cast<std::size_t>(count(0)) *
               (static_cast<std::size_t>(p[1]) + static_cast<std::size_t>(count(1)) * static_cast<std::size_t>(p[2]));
  }
  GridIndex index(std::size_t number) const {
    const auto nx = static_cast<std::size_t>(count(0));
    const auto ny = static_cast<std::size_t>(count(1));
    return {static_cast<int>(number % nx), static_cast<int>(number / nx % ny), static_cast<int>(number / (nx * ny))};
  }
  /// Position [m]; indices outside the box give the places of fictitious points.
  Point position(const GridIndex& p) const {
    Point x{};
    for (int axis = 0; axis < dimension; ++axis) x[axis] = origin[axis] + (p[axis] + first_depth()) * spacing;
    return x;
  }
  /// Place on a face that lies opposite a point [m].
  Point wall_position(Face face, const GridIndex& p) const {
    Point x = position(p);
    const int axis = axis_of(face);
    x[axis] = origin[axis] + (is_upper(face) ? length(axis) : 0.0);
    return x;
  }
  bool contains(const GridIndex& p) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < 0 || p[axis] >= count(axis)) return false;
    }
    return true;
  }
  /// Volume of a whole cell [m³]; 1-D and 2-D bodies have unit cross-section and thickness.
  double cell_volume() const {
    double volume = 1.0;
    for (int axis = 0; axis < dimension; ++axis) volume *= spacing;
    return volume;
  }
  /// Share of a whole cell that belongs to a point: 1, or 1/2, 1/4, 1/8 on faces, edges and corners.
  double volume_share(const GridIndex& p) const {
    double share = 1.0;
    if (placement == PointPlacement::centres) return share;
    for (int axis = 0; axis < dimension; ++axis) {
      if (p[axis] == 0 || p[axis] == cells[axis]) share *= 0.5;
    }
    return share;
  }
  bool operator==(const Grid&) const = default;
};

}  // namespace peritherm
