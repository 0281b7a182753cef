#pragma once

#include <array>
#include <vector>

#include "peritherm/discretisation/body.hpp"

namespace peritherm {

/// Where the points of a body, and the places on its faces, have moved at one time. Cut-away points may hold anything.
struct Displacements {
  double time = 0.0;                         ///< [s]
  std::vector<double> points;                ///< `dimension` numbers per point, x fastest [m]
  std::array<std::vector<double>, 6> walls;  ///< the same per place of a face, numbered by Body::wall_place [m]

  /// With room for every point and place.
  static Displacements of(const Body& body);
};

/// Carries the displacements of the two outermost layers of points on to the faces, linearly.
void carry_to_walls(const Body& body, Displacements& displacements);

/// A bond and its mirror images as one: it begins at the point of smaller number.
struct DirectedBond {
  GridIndex from;  ///< inside the grid
  GridIndex to;    ///< may lie beyond mirrored faces
};
/// The mirror image of a bond that stands for both of its directions.
DirectedBond representative(const Body& body, const GridIndex& p, const GridIndex& q);

/// η, the displacement of the end of a bond relative to its beginning [m] [bobaru2010, eq. 15]. A bond that leaves
/// through mirrored faces sees the body's mirror image, which moves with the face: with w where the bond passes it and
/// R its reflection, η = u(w) − u(from) + R (u(to's point) − u(w)).
Point relative_displacement(const Body& body, const Displacements& displacements, const DirectedBond& bond);

}  // namespace peritherm
