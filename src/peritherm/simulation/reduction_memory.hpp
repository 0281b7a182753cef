#pragma once

#include "peritherm/reduction/method.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// Memory that a reduction may take besides the body itself, estimated from the numbers of points and unknowns [B].
double reduction_bytes(const Problem& problem, const ReductionMethod& method);

/// Throws Error (Fault::machine) with the figures if what it takes with the body, `bytes`, is more than is available.
/// Nothing large has been allocated by then.
void refuse_large_reduction(const Problem& problem, const ReductionMethod& method, double bytes);

}  // namespace peritherm
