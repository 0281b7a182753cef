#include "peritherm/discretisation/bonds.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/neighbours.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// The stencil's conductances by the difference of two points' positions.
class ConductanceTable {
 public:
  ConductanceTable(const Stencil& stencil, const Points& points) : spacing_(points.spacing) {
    for (int axis = 0; axis < points.dimension; ++axis) radius_[axis] = stencil.radius;
    conductances_.resize(static_cast<std::size_t>(2 * radius_[0] + 1) * (2 * radius_[1] + 1) * (2 * radius_[2] + 1));
    for (std::size_t k = 0; k < stencil.entries.size(); ++k) {
      const auto& [offset, conductance] = stencil.entries[k];
      const double self = stencil.self.empty() ? 0.0 : stencil.self[k];
      conductances_[place(offset)] = {conductance - self, self};
      reach_ = std::max(reach_, std::hypot(offset[0], offset[1], offset[2]));
    }
  }
  /// Length of the longest bond [m].
  double reach() const { return reach_ * spacing_; }
  struct Parts {
    double bond = 0.0;
    double self = 0.0;  ///< stands for the own cell of the point whose rate it is
  };
  Parts operator()(const Point& difference) const {
    GridIndex offset;
    for (int axis = 0; axis < 3; ++axis) {
      offset[axis] = static_cast<int>(std::lround(difference[axis] / spacing_));
      if (std::abs(offset[axis]) > radius_[axis]) return {};
    }
    return conductances_[place(offset)];
  }

 private:
  std::size_t place(const GridIndex& offset) const {
    std::size_t result = 0;
    for (int axis = 2; axis >= 0; --axis) {
      result = result * static_cast<std::size_t>(2 * radius_[axis] + 1) +
               static_cast<std::size_t>(offset[axis] + radius_[axis]);
    }
    return result;
  }

  double spacing_;
  double reach_ = 0.0;
  GridIndex radius_{};
  std::vector<Parts> conductances_;
};

}  // namespace

Bonds make_bonds(const Points& points, const Stencil& stencil, const BondTracer& tracer,
                 const std::function<std::size_t(std::size_t, std::size_t)>& partner) {
  const ConductanceTable conductance(stencil, points);
  const Neighbours pairs = find_neighbours(points, conductance.reach());
  const double cell = std::pow(points.spacing, points.dimension);
  Bonds bonds;
  bonds.row_begin.push_back(0);
  BondPath path;
  for (std::size_t i = 0; i < points.owned; ++i) {
    for (BondIndex b = pairs.row_begin[i]; b < pairs.row_begin[i + 1]; ++b) {
      const auto j = static_cast<std::size_t>(pairs.points[b]);
      const auto [bond, self] = conductance(difference(points.positions[j], points.positions[i]));
      const double unit = (points.volumes[i] / cell) *
                          (bond * (points.source_volumes[j] / cell) + self * (points.source_volumes[i] / cell));
      if (unit == 0.0) continue;
      tracer.trace(points.positions[i], points.materials[i], points.positions[j], points.materials[j], path);
      const double full = unit * path.conductivity;
      bonds.cuts.add(bonds.conductances.size(), 0.0, full, path);
      bonds.neighbours.push_back(points.entries[partner ? partner(i, j) : j]);
      bonds.conductances.push_back(full * standing_share(path));
    }
    bonds.row_begin.push_back(static_cast<BondIndex>(bonds.conductances.size()));
  }
  bonds.cuts.sort();
  return bonds;
}

Points make_points(const Body& body, const PaddedGrid& layout) {
  const Grid& grid = body.grid;
  Points points;
  points.dimension = grid.dimension;
  points.spacing = grid.spacing;
  const auto append = [&](const GridIndex& p) {
    const MaterialIndex material = body.material_of_extended(p);
    if (material == no_material) return;
    points.positions.push_back(grid.position(p));
    points.materials.push_back(material);
    points.source_volumes.push_back(grid.cell_volume() * body.source_share(p));
    points.entries.push_back(static_cast<std::int64_t>(layout.entry(p)));
  };
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const GridIndex p = grid.index(n);
    const std::size_t before = points.size();
    append(p);
    if (points.size() > before) points.volumes.push_back(grid.cell_volume() * body.volume_share(p));
  }
  points.owned = points.size();
  const auto pad = [&](int axis) { return layout.padding(axis); };
  for (int z = -pad(2); z < grid.count(2) + pad(2); ++z) {
    for (int y = -pad(1); y < grid.count(1) + pad(1); ++y) {
      for (int x = -pad(0); x < grid.count(0) + pad(0); ++x) {
        if (!grid.contains({x, y, z})) append({x, y, z});
      }
    }
  }
  return points;
}

GridIndex partner_of(const Body& body, const GridIndex& i, const GridIndex& j) {
  GridIndex partner = j;
  const GridIndex folded = body.fold(j);
  for (int axis = 0; axis < body.grid.dimension; ++axis) {
    if (folded[axis] == j[axis]) continue;
    const Face face = make_face(axis, j[axis] > folded[axis]);
    if (!body.walls[static_cast<int>(face)].partly_held) continue;
    const WallKind kind = body.wall_kind_at(face, j);
    if (is_held(kind) && kind != body.wall_kind_at(face, i)) partner[axis] = folded[axis];
  }
  return partner;
}

}  // namespace peritherm
