#include <algorithm>

#include "peritherm/discretisation/damage.hpp"
#include "peritherm/operators/bond_corrections.hpp"

namespace peritherm {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Lowest (or highest) value among the neighbours within `radius` along one axis of a padded array.
template <class Choose>
Bytes filter(const Bytes& values, const PaddedGrid& layout, int axis, int radius, Choose choose) {
  Bytes result(values);
  const auto stride = layout.stride(axis);
  for (int shift = 1; shift <= radius; ++shift) {
    const std::size_t step = static_cast<std::size_t>(shift) * stride;
    for (std::size_t n = step; n < values.size(); ++n) result[n] = choose(result[n], values[n - step]);
    for (std::size_t n = 0; n + step < values.size(); ++n) result[n] = choose(result[n], values[n + step]);
  }
  return result;
}

/// Flags points whose surroundings hold another material, a void or an open face.
void flag_material_changes(const Body& body, const PaddedGrid& layout, int radius, Bytes& special) {
  const bool open = std::any_of(body.walls.begin(), body.walls.end(), [](const FaceWalls& w) { return w.open; });
  if (body.regions.empty() && !open) return;
  const Grid& grid = body.grid;
  Bytes lowest(layout.size(), no_material);
  const auto pad = [&](int axis) { return layout.padding(axis); };
  for (int z = -pad(2); z < grid.count(2) + pad(2); ++z) {
    for (int y = -pad(1); y < grid.count(1) + pad(1); ++y) {
      for (int x = -pad(0); x < grid.count(0) + pad(0); ++x) {
        lowest[layout.entry({x, y, z})] = body.material_of_extended({x, y, z});
      }
    }
  }
  Bytes highest = lowest;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    lowest = filter(lowest, layout, axis, radius, [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
    highest = filter(highest, layout, axis, radius, [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
  }
  for (std::size_t n = 0; n < special.size(); ++n) {
    const std::size_t entry = layout.entry(grid.index(n));
    if (lowest[entry] != highest[entry]) special[n] = 1;
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

/// A face that is held in part changes the partners of bonds anywhere within its reach.
void flag_partly_held_faces(const Body& body, int radius, Bytes& special) {
  for (int face = 0; face < 2 * body.grid.dimension; ++face) {
    if (!body.walls[face].partly_held) continue;
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

std::vector<std::uint8_t> find_special_points(const Body& body, const PaddedGrid& layout, const Stencil& stencil) {
  Bytes special(body.grid.size(), 0);
  flag_material_changes(body, layout, stencil.radius, special);
  flag_partly_held_faces(body, stencil.radius, special);
  for (const std::size_t point : points_near_cracks(body, stencil.radius)) special[point] = 1;
  return special;
}

}  // namespace peritherm
