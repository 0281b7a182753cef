#pragma once

#include <span>
#include <vector>

#include "peritherm/output/plane.hpp"

namespace peritherm {

/// Samples of a field on a lattice, x fastest, at places (i, j).
struct Samples {
  int columns = 0;
  int rows = 0;
  std::vector<double> values;  ///< NaN where there is nothing
  std::vector<bool> blocked;   ///< one per cell, (columns − 1) × (rows − 1): no line may pass
  double at(int i, int j) const { return values[static_cast<std::size_t>(j) * columns + i]; }
};

/// Lines of equal value by marching squares, in lattice coordinates; saddles are decided by the mean of the corners.
/// Cells that are blocked, have no value at a corner, or change by less than `flat` hold no line: where a field is
/// constant but for rounding, a line would be noise.
std::vector<Line> find_isolines(const Samples& samples, double level, double flat);

}  // namespace peritherm
