#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/damage.hpp"
#include "peritherm/operators/bond_corrections.hpp"

namespace peritherm {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Flags points with a bond that may leave or enter a region, be it only on its way.
void flag_region_surfaces(const Body& body, const Stencil& stencil, Bytes& special) {
  double reach = 0.0;
  for (const auto& [offset, conductance] : stencil.entries) {
    reach = std::max(reach, std::hypot(offset[0], offset[1], offset[2]));
  }
  // A bond to a fictitious point is folded back into the body and comes no farther.
  reach *= (1.0 + 1e-6) * body.grid.spacing;
  const auto count = static_cast<std::int64_t>(special.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t n = 0; n < count; ++n) {
    const Point x = body.grid.position(body.grid.index(static_cast<std::size_t>(n)));
    for (const MaterialRegion& region : body.regions) {
      if (surface_within(region.shape, x, reach)) special[static_cast<std::size_t>(n)] = 1;
    }
  }
}

/// Calls visit(point number) for every point of a box of indices.
template <class Visit>
void for_box(const Grid& grid, const GridIndex& low, const GridIndex& high, Visit&& visit) {
  for (int z = std::max(low[2], 0); z <= std::min(high[2], grid.count(2) - 1); ++z) {
    for (int y = std::max(low[1], 0); y <= std::min(high[1], grid.count(1) - 1); ++y) {
      for (int x = std::max(low[0], 0); x <= std::min(high[0], grid.count(0) - 1); ++x) visit(GridIndex{x, y, z});
    }
  }
}

/// A face that is held in part changes the partners of bonds anywhere within its reach; an open one ends them, and
/// halves those to points that stand on it.
void flag_changing_faces(const Body& body, int radius, Bytes& special) {
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
    for_box(body.grid, low, high, [&](const GridIndex& p) { special[body.grid.number(p)] = 1; });
  }
}

}  // namespace

std::vector<std::uint8_t> find_special_points(const Body& body, const Stencil& stencil) {
  Bytes special(body.grid.size(), 0);
  flag_region_surfaces(body, stencil, special);
  flag_changing_faces(body, stencil.radius, special);
  for (const std::size_t point : points_near_cracks(body, stencil.radius)) special[point] = 1;
  return special;
}

}  // namespace peritherm
