#include "peritherm/discretisation/cell_block.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/base/text.hpp"
#include "peritherm/discretisation/point_blocks.hpp"
#include "peritherm/geometry/vector.hpp"

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
      const CornerHeights heights = heights_at_corners(layer->shape, block_.grid, block_.grid.index(cell));
      // All corners on one surface: what is one cell thick has both sides there.
      const bool flat = heights.inside() && heights.outside();
      const bool inside = flat ? height_above(layer->shape, centre) < 0.0 : heights.inside();
      if (inside) at_corners = layer->kind;
      // What is inside hides the surfaces of earlier layers.
      cut = !inside && (cut || !heights.outside());
    }
    if (cut) return mark_cut(cell);
    if (at_corners != block_.kind_of[cell]) report(cell, at_corners, centre);
  }

  /// No corner of a cell is farther from its centre.
  double reach_of_cell() const {
    return 0.5 * (1.0 + 1e-6) * std::sqrt(static_cast<double>(block_.grid.dimension)) * block_.grid.spacing;
  }

 private:
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

/// Numbers the cells of connected components.
class ComponentFinder {
 public:
  explicit ComponentFinder(CellBlock& block) : block_(block), layers_(all_layers(block)) {}

  /// Gives the component of a cell its number; returns how many cells it has.
  std::size_t flood(std::size_t seed, int part) {
    std::vector<std::size_t> open{seed};
    block_.part_of[seed] = part;
    std::size_t count = 0;
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      ++count;
      const auto visit = [&](std::size_t neighbour) {
        if (block_.part_of[neighbour] >= 0 || block_.kind_of[neighbour] != block_.kind_of[cell]) return;
        block_.part_of[neighbour] = part;
        open.push_back(neighbour);
      };
      for_each_neighbour(block_.grid, cell, visit);
      if (!block_.cut_cells.empty()) visit_diagonal(cell, visit);
    }
    return count;
  }

 private:
  /// Near a surface that is not along cells, two that touch at an edge or a corner hang together if it is inside.
  template <class Visit>
  void visit_diagonal(std::size_t cell, const Visit& visit) const {
    const Grid& grid = block_.grid;
    const GridIndex place = grid.index(cell);
    const int reach[] = {1, grid.dimension > 1 ? 1 : 0, grid.dimension > 2 ? 1 : 0};
    for (int dz = -reach[2]; dz <= reach[2]; ++dz) {
      for (int dy = -reach[1]; dy <= reach[1]; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const GridIndex other{place[0] + dx, place[1] + dy, place[2] + dz};
          if (dx * dx + dy * dy + dz * dz < 2 || !grid.contains(other)) continue;
          const std::size_t neighbour = grid.number(other);
          if (!block_.cut(cell) && !block_.cut(neighbour)) continue;
          if (block_.part_of[neighbour] >= 0 || block_.kind_of[neighbour] != block_.kind_of[cell]) continue;
          const Point touch = between(grid.position(place), grid.position(other), 0.5);
          if (kind_at(layers_, touch, 0.0) == block_.kind_of[cell]) visit(neighbour);
        }
      }
    }
  }

  CellBlock& block_;
  NearLayers layers_;
};

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

double snapped(double height, double spacing) { return std::abs(height) < snapping * spacing ? 0.0 : height; }

void append_snapped_heights(const Shape& shape, const Point& x, double spacing, std::vector<double>& heights) {
  const std::size_t begin = heights.size();
  append_heights(shape, x, heights);
  for (std::size_t k = begin; k < heights.size(); ++k) heights[k] = snapped(heights[k], spacing);
}

bool CornerHeights::outside() const {
  return std::any_of(lowest.begin(), lowest.end(), [](double height) { return height >= 0.0; });
}

bool CornerHeights::inside() const {
  return std::all_of(highest.begin(), highest.end(), [](double height) { return height <= 0.0; });
}

CornerHeights heights_at_corners(const Shape& shape, const Grid& grid, const GridIndex& cell) {
  CornerHeights found;
  std::vector<double> heights;
  for (int corner = 0; corner < 1 << grid.dimension; ++corner) {
    Point x{};
    for (int axis = 0; axis < grid.dimension; ++axis) {
      x[axis] = grid.origin[axis] + (cell[axis] + (corner >> axis & 1)) * grid.spacing;
    }
    heights.clear();
    append_snapped_heights(shape, x, grid.spacing, heights);
    if (corner == 0) found = {heights, heights};
    for (std::size_t k = 0; k < heights.size(); ++k) {
      found.lowest[k] = std::min(found.lowest[k], heights[k]);
      found.highest[k] = std::max(found.highest[k], heights[k]);
    }
  }
  return found;
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
  ComponentFinder finder(block);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (block.kind_of[cell] < 0 || block.part_of[cell] >= 0) continue;
    const std::size_t size = finder.flood(cell, static_cast<int>(parts.size()));
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
