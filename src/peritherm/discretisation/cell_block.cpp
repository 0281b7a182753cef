#include "peritherm/discretisation/cell_block.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/base/text.hpp"
#include "peritherm/discretisation/point_blocks.hpp"

namespace peritherm {
namespace {

/// Heights smaller than this share of a spacing are those of a surface through the corner itself.
constexpr double snapping = 1e-9;

/// Below and above along each used axis; calls visit(cell, neighbour) for those inside the grid.
template <class Visit>
void for_each_neighbour(const Grid& grid, std::size_t cell, const Visit& visit) {
  const GridIndex place = grid.index(cell);
  std::size_t stride = 1;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    if (place[axis] > 0) visit(cell - stride);
    if (place[axis] + 1 < grid.cells[axis]) visit(cell + stride);
    stride *= static_cast<std::size_t>(grid.cells[axis]);
  }
}

/// Fills kinds and cuts of single cells near surfaces.
class CellSorter {
 public:
  CellSorter(CellBlock& block, const std::vector<PartKind>& kinds, std::vector<Issue>& issues)
      : block_(block), kinds_(kinds), issues_(issues), reported_(kinds.size(), false) {}

  void sort(std::size_t cell, const NearLayers& layers) {
    const double h = block_.grid.spacing;
    const Point centre = block_.grid.position(block_.grid.index(cell));
    const NearLayers near = near_layers(layers, centre, reach_of_cell(), snapping * h);
    block_.kind_of[cell] = kind_at(near, centre, snapping * h);
    if (near.layers.empty()) return;
    KindIndex at_corners = near.background;
    bool cut = false;
    for (const CellLayer* layer : near.layers) {
      const auto [lowest, highest] = heights_at_corners(layer->shape, centre);
      cut = cut || (lowest < 0.0 && highest > 0.0);
      // Every corner on the surface: something one cell thick, or outside it.
      const bool inside = lowest < 0.0 || (highest == 0.0 && height_above(layer->shape, centre) < 0.0);
      if (inside) at_corners = layer->kind;
    }
    if (cut) return mark_cut(cell);
    if (at_corners != block_.kind_of[cell]) report(cell, at_corners, centre);
  }

  /// No corner of a cell is farther from its centre.
  double reach_of_cell() const {
    return 0.5 * (1.0 + 1e-6) * std::sqrt(static_cast<double>(block_.grid.dimension)) * block_.grid.spacing;
  }

 private:
  std::pair<double, double> heights_at_corners(const Shape& shape, const Point& centre) const {
    const double half = 0.5 * block_.grid.spacing;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (int corner = 0; corner < 1 << block_.grid.dimension; ++corner) {
      Point x = centre;
      for (int axis = 0; axis < block_.grid.dimension; ++axis) x[axis] += (corner >> axis & 1) != 0 ? half : -half;
      const double height = snapped_height(shape, x, block_.grid.spacing);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    return {lowest, highest};
  }

  void mark_cut(std::size_t cell) {
    if (block_.is_cut.empty()) block_.is_cut.resize(block_.grid.size(), 0);
    block_.is_cut[cell] = 1;
    block_.cut_cells.push_back(cell);
  }

  /// Something thinner than a cell runs between the corners, through the centre: it is what is lost.
  void report(std::size_t cell, KindIndex at_corners, const Point& centre) {
    const KindIndex thin = block_.kind_of[cell] >= 0 ? block_.kind_of[cell] : at_corners;
    if (thin < 0 || reported_[thin]) return;
    reported_[thin] = true;
    issues_.push_back(too_thin_for_cells(kinds_[thin], block_.grid, centre));
  }

  CellBlock& block_;
  const std::vector<PartKind>& kinds_;
  std::vector<Issue>& issues_;
  std::vector<bool> reported_;
};

/// Numbers of all cells of the component that a cell belongs to are set to `part`.
std::size_t flood(CellBlock& block, std::size_t seed, int part) {
  std::vector<std::size_t> open{seed};
  block.part_of[seed] = part;
  std::size_t count = 0;
  while (!open.empty()) {
    const std::size_t cell = open.back();
    open.pop_back();
    ++count;
    for_each_neighbour(block.grid, cell, [&](std::size_t neighbour) {
      if (block.part_of[neighbour] >= 0 || block.kind_of[neighbour] != block.kind_of[cell]) return;
      block.part_of[neighbour] = part;
      open.push_back(neighbour);
    });
  }
  return count;
}

SubDomain empty_part(const PartKind& kind, double spacing, std::size_t size) {
  SubDomain part;
  part.name = kind.name;
  part.material = kind.material;
  part.spacing = spacing;
  part.horizon = kind.horizon;
  part.positions.reserve(size);
  part.volumes.assign(size, 0.0);
  part.places.reserve(size);
  return part;
}

}  // namespace

Issue too_thin_for_cells(const PartKind& kind, const Grid& grid, const Point& x) {
  return {{},
          "'" + kind.name + "' is thinner than a cell at " + describe_place(x, grid.dimension),
          "Choose a spacing well below " + shortest(grid.spacing) + " m, so that several points stand across it"};
}

std::string describe_place(const Point& x, int dimension) {
  std::vector<std::string> words;
  for (int axis = 0; axis < dimension; ++axis) words.push_back(shortest(std::round(x[axis] * 1e6) / 1e6));
  return "(" + join(words) + ") m";
}

NearLayers all_layers(const CellBlock& block) {
  NearLayers all{block.background, {}};
  for (const CellLayer& layer : block.layers) all.layers.push_back(&layer);
  return all;
}

NearLayers near_layers(const NearLayers& among, const Point& centre, double distance, double slack) {
  NearLayers near{among.background, {}};
  for (const CellLayer* layer : among.layers) {
    if (surface_within(layer->shape, centre, distance)) {
      near.layers.push_back(layer);
    } else if (contains(layer->shape, centre, slack)) {
      near.background = layer->kind;
      near.layers.clear();
    }
  }
  return near;
}

KindIndex kind_at(const NearLayers& layers, const Point& x, double slack) {
  for (auto layer = layers.layers.rbegin(); layer != layers.layers.rend(); ++layer) {
    if (contains((*layer)->shape, x, slack)) return (*layer)->kind;
  }
  return layers.background;
}

double snapped_height(const Shape& shape, const Point& x, double spacing) {
  const double height = height_above(shape, x);
  return std::abs(height) < snapping * spacing ? 0.0 : height;
}

void assign_kinds(CellBlock& block, const std::vector<PartKind>& kinds, std::vector<Issue>& issues) {
  const Grid& grid = block.grid;
  block.kind_of.assign(grid.size(), block.background);
  if (block.layers.empty()) return;
  const NearLayers all = all_layers(block);
  CellSorter sorter(block, kinds, issues);
  const PointBlocks blocks(grid);
  for (std::int64_t b = 0; b < blocks.size(); ++b) {
    const PointBlock points = blocks[b];
    const double distance = points.half_diagonal + 2.0 * sorter.reach_of_cell();
    const NearLayers near = near_layers(all, points.centre, distance, snapping * grid.spacing);
    for (int z = points.low[2]; z < points.high[2]; ++z) {
      for (int y = points.low[1]; y < points.high[1]; ++y) {
        const std::size_t first = grid.number({points.low[0], y, z});
        const std::size_t end = first + static_cast<std::size_t>(points.high[0] - points.low[0]);
        for (std::size_t cell = first; cell < end; ++cell) {
          if (near.layers.empty()) {
            block.kind_of[cell] = near.background;
          } else {
            sorter.sort(cell, near);
          }
        }
      }
    }
  }
  std::sort(block.cut_cells.begin(), block.cut_cells.end());
}

void append_components(CellBlock& block, const std::vector<PartKind>& kinds, std::vector<SubDomain>& parts) {
  const Grid& grid = block.grid;
  block.part_of.assign(grid.size(), -1);
  block.point_of.assign(grid.size(), 0);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (block.kind_of[cell] < 0 || block.part_of[cell] >= 0) continue;
    const std::size_t size = flood(block, cell, static_cast<int>(parts.size()));
    parts.push_back(empty_part(kinds[static_cast<std::size_t>(block.kind_of[cell])], grid.spacing, size));
  }
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (block.part_of[cell] < 0) continue;
    SubDomain& part = parts[static_cast<std::size_t>(block.part_of[cell])];
    const GridIndex place = grid.index(cell);
    block.point_of[cell] = static_cast<PointIndex>(part.positions.size());
    if (!block.cut(cell)) part.volumes[part.positions.size()] = grid.cell_volume();
    part.positions.push_back(grid.position(place));
    part.places.push_back(place);
  }
}

}  // namespace peritherm
