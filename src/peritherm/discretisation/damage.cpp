#include "peritherm/discretisation/damage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/discretisation/bond_path.hpp"

namespace peritherm {
namespace {

/// The neighbours that come later in the numbering, so that each bond is met once.
std::vector<StencilEntry> forward_half(const Stencil& stencil) {
  return {stencil.entries.begin() + static_cast<std::ptrdiff_t>(stencil.entries.size() / 2), stencil.entries.end()};
}

GridIndex shifted(const GridIndex& p, const GridIndex& offset) {
  return {p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]};
}

bool is_inside(const Body& body, const GridIndex& p) {
  return body.grid.contains(p) && body.material_of[body.grid.number(p)] != no_material;
}

}  // namespace

std::vector<std::size_t> points_near_cracks(const Body& body, int radius) {
  const Grid& grid = body.grid;
  std::vector<std::size_t> points;
  for (const CrackSurface& crack : body.cracks) {
    for (const auto& piece : crack.pieces(radius * grid.spacing)) {
      GridIndex low{}, high{};
      for (int axis = 0; axis < grid.dimension; ++axis) {
        const auto place = [&](double x) {
          return std::clamp((x - grid.origin[axis]) / grid.spacing - grid.first_depth(), -1e6, 1e9);
        };
        low[axis] = std::max(0, static_cast<int>(std::floor(place(piece[0][axis]))) - radius);
        high[axis] = std::min(grid.count(axis) - 1, static_cast<int>(std::ceil(place(piece[1][axis]))) + radius);
      }
      for (int z = low[2]; z <= high[2]; ++z) {
        for (int y = low[1]; y <= high[1]; ++y) {
          for (int x = low[0]; x <= high[0]; ++x) points.push_back(grid.number({x, y, z}));
        }
      }
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

std::vector<CutBond> find_cut_bonds(const Body& body, const Stencil& stencil) {
  const BondTracer tracer(body);
  const std::vector<StencilEntry> forward = forward_half(stencil);
  BondPath path;
  std::vector<CutBond> cuts;
  for (const std::size_t point : points_near_cracks(body, stencil.radius)) {
    const GridIndex p = body.grid.index(point);
    if (!is_inside(body, p)) continue;
    for (const StencilEntry& entry : forward) {
      const GridIndex q = shifted(p, entry.offset);
      if (!is_inside(body, q)) continue;
      const std::size_t other = body.grid.number(q);
      tracer.trace(body.grid.position(p), body.material_of[point], body.grid.position(q), body.material_of[other],
                   path);
      if (!path.crossings.empty()) cuts.push_back({point, other, path.crossings.front().time});
    }
  }
  return cuts;
}

std::size_t count_bonds(const Body& body, const Stencil& stencil) {
  const Grid& grid = body.grid;
  std::size_t count = 0;
  if (!body.has_voids()) {
    for (const StencilEntry& entry : forward_half(stencil)) {
      std::size_t pairs = 1;
      for (int axis = 0; axis < 3; ++axis) {
        pairs *= static_cast<std::size_t>(std::max(0, grid.count(axis) - std::abs(entry.offset[axis])));
      }
      count += pairs;
    }
    return count;
  }
  const std::vector<StencilEntry> forward = forward_half(stencil);
#pragma omp parallel for schedule(static) reduction(+ : count)
  for (std::size_t n = 0; n < grid.size(); ++n) {
    if (body.material_of[n] == no_material) continue;
    const GridIndex p = grid.index(n);
    for (const StencilEntry& entry : forward) count += is_inside(body, shifted(p, entry.offset)) ? 1 : 0;
  }
  return count;
}

std::vector<double> damage(const Body& body, const Stencil& stencil, const std::vector<CutBond>& cuts, double time) {
  std::vector<double> result(body.grid.size(), 0.0);
  for (const CutBond& cut : cuts) {
    if (cut.time > time) continue;
    result[cut.first] += 1.0;
    result[cut.second] += 1.0;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < result.size(); ++n) {
    if (body.material_of[n] == no_material) result[n] = std::numeric_limits<double>::quiet_NaN();
    if (!(result[n] > 0.0)) continue;
    const GridIndex p = body.grid.index(n);
    double bonds = 0.0;
    for (const StencilEntry& entry : stencil.entries) bonds += is_inside(body, shifted(p, entry.offset)) ? 1.0 : 0.0;
    result[n] /= bonds;
  }
  return result;
}

}  // namespace peritherm
