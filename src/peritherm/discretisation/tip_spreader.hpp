#pragma once

#include <vector>

#include "peritherm/discretisation/face_points.hpp"

namespace peritherm {

/// Adds to the shares of the points near faces, [point][entry], what calibrated tips change.
void adjust_tips(const Body& body, const Stencil& stencil, const FacePoints& points, double horizon_ratio,
                 std::vector<std::vector<double>>& shares);

}  // namespace peritherm
