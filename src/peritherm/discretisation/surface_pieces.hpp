#pragma once

#include <vector>

#include "peritherm/discretisation/cell_block.hpp"

namespace peritherm {

/// A piece of surface before neighbours are merged.
struct SurfacePiece {
  Point position{};      ///< centroid [m]
  Point area{};          ///< A n, out of `first` [m²]
  int first = 0;         ///< part
  int second = -1;       ///< part; −1: the outside
  int face = -1;         ///< of the box, as Face
  std::size_t cell = 0;  ///< where it lies, on its grid
  bool movable = false;  ///< not along cells, so that its place is not exact
};

/// A face of a cell with a part on this side and another grid, or the border of the grid, on the other.
struct OpenFace {
  int axis = 0;
  bool upper = false;
  GridIndex place{};  ///< of the cell on this side
  int part = 0;
};

/// Appends the faces of whole cells between parts of one grid and around them. Faces on the border of the grid are
/// outside if they lie on a face of the box, else they go to `open`.
void append_cell_faces(const CellBlock& block, const Grid& box, std::vector<SurfacePiece>& pieces,
                       std::vector<OpenFace>& open);

/// The face of the box that a border of a grid lies on, as Face; −1: none.
int box_face(const Grid& box, const Grid& grid, int axis, bool upper);

/// Merges small pieces with neighbours between the same parts and of like direction until those that are not along
/// cells are about two spacings wide, and pieces of faces of the box at least most of a face of a cell. Looks at the
/// pieces from number `begin` on, all on this grid. Areas A n are kept.
void merge_small_pieces(const Grid& grid, std::size_t begin, std::vector<SurfacePiece>& pieces);

/// Moves pieces by as little as can be, least squares, so that Σ A n = 0 and Σ A n xᵀ = (Σ V) 1 around every part to
/// rounding: those that are movable, or all if that does not do. Returns the numbers of parts too small for it.
std::vector<std::size_t> close_surfaces(int dimension, const std::vector<SubDomain>& parts,
                                        std::vector<SurfacePiece>& pieces);

SurfacePoint to_surface_point(const SurfacePiece& piece);

}  // namespace peritherm
