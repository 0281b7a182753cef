#pragma once

#include <vector>

#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {

/// A bond near a tip and by how much its share of the stencil's conductance changes, the same both ways.
struct TipChange {
  GridIndex point;  ///< relative to the point at or below the tip
  int entry;        ///< of the stencil
  double change;
};

/// A tip of a crack in 2-D, in spacings.
struct TipPlace {
  double x = 0.0, y = 0.0;  ///< place within its cell of points, 0 to 1
  double angle = 0.0;       ///< in which direction the crack would go on
  bool at_end = true;       ///< points on the crack belong to its left side, seen towards the tip; else to its right
};

/// How the bonds within a horizon of a tip must change for the discrete crack to act from afar as the classical one: on
/// a patch of the same grid around the end of a half-infinite crack, whose outside has the exact modes √r sin(θ/2),
/// r cos θ and r^(3/2) sin(3θ/2), the first mode shall exert no force on any of the three. `shift`: how far the tip is
/// pulled back, in spacings. Answers are remembered.
std::vector<TipChange> calibrate_tip(const Stencil& stencil, double horizon_ratio, const TipPlace& tip, double shift);

}  // namespace peritherm
