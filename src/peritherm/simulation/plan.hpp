#pragma once

#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/simulate.hpp"

namespace peritherm {

/// Throws Error (Fault::machine) with the figures if the run would not fit into the memory that is available; nothing
/// large has been allocated by then.
void refuse_if_too_large(const Problem& problem);

Plan make_plan(const Problem& problem, const Assembly& assembly, const ChosenStepping& chosen, int threads);

/// Threads that a run uses; also tells OpenMP.
int set_threads(const Problem& problem);

}  // namespace peritherm
