#pragma once

#include <array>
#include <vector>

#include "peritherm/discretisation/cell_block.hpp"

namespace peritherm {

/// More surfaces than this in one cell are refused.
inline constexpr std::size_t most_cut_surfaces = 12;

/// Beyond the border of the grid, as a kind.
inline constexpr KindIndex beyond_border = -3;

/// What part of a cell is of a kind.
struct CellShare {
  KindIndex kind = nothing;
  double volume = 0.0;  ///< [m³]
  Point moment{};       ///< ∫ x dV [m⁴]
};

/// Surface inside a cell, or on its faces, between two kinds.
struct CellPiece {
  KindIndex first = nothing, second = nothing;
  int border = -1;    ///< of the grid, numbered like faces of the box; −1: inside
  Point area{};       ///< ∫ n dA, out of `first` [m²]
  Point moment{};     ///< ∫ x dA [m³]
  double size = 0.0;  ///< ∫ dA [m²]
};

struct CellDivision {
  std::vector<CellShare> shares;
  std::vector<CellPiece> pieces;
};

/// Divides one cell by its layers. Faces towards cells that are cut themselves belong to the lower of both cells.
/// Throws Error if too many surfaces run through it.
CellDivision divide_cell(const CellBlock& block, const NearLayers& layers, std::size_t cell);

}  // namespace peritherm
