#pragma once

#include <vector>

#include "peritherm/base/field_storage.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/system/heat_system.hpp"

namespace peritherm {

/// States that are 1 on a part of the body that neither exchanges heat with the rest nor with what is held or with
/// surroundings, and 0 elsewhere. At most `most`; where the search would take too long, the body as a whole or none.
/// `capacities` per entry, 0 where nothing is free. Adds to `evaluations`.
std::vector<FieldStorage> find_closed_parts(HeatSystem& system, const PaddedGrid& layout, ConstField capacities,
                                            std::size_t most, long& evaluations);

}  // namespace peritherm
