#pragma once

#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/simulation/read.hpp"

namespace peritherm {

/// The grid that the body asks for. The problem must have passed `find_faults`.
Grid make_grid(const Problem& problem);

/// Horizon [m], from horizon or horizon_ratio.
double horizon_of(const Problem& problem);

/// What its bonds are made from.
StencilOptions stencil_options_of(const Problem& problem);

/// Every rule that spans several options; empty if the problem can be used. Places are looked up by key.
std::vector<Issue> find_faults(const Problem& problem, const Locations& locations = {}, CaseUse use = CaseUse::run);

/// Throws Error with all of them.
void check(const Problem& problem, const Locations& locations = {}, CaseUse use = CaseUse::run);

}  // namespace peritherm
