#pragma once

#include <cmath>
#include <numbers>
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

/// The unit disc by rings of points, one spacing 1/rings apart, and surface points every 1.5 spacings or so.
inline ClosedPart disc_part(int rings, double ratio) {
  const double spacing = 1.0 / rings;
  constexpr double turn = 2.0 * std::numbers::pi;
  ClosedPart result{2, {}, {}};
  result.part.name = "disc";
  result.part.spacing = spacing;
  result.part.horizon = ratio * spacing;
  for (int ring = 0; ring < rings; ++ring) {
    const double radius = (ring + 0.5) * spacing;
    const auto count = std::lround(turn * (ring + 0.5));
    for (long k = 0; k < count; ++k) {
      const double angle = turn * (static_cast<double>(k) + 0.37 * ring) / static_cast<double>(count);
      result.part.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
      result.part.volumes.push_back(turn * radius * spacing / static_cast<double>(count));
    }
  }
  const auto pieces = std::lround(turn / (1.5 * spacing));
  for (long k = 0; k < pieces; ++k) {
    const double angle = turn * static_cast<double>(k) / static_cast<double>(pieces);
    const Point normal{std::cos(angle), std::sin(angle), 0.0};
    result.surface.push_back({normal, normal, turn / static_cast<double>(pieces), 0});
  }
  return result;
}

}  // namespace peritherm
