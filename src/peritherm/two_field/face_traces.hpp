#pragma once

#include <optional>

#include "peritherm/two_field/families.hpp"
#include "peritherm/two_field/place_numbers.hpp"
#include "peritherm/two_field/traces.hpp"

namespace peritherm {

/// Traces on plane faces of a lattice along the rows of points straight below them, with the weights that Gᵀ V 1 has
/// below an endless face: with them G needs a correction at corners and edges only.
class FaceTraces {
 public:
  FaceTraces(int dimension, const SubDomain& part, const Families& families);

  /// None where the place is not the middle of one or several faces of cells, its rows of points are too short, or a
  /// face of the outside ends there.
  std::optional<Trace> at(const SurfacePoint& place) const;

  /// The axis along the edge of a solid that an outside face of a cell lies beside: there traces must keep to their own
  /// slice, else those of both faces follow from one another. None in corners.
  std::optional<int> edge_at(const SurfacePoint& place) const;

 private:
  std::optional<int> axis_of(const SurfacePoint& place) const;
  PointIndex point_below(const SurfacePoint& place, int axis) const;
  bool ends_beside(PointIndex first, int along) const;
  std::optional<Trace> row_below(const Point& face, int axis, int side) const;

  int dimension_;
  const SubDomain& part_;
  PlaceNumbers numbers_;
  std::vector<double> weights_;  ///< from the face inwards
};

}  // namespace peritherm
