#include "peritherm/discretisation/body.hpp"

#include <algorithm>

#include "peritherm/discretisation/point_blocks.hpp"

namespace peritherm {

int Body::region_at(const Point& x) const {
  const double slack = 1e-9 * grid.spacing;
  int region = static_cast<int>(regions.size()) - 1;
  while (region >= 0 && !contains(regions[static_cast<std::size_t>(region)].shape, x, slack)) --region;
  return region;
}

MaterialIndex Body::material_of_region(int region) const {
  return region < 0 ? background : regions[static_cast<std::size_t>(region)].material;
}

MaterialIndex Body::material_at(const Point& x) const { return material_of_region(region_at(x)); }

void Body::assign_materials() {
  material_of.assign(grid.size(), background);
  if (regions.empty()) return;
  const PointBlocks blocks(grid);
#pragma omp parallel for schedule(dynamic, 16)
  for (std::int64_t b = 0; b < blocks.size(); ++b) assign_materials(blocks[b]);
}

/// A block that no surface comes near is of one material.
void Body::assign_materials(const PointBlock& block) {
  const bool uniform = !any_surface_within(regions, block.centre, block.half_diagonal);
  const MaterialIndex common = uniform ? material_at(block.centre) : background;
  for (int z = block.low[2]; z < block.high[2]; ++z) {
    for (int y = block.low[1]; y < block.high[1]; ++y) {
      const std::size_t first = grid.number({0, y, z});
      for (int x = block.low[0]; x < block.high[0]; ++x) {
        material_of[first + static_cast<std::size_t>(x)] = uniform ? common : material_at(grid.position({x, y, z}));
      }
    }
  }
}

bool Body::has_voids() const {
  const auto cuts_away = [](const MaterialRegion& region) { return region.material == no_material; };
  if (background != no_material && std::none_of(regions.begin(), regions.end(), cuts_away)) return false;
  return std::find(material_of.begin(), material_of.end(), no_material) != material_of.end();
}

GridIndex Body::fold(GridIndex p) const {
  const int shift = grid.placement == PointPlacement::boundary ? 0 : 1;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const int last = grid.count(axis) - 1;
    if (p[axis] < 0) p[axis] = -p[axis] - shift;
    if (p[axis] > last) p[axis] = 2 * last - p[axis] + shift;
  }
  return p;
}

std::size_t Body::wall_place(Face face, const GridIndex& p) const {
  const GridIndex inside = fold(p);
  std::size_t place = 0;
  for (int axis = 2; axis >= 0; --axis) {
    if (axis == axis_of(face)) continue;
    place = place * static_cast<std::size_t>(grid.count(axis)) + static_cast<std::size_t>(inside[axis]);
  }
  return place;
}

std::size_t Body::wall_places(Face face) const {
  return grid.size() / static_cast<std::size_t>(grid.count(axis_of(face)));
}

int Body::boundary_at(Face face, const GridIndex& p) const {
  const FaceWalls& wall = walls[static_cast<int>(face)];
  return wall.boundary_of.empty() ? -1 : wall.boundary_of[wall_place(face, p)];
}

WallKind Body::wall_kind_at(Face face, const GridIndex& p) const {
  if (walls[static_cast<int>(face)].open) return WallKind::open;
  const int boundary = boundary_at(face, p);
  return boundary < 0 ? WallKind::even : wall_kinds[boundary];
}

void Body::inspect_walls() {
  for (FaceWalls& wall : walls) {
    const auto kind = [this](int boundary) { return boundary < 0 ? WallKind::even : wall_kinds[boundary]; };
    const auto differs = [&](int boundary) { return kind(boundary) != kind(wall.boundary_of.front()); };
    wall.partly_held = !wall.open && std::any_of(wall.boundary_of.begin(), wall.boundary_of.end(), differs);
  }
}

MaterialIndex Body::material_of_extended(const GridIndex& p) const {
  for (int axis = 0; axis < grid.dimension; ++axis) {
    if (p[axis] < 0 && walls[2 * axis].open) return no_material;
    if (p[axis] >= grid.count(axis) && walls[2 * axis + 1].open) return no_material;
  }
  return material_of[grid.number(fold(p))];
}

double Body::volume_share(const GridIndex& p) const {
  const double parted = faces.empty() ? 1.0 : faces.volume(grid.number(p));
  const double share = grid.volume_share(p) * parted;
  return boundary_volumes == BoundaryVolumes::partial ? share : share / open_share(p);
}

double Body::source_share(const GridIndex& p) const {
  return boundary_volumes == BoundaryVolumes::partial ? open_share(fold(p)) : 1.0;
}

/// 1/2 for each open face that a point stands on.
double Body::open_share(const GridIndex& p) const {
  double share = 1.0;
  if (grid.placement == PointPlacement::centres) return share;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    if (p[axis] == 0 && walls[2 * axis].open) share *= 0.5;
    if (p[axis] == grid.cells[axis] && walls[2 * axis + 1].open) share *= 0.5;
  }
  return share;
}

}  // namespace peritherm
