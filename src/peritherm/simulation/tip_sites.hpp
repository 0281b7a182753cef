#pragma once

#include <vector>

#include "peritherm/output/observer.hpp"
#include "peritherm/simulation/assemble.hpp"

namespace peritherm {

/// The free tips of the cracks of a plate at a time. An end outside the body, on one of its faces, in a part that was
/// cut away, or on another crack is none.
std::vector<TipSite> tip_sites(const Geometry& geometry, double time);

}  // namespace peritherm
