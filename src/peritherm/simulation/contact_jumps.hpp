#pragma once

#include "peritherm/output/material_jumps.hpp"
#include "peritherm/simulation/material_table.hpp"

namespace peritherm {

/// Where temperatures of a two-field body jump at a time: at contacts whose resistance is not 0 there and then.
/// `problem` must outlive them.
MaterialJumps contact_jumps(const Problem& problem, const MaterialTable& table, double time);

}  // namespace peritherm
