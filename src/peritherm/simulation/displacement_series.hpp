#pragma once

#include "peritherm/discretisation/broken_bonds.hpp"
#include "peritherm/discretisation/displacements.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// The displacements that a problem with [damage] gives the points of its body: at 0, every, 2 every, … from
/// expressions, once if they do not depend on t; at the times of a table else. Throws Error if an expression is not
/// finite, or if the table is not what `check` saw.
DisplacementSeries make_displacement_series(const DamageOptions& options, const Body& body);

/// Does any of the expressions depend on t?
bool depends_on_time(const std::vector<Profile>& displacement);

/// Which bonds break; none without [damage]. The body must know its materials and faces.
BrokenBonds break_bonds(const Problem& problem, const Body& body, const Stencil& stencil);

}  // namespace peritherm
