#pragma once

#include <vector>

#include "peritherm/discretisation/surface_pieces.hpp"

namespace peritherm {

/// Joins faces of cells where two grids meet: one piece per face of the coarser grid and part on the other side, small
/// ones merged; what meets nothing is outside. `open`: for each block.
void join_grids(const std::vector<CellBlock>& blocks, const std::vector<std::vector<OpenFace>>& open,
                std::vector<SurfacePiece>& pieces);

/// A grid of its own over a box, which is cut off at the borders of the body. Appends issues if the box is no whole
/// number of spacings, or if its sides are not along the cells of a grid that it overwrites.
Grid make_own_grid(const PartRegion& region, const Grid& body, const std::vector<CellBlock>& overwritten,
                   std::vector<Issue>& issues);

}  // namespace peritherm
