#pragma once

#include "peritherm/simulation/simulate.hpp"
#include "peritherm/simulation/two_field_assembly.hpp"

namespace peritherm {

/// Throws Error (Fault::machine) if a run would not fit into the memory that is available; nothing large has been made
/// by then.
void refuse_if_two_fields_are_too_large(const Problem& problem);

/// Resolves what the case leaves open, and tells OpenMP the number of threads. Throws Error (Fault::machine) if the run
/// would not fit into the memory that is available.
Problem prepare_two_field(const Problem& problem);

Plan make_two_field_plan(const Problem& problem, const TwoFieldAssembly& assembly, const Grid& raster);

}  // namespace peritherm
