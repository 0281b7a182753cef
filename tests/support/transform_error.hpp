#pragma once

#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/operators/fourier_tiles.hpp"
#include "support/tolerance.hpp"

namespace peritherm {

/// Half the distance from 1 to the next number.
inline double unit_roundoff(Precision precision) { return precision == Precision::single ? 0x1p-24 : 0x1p-53; }

/// Bound of the Euclidean norm of the errors of sums by transforms, over 2 Σ G, when temperatures differ by at most
/// `spread`. A transform of N numbers errs by at most 7 u log2 N in this norm, relative to its input [higham2002,
/// theorem 24.2, with the constant of its proof rounded up]; it is made there and back, the symbol is at most 2 Σ G in
/// size, and input, symbol and product are rounded once each.
inline double transform_error(const FourierTiling& tiling, const PaddedGrid& layout, Precision precision,
                              double spread) {
  double entries = 1.0, numbers = 1.0;
  for (int axis = 0; axis < layout.grid().dimension; ++axis) {
    entries *= std::min(tiling.extent[axis], layout.grid().count(axis) + 2 * layout.padding(axis));
    numbers *= tiling.extent[axis];
  }
  const double norm = spread * std::sqrt(tiling.tiles() * entries);
  return (14.0 * std::log2(numbers) + 8.0) * unit_roundoff(precision) * norm;
}

}  // namespace peritherm
