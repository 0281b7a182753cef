#pragma once

#include "peritherm/simulation/assemble.hpp"

namespace peritherm {

/// What the cracks whose faces mirror make of a body that has its materials, walls, cracks and stencil. The problem
/// must be resolved.
MirroredFaces mirror_cracks(const Problem& problem, const Geometry& geometry);

}  // namespace peritherm
