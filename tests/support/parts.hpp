#pragma once

#include <cmath>
#include <vector>

#include "peritherm/discretisation/sub_domains.hpp"

namespace peritherm {

/// A part and the whole of its surface, normals outwards.
struct ClosedPart {
  int dimension;
  SubDomain part;
  std::vector<SurfacePoint> surface;
};

/// A box of cells with one surface point per face of a cell.
inline ClosedPart box_part(int dimension, const GridIndex& cells, double spacing, double horizon, Point origin = {}) {
  Grid grid{dimension, spacing, cells, origin, PointPlacement::centres};
  ClosedPart result{dimension, {}, {}};
  SubDomain& part = result.part;
  part.name = "box";
  part.spacing = spacing;
  part.horizon = horizon;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const GridIndex place = grid.index(n);
    part.places.push_back(place);
    part.positions.push_back(grid.position(place));
    part.volumes.push_back(grid.cell_volume());
    for (int axis = 0; axis < dimension; ++axis) {
      for (const int side : {-1, 1}) {
        if (place[axis] != (side < 0 ? 0 : cells[axis] - 1)) continue;
        SurfacePoint face{grid.position(place), {}, grid.cell_volume() / spacing, 0};
        face.position[axis] = origin[axis] + (side < 0 ? 0.0 : grid.length(axis));
        face.normal[axis] = side;
        result.surface.push_back(face);
      }
    }
  }
  return result;
}

}  // namespace peritherm
