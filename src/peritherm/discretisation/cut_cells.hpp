#pragma once

#include <vector>

#include "peritherm/discretisation/cell_block.hpp"
#include "peritherm/discretisation/surface_pieces.hpp"

namespace peritherm {

/// Shares out the cells that surfaces run through. Heights above the surfaces are taken at the corners and are linear
/// on the d! simplices along the diagonal of each cell [kuhn1960], which fit together across cells; each layer, from
/// the last to the first, cuts its own off. Volumes go to the nearest point of the part they belong to. Appends the
/// pieces of surface, one per cell and pair of parts. Whatever is cut, the pieces close around every part exactly.
void share_cut_cells(const CellBlock& block, const Grid& box, const std::vector<PartKind>& kinds,
                     std::vector<SubDomain>& parts, std::vector<SurfacePiece>& pieces, std::vector<Issue>& issues);

}  // namespace peritherm
