#pragma once

#include <string>
#include <vector>

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/reduction/method.hpp"
#include "peritherm/reduction/sparse_heat.hpp"

namespace peritherm {

/// Points whose temperatures stay unknowns.
struct RetainedSet {
  std::vector<std::int64_t> points;  ///< numbers in the grid, ascending; none of them held
  std::vector<std::string> notes;    ///< for the user
};

/// `present`, `is_free` per point of the grid: not cut away; neither cut away nor held. The random choice is the same
/// on every machine. Throws Error, with all that is wrong, if nothing free is selected or a place has no point.
RetainedSet select_retained(const RetainedPoints& choice, const Grid& grid, const std::vector<bool>& present,
                            const std::vector<bool>& is_free);

/// Throws Error, saying where, if the points that are not retained have a piece among them that exchanges heat neither
/// with a retained point nor with anything held or outside, so that nothing decides its temperature.
/// `truncated`: those not retained, as `heat` numbers the free points, ascending.
void require_anchors(const SparseHeat& heat, const std::vector<std::int32_t>& truncated, const Grid& grid);

}  // namespace peritherm
