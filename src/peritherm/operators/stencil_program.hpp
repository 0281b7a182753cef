#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/operators/combination.hpp"

namespace peritherm {

/// The sum over a stencil as columns of weights. Mirror images along x are added before they are multiplied; in 3-D the
/// planes above and below are added first ("folded"), so plane d stands for the offsets −d and +d along z.
struct StencilProgram {
  /// All offsets along y at one distance along x: row r of the outputs takes
  ///   Σ_s weights[first_weight + height + s] · (T[r + s][x − distance] + T[r + s][x + distance]),  s = −height …
  ///   height
  /// and only T[r + s][x] at distance 0.
  struct Column {
    std::int32_t plane;  ///< folded plane, 0 … radius
    std::int32_t distance, height;
    std::int32_t first_weight;
  };

  int dimension = 1;
  int radius = 0;                 ///< largest offset along any axis
  int planes = 1;                 ///< folded planes: 1, in 3-D radius + 1
  std::vector<int> plane_radius;  ///< largest offset along x and y in each plane
  std::vector<Column> columns;
  std::vector<double> weights;
  std::vector<float> single_weights;  ///< the same, rounded so that they sum to 0

  int multiplications() const { return static_cast<int>(weights.size()); }  ///< per output
  std::size_t bytes() const {
    return columns.capacity() * sizeof(Column) + weights.capacity() * (sizeof(double) + sizeof(float));
  }
};

/// The stencil with its centre, −Σ G, so that the program yields Σ G (T_j − T_i).
StencilProgram make_stencil_program(const Stencil& stencil, int dimension);

}  // namespace peritherm
