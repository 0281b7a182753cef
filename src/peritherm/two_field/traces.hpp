#pragma once

#include <span>

#include "peritherm/two_field/gradient_classes.hpp"

namespace peritherm {

/// Weights on some points of one part, exact for linear functions: the temperature at a place of its surface.
struct Trace {
  std::vector<PointIndex> points;  ///< numbers within the part
  std::vector<double> weights;     ///< their sum is 1
};

/// One per surface point. Bars: from Gᵀ V 1, which vanishes but near the ends; plane faces of lattices: along the rows
/// of points below them. Else one-sided least squares over the points within a few spacings. Throws Error if there are
/// too few of them, naming the place.
std::vector<Trace> make_traces(const SubDomain& part, std::span<const SurfacePoint> surface, const Families& families,
                               const GradientClasses& gradient);

}  // namespace peritherm
