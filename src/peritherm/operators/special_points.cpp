#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/row_intervals.hpp"
#include "peritherm/operators/bond_corrections.hpp"

namespace peritherm {
namespace {

/// Longest bond, and a little more [m]. A bond to a fictitious point is folded back into the body and comes no farther.
double longest_bond(const Body& body, const Stencil& stencil) {
  double reach = 0.0;
  for (const auto& [offset, conductance] : stencil.entries) {
    reach = std::max(reach, std::hypot(offset[0], offset[1], offset[2]));
  }
  return reach * (1.0 + 1e-6) * body.grid.spacing;
}

/// A face that is held in part changes the partners of bonds anywhere within its reach; an open one ends them, and
/// halves those to points that stand on it.
void append_changing_faces(const Body& body, int radius, std::vector<RowInterval>& special) {
  for (int face = 0; face < 2 * body.grid.dimension; ++face) {
    if (!body.walls[face].partly_held && !body.walls[face].open) continue;
    GridIndex low{0, 0, 0};
    GridIndex high{body.grid.count(0) - 1, body.grid.count(1) - 1, body.grid.count(2) - 1};
    const int axis = axis_of(static_cast<Face>(face));
    if (is_upper(static_cast<Face>(face))) {
      low[axis] = high[axis] - radius;
    } else {
      high[axis] = radius;
    }
    append_box(body.grid, low, high, special);
  }
}

}  // namespace

std::vector<RowInterval> find_special_points(const Body& body, const Stencil& stencil) {
  // A bond may leave or enter a region on its way only.
  std::vector<RowInterval> special = points_near_regions(body, longest_bond(body, stencil));
  const std::vector<RowInterval> near = points_near_cracks(body, stencil.radius);
  special.insert(special.end(), near.begin(), near.end());
  append_changing_faces(body, stencil.radius, special);
  merge(special);
  return special;
}

}  // namespace peritherm
