#include "peritherm/discretisation/surface_pieces.hpp"

#include <cmath>
#include <utility>

#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// Walks over the faces of whole cells.
class FaceCollector {
 public:
  FaceCollector(const CellBlock& block, const Grid& box, std::vector<SurfacePiece>& pieces, std::vector<OpenFace>& open)
      : block_(block), grid_(block.grid), area_(grid_.cell_volume() / grid_.spacing), pieces_(pieces), open_(open) {
    for (int n = 0; n < 6; ++n) border_[n] = n / 2 < grid_.dimension ? box_face(box, grid_, n / 2, n % 2 == 1) : -1;
  }

  void collect(std::size_t cell, const GridIndex& place) {
    std::size_t stride = 1;
    for (int axis = 0; axis < grid_.dimension; ++axis) {
      if (place[axis] == 0) add_border(cell, place, axis, false);
      if (place[axis] + 1 == grid_.cells[axis]) {
        add_border(cell, place, axis, true);
      } else {
        add_inner(cell, cell + stride, place, axis);
      }
      stride *= static_cast<std::size_t>(grid_.cells[axis]);
    }
  }

 private:
  void add_border(std::size_t cell, const GridIndex& place, int axis, bool upper) {
    if (block_.cut(cell) || block_.part_of[cell] < 0) return;
    const int face = border_[2 * axis + (upper ? 1 : 0)];
    if (face < 0) {
      open_.push_back({axis, upper, place, block_.part_of[cell]});
    } else {
      add(cell, place, axis, upper, block_.part_of[cell], -1, face);
    }
  }

  /// Between a cell and the one above it along an axis.
  void add_inner(std::size_t low, std::size_t high, const GridIndex& place, int axis) {
    const int below = block_.part_of[low];
    const int above = block_.part_of[high];
    if (below == above || block_.cut(low) || block_.cut(high)) return;
    GridIndex next = place;
    ++next[axis];
    if (block_.kind_of[high] == on_other_grid) {
      open_.push_back({axis, true, place, below});
    } else if (block_.kind_of[low] == on_other_grid) {
      open_.push_back({axis, false, next, above});
    } else if (below >= 0 && (above < 0 || below < above)) {
      add(low, place, axis, true, below, above, -1);
    } else {
      add(high, next, axis, false, above, below, -1);
    }
  }

  void add(std::size_t cell, const GridIndex& place, int axis, bool upper, int first, int second, int face) {
    SurfacePiece piece;
    piece.position = grid_.position(place);
    piece.position[axis] = grid_.origin[axis] + (place[axis] + (upper ? 1 : 0)) * grid_.spacing;
    piece.area[axis] = upper ? area_ : -area_;
    piece.first = first;
    piece.second = second;
    piece.face = face;
    piece.cell = cell;
    pieces_.push_back(piece);
  }

  const CellBlock& block_;
  const Grid& grid_;
  double area_;
  std::array<int, 6> border_{};
  std::vector<SurfacePiece>& pieces_;
  std::vector<OpenFace>& open_;
};

double border_of(const Grid& grid, int axis, bool upper) {
  return grid.origin[axis] + (upper ? grid.cells[axis] * grid.spacing : 0.0);
}

}  // namespace

int box_face(const Grid& box, const Grid& grid, int axis, bool upper) {
  const double away = std::abs(border_of(grid, axis, upper) - border_of(box, axis, upper));
  return away <= 1e-6 * std::min(grid.spacing, box.spacing) ? 2 * axis + (upper ? 1 : 0) : -1;
}

void append_cell_faces(const CellBlock& block, const Grid& box, std::vector<SurfacePiece>& pieces,
                       std::vector<OpenFace>& open) {
  FaceCollector collector(block, box, pieces, open);
  std::size_t cell = 0;
  for (int z = 0; z < block.grid.cells[2]; ++z) {
    for (int y = 0; y < block.grid.cells[1]; ++y) {
      for (int x = 0; x < block.grid.cells[0]; ++x) collector.collect(cell++, {x, y, z});
    }
  }
}

SurfacePoint to_surface_point(const SurfacePiece& piece) {
  const double area = length(piece.area);
  return {piece.position, scaled(piece.area, 1.0 / area), area, piece.first, piece.second, piece.face};
}

}  // namespace peritherm
