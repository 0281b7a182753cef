#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "peritherm/operators/combination.hpp"
#include "peritherm/operators/stencil_program.hpp"

namespace peritherm {

/// One folded plane: value (row r, column x) of the block's surroundings stands at origin[r · stride + x].
template <class Scalar>
struct SourcePlane {
  const Scalar* origin;
  std::ptrdiff_t stride;
  std::ptrdiff_t ahead = 0;  ///< distance to what will be read soon and should be brought into the nearest cache
};

/// Evaluates a program for `rows` neighbouring rows at once.
template <class Scalar>
struct BlockKernel {
  int rows;     ///< outputs along y
  int columns;  ///< outputs along x are computed in steps of this many
  /// Output (r, x) goes to out[r · out_stride + x]; writes and reads `length` columns, rounded up to whole steps.
  void (*sum)(const StencilProgram& program, const SourcePlane<Scalar>* planes, int length, double* out,
              std::ptrdiff_t out_stride);
};

/// A rectangle of values; `stride` from row to row.
template <class Scalar>
struct Patch {
  Scalar* first;
  std::ptrdiff_t stride;
};

/// The loops over sources, for sums in double or single precision.
template <class Scalar>
struct SourceKernels {
  BlockKernel<Scalar> bar;    ///< one row
  BlockKernel<Scalar> block;  ///< several rows, for plates and solids
  /// out = above + below, row by row; reads and writes `length` values of each row, rounded up to whole vectors of at
  /// most `vector_margin` values.
  void (*fold)(Patch<const Scalar> above, Patch<const Scalar> below, int rows, int length, Patch<Scalar> out);
};
inline constexpr int vector_margin = 16;

/// out[x] = factor · sums[x] + Σ weight · values[x] for a row of outputs; `out` may be one of the terms.
using RowKernel = void (*)(const double* sums, double factor, const Term* terms, std::size_t term_count, int length,
                           double* out);
/// target[x] += a_weight · a[x] + b_weight · b[x].
using AccumulateKernel = void (*)(double a_weight, const double* a, double b_weight, const double* b, int length,
                                  double* target);
/// out = from − reference, rounded, row by row; reads and writes `length` values of each row, rounded up to whole
/// vectors of at most `vector_margin` values. `ahead`: distance to what will be read soon.
using NarrowKernel = void (*)(Patch<const double> from, double reference, int rows, int length, std::ptrdiff_t ahead,
                              Patch<float> out);

/// Entries of a row that many points have in common: column − row, and value.
struct PatternRow {
  const std::int32_t* distances;
  const double* values;
  std::int64_t count;
};
/// target[x] += factor · Σ_n values[n] · field[x + distances[n]] for x in [0, length).
using PatternKernel = void (*)(const PatternRow& row, double factor, const double* field, int length, double* target);

/// The loops that are compiled for several instruction sets.
struct Kernels {
  const char* name;
  SourceKernels<double> full;
  SourceKernels<float> single;
  NarrowKernel narrow;
  RowKernel combine_row;
  AccumulateKernel accumulate_row;
  PatternKernel add_pattern;
};

/// Kernels that this processor can run, best first; the last is the baseline.
const std::vector<Kernels>& available_kernels();

/// The kernels of each instruction set; none if this build or this processor lacks it.
const Kernels* kernels_baseline();
const Kernels* kernels_avx2();
const Kernels* kernels_avx512();

}  // namespace peritherm
