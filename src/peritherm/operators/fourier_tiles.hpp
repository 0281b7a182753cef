#pragma once

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/operators/precision.hpp"

namespace peritherm {

/// How transforms cover a grid. Each takes a box of at least kept + 2 radius entries per axis, fictitious ones
/// included, so that whatever wraps around its ends reaches only results that are not kept ("overlap-save"). Since the
/// stencil is even, its transform is real, and one complex transform serves two tiles: one as real, one as imaginary
/// part.
struct FourierTiling {
  GridIndex count{1, 1, 1};   ///< tiles along each axis
  GridIndex kept{1, 1, 1};    ///< points that one tile yields along each axis
  GridIndex extent{1, 1, 1};  ///< lengths of the transform: 2^a 3^b 5^c 7^d

  int tiles() const { return count[0] * count[1] * count[2]; }
  int pairs() const { return (tiles() + 1) / 2; }
};

/// The tiling with the least expected work.
FourierTiling choose_fourier_tiling(const Grid& grid, int radius, Precision precision);

/// Expected time of one evaluation by these tiles on one core of the machine that the model was fitted to [s].
double fourier_seconds(const FourierTiling& tiling, Precision precision);

/// How the numbers of a pair of tiles lie in memory. Rows start on cache lines, an odd number of lines apart, so that
/// columns do not compete for the same cache sets; they are worked on `lanes` at a time.
struct FourierLayout {
  static constexpr int lanes = 8;

  FourierLayout(const FourierTiling& tiling, int dimension);

  std::ptrdiff_t x_row;  ///< numbers from row to row where x runs fastest
  std::ptrdiff_t y_row;  ///< the same where y runs fastest
  std::ptrdiff_t plane;  ///< from plane to plane, in 3-D
  std::size_t turned;    ///< numbers of a plane in which y runs fastest
  std::size_t pair;      ///< numbers that are kept of a pair of tiles between its two halves of the transform
  std::size_t symbol;    ///< values of the symbol
};

/// Memory of one pair of tiles and of the symbol [B].
std::size_t fourier_bytes(const FourierTiling& tiling, int dimension, Precision precision);

}  // namespace peritherm
