#pragma once

#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/discretisation/grid.hpp"
#include "peritherm/geometry/region.hpp"
#include "peritherm/physics/material.hpp"

namespace peritherm {

/// How the points of a region stand.
enum class PartPoints {
  grid,  ///< in the centres of cells
  rings  ///< on circles around the centre of a ball; 2-D
};

template <>
struct EnumNames<PartPoints> {
  static constexpr std::array<std::pair<PartPoints, std::string_view>, 2> values{
      {{PartPoints::grid, "grid"}, {PartPoints::rings, "rings"}}};
};

/// What fills the box before any region.
struct PartBackground {
  std::string name;            ///< of its parts
  MaterialIndex material = 0;  ///< no_material: nothing
  double horizon = 0.0;        ///< [m]
};

/// A piece of a body; later ones overwrite earlier ones. Regions with equal names, materials and horizons on one grid
/// are one wherever they touch.
struct PartRegion {
  Shape shape;
  std::string name;            ///< of its parts
  MaterialIndex material = 0;  ///< no_material: cut away
  double horizon = 0.0;        ///< [m]; 0: of the background
  double spacing = 0.0;        ///< of points of its own [m]; 0: the points of what it overwrites
  PartPoints points = PartPoints::grid;
  InputLocation where{};  ///< for errors
};

/// A part of a body with points of its own; it meets others through its surface only. Points stand inside, except
/// where a surface that is not along cells runs through the middle of a cell.
struct SubDomain {
  std::string name;  ///< of its region; parts that do not hang together are numbered: "fibre 2"
  MaterialIndex material = 0;
  double spacing = 0.0;           ///< [m]
  double horizon = 0.0;           ///< [m]
  std::vector<Point> positions;   ///< [m]
  std::vector<double> volumes;    ///< [m³]; their sum is that of the part
  std::vector<GridIndex> places;  ///< on a grid of its own spacing, for runs of equal rows; empty: no lattice
  std::size_t size() const { return positions.size(); }
};

/// A piece of surface between two parts, or between one and the outside.
struct SurfacePoint {
  Point position;   ///< [m]
  Point normal;     ///< unit vector, out of `first`
  double area;      ///< [m²]; 1-D: 1, 2-D: a length times unit thickness
  int first;        ///< number of a part
  int second = -1;  ///< number of the part on the other side; −1: the outside
  int face = -1;    ///< outside: the face of the box, as Face; −1: inside the box, around what is cut away
};

/// A body made of parts. For each part, with normals outwards, Σ A n = 0 and Σ A n xᵀ = (Σ V) 1 to rounding, so that
/// the heat which leaves a part in a uniform flux is none and linear temperatures have their exact mean gradient.
struct DividedBody {
  int dimension = 1;
  std::vector<SubDomain> parts;
  std::vector<SurfacePoint> surface;
};

/// Cuts a box into parts. Points are the centres of the grid's cells. Regions become parts by connected components
/// (neighbours by faces of cells). Surfaces along cells are kept exactly, one surface point per face of a cell; others
/// are planar inside each cell, with areas and volumes to second order.
/// Throws Error with all issues: regions without points or with less than a cell, own grids and rings that do not fit.
///
/// A region with another spacing than the body's is a box with a grid of its own, whose sides are along the cells of
/// what it overwrites; surface points between two grids are those of the coarser one. Rings are concentric balls in 2-D
/// with nothing around them; the first is the largest.
DividedBody divide_body(const Grid& grid, const PartBackground& background, const std::vector<PartRegion>& regions);

/// A part too thin for its horizon, so that layers below opposite surfaces overlap.
struct ThinPart {
  std::size_t part = 0;
  double thickness = 0.0;  ///< across its widest place, to a spacing [m]
  double needed = 0.0;     ///< four horizons in 1-D, else two [m]
};
std::vector<ThinPart> find_thin_parts(const DividedBody& body);

}  // namespace peritherm
