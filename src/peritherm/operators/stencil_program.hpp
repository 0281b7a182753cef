#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/operators/combination.hpp"

namespace peritherm {

/// The sum over a stencil for a block of `block_rows` neighbouring rows, arranged so that mirror images along x are
/// added before they are multiplied and each loaded value serves every row of the block that needs it. In 3-D the
/// planes above and below are added first ("folded"), so plane d stands for the offsets −d and +d along z.
struct StencilProgram {
  static constexpr int block_rows = 6;

  /// A pair of values `distance` to the left and right of the output.
  struct Pair {
    std::int32_t distance;
    std::int32_t first_weight;  ///< one weight for each of the rows low … high
  };
  /// All pairs of one source row that serve the same rows of the block.
  struct Step {
    std::int32_t plane;  ///< folded plane, 0 … radius
    std::int32_t row;    ///< source row relative to the first row of the block
    std::int32_t low, high;
    std::int32_t first_pair, pair_count;
  };

  int dimension = 1;
  int radius = 0;                 ///< largest offset along x and y
  int planes = 1;                 ///< folded planes: 1, in 3-D radius + 1
  std::vector<int> plane_radius;  ///< largest offset along y in each plane
  std::vector<Step> steps;
  std::vector<Pair> pairs;
  std::vector<double> weights;
};

/// The stencil with its centre, −Σ G, so that the program yields Σ G (T_j − T_i).
StencilProgram make_stencil_program(const Stencil& stencil, int dimension);

/// One folded plane: value (row r, column x) of the block's surroundings stands at origin[r · stride + x].
struct FoldedPlane {
  const double* origin;
  std::ptrdiff_t stride;
};

/// Evaluates the program for block_rows × columns outputs; output (r, x) goes to out[r · out_stride + x]. Writes and
/// reads up to `lanes_margin` columns more.
using BlockKernel = void (*)(const StencilProgram& program, const FoldedPlane* planes, int columns, double* out,
                             std::ptrdiff_t out_stride);
inline constexpr int lanes_margin = 32;

/// out[x] = factor · sums[x] + Σ weight · values[x] for a row of outputs; `out` may be one of the terms.
using RowKernel = void (*)(const double* sums, double factor, const Term* terms, std::size_t term_count, int length,
                           double* out);
/// target[x] += a_weight · a[x] + b_weight · b[x].
using AccumulateKernel = void (*)(double a_weight, const double* a, double b_weight, const double* b, int length,
                                  double* target);
/// out[x] = above[x] + below[x].
using FoldKernel = void (*)(const double* above, const double* below, int length, double* out);

/// The loops that are compiled for several instruction sets.
struct Kernels {
  const char* name;
  BlockKernel sum_block;
  RowKernel combine_row;
  FoldKernel fold_row;
  AccumulateKernel accumulate_row;
};
/// Kernels that this processor can run, best first; the last is the baseline.
const std::vector<Kernels>& available_kernels();

}  // namespace peritherm
