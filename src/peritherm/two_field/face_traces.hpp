#pragma once

#include <array>
#include <optional>
#include <set>
#include <span>

#include "peritherm/two_field/families.hpp"
#include "peritherm/two_field/place_numbers.hpp"
#include "peritherm/two_field/traces.hpp"

namespace peritherm {

/// Traces on plane faces of a lattice along the rows of points straight below them, with the weights that Gᵀ V 1 has
/// below an endless face: with them G needs a correction at corners and edges only.
class FaceTraces {
 public:
  FaceTraces(int dimension, const SubDomain& part, std::span<const SurfacePoint> surface, const Families& families);

  /// None where the place is not the middle of one or several faces of cells, its rows of points are too short, or a
  /// face of the outside ends there at another part.
  std::optional<Trace> at(const SurfacePoint& place) const;

 private:
  GridIndex cell_below(const SurfacePoint& place) const;
  bool ends_beside(PointIndex first, int axis) const;
  std::optional<Trace> row_below(const Point& face, int axis, int side) const;

  int dimension_;
  const SubDomain& part_;
  PlaceNumbers numbers_;
  std::set<std::array<int, 4>> touched_;  ///< cells beside another part, and the direction
  std::vector<double> weights_;           ///< from the face inwards
};

}  // namespace peritherm
