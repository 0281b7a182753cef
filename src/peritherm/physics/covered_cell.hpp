#pragma once

#include <array>
#include <functional>

namespace peritherm {

/// Centre of a cell of edge 1, in cells away from the origin; 0 along unused axes.
using CellOffset = std::array<int, 3>;

/// Volume of the part of a cell that lies within the distance `radius` of the origin; exact to 1e-11.
double covered_volume(const CellOffset& cell, double radius, int dimension);

/// ∫ f(|x|) dV over that part, to 1e-11 of its size where f is smooth between 1/2 and `radius`. The cell is none that
/// contains the origin.
double integral_over_covered(const std::function<double(double)>& f, const CellOffset& cell, double radius,
                             int dimension);

/// Volume of a ball: 2 r, π r², 4/3 π r³.
double ball_volume(double radius, int dimension);

}  // namespace peritherm
