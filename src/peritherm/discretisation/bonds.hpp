#pragma once

#include <functional>
#include <vector>

#include "peritherm/discretisation/bond_path.hpp"
#include "peritherm/discretisation/cut_schedule.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/discretisation/points.hpp"
#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {

/// Every bond of every owned point, row by row.
struct Bonds {
  std::vector<BondIndex> row_begin;      ///< owned points + 1
  std::vector<std::int64_t> neighbours;  ///< entry of j in a field
  std::vector<double> conductances;      ///< G_ij [W/K]
  CutSchedule cuts;                      ///< conductances that change in time
};

/// Pairs × stencil × materials × cracks. Conductance of a bond: that of the stencil at their distance along each axis,
/// times the shares of a cell that the own volume of i and the source volume of j are; where it stands for the own cell
/// of i, times the source volume of i instead.
Bonds make_bonds(const Points& points, const Stencil& stencil, const BondTracer& tracer,
                 const std::function<std::size_t(std::size_t, std::size_t)>& partner);

/// The points of a body and the fictitious points that its mirrored faces need.
Points make_points(const Body& body, const PaddedGrid& layout);

/// Where only a part of a face is held, or its parts in several ways, a bond reaches a held fictitious point only if
/// both of its ends lie opposite places held alike; the others see the mirrored point instead. This keeps conductances
/// symmetric.
/// Returns the point that i exchanges heat with in place of j.
GridIndex partner_of(const Body& body, const GridIndex& i, const GridIndex& j);

}  // namespace peritherm
