#pragma once

#include <string>
#include <vector>

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/physics/material.hpp"

namespace peritherm {

/// A part of a body with points of its own, none of them on its surface; it meets others through that surface only.
struct SubDomain {
  std::string name;  ///< of its material or region; parts that do not hang together are numbered: "fibre 2"
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
  double area;      ///< [m²]
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

}  // namespace peritherm
