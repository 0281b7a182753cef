#pragma once

#include <vector>

#include "peritherm/base/field.hpp"
#include "peritherm/physics/material.hpp"

namespace peritherm {

/// Points of any arrangement: first the `owned` ones of the body, then fictitious ones that they exchange heat with.
struct Points {
  int dimension = 3;
  double spacing = 0.0;                  ///< edge of a whole cell, for partial volumes [m]
  std::size_t owned = 0;                 ///< how many belong to the body
  std::vector<Point> positions;          ///< [m]
  std::vector<double> volumes;           ///< own volume [m³]; of owned points
  std::vector<double> source_volumes;    ///< volume with which the point counts as a neighbour [m³]
  std::vector<MaterialIndex> materials;  ///< never no_material
  std::vector<std::int64_t> entries;     ///< where the point's value stands in a field
  std::size_t size() const { return positions.size(); }
};

}  // namespace peritherm
