#pragma once

#include "peritherm/operators/stencil_program.hpp"

/// The block kernel, compiled once per instruction set from the files that include this one. Everything stands in an
/// unnamed namespace, so that no two of those files share a compiled function.
namespace peritherm {
namespace {

template <int Lanes>
struct Register {
  typedef double type __attribute__((vector_size(Lanes * sizeof(double)), aligned(sizeof(double)), may_alias));
};
template <int Lanes>
using Lane = typename Register<Lanes>::type;

template <int Lanes, int Vectors, int Rows>
using Sums = Lane<Lanes>[Rows][Vectors];

/// All pairs of one step, for the rows Low to High; the sums stay in registers.
template <int Lanes, int Vectors, int Rows, int Low, int High>
__attribute__((always_inline)) inline void add_pairs(Sums<Lanes, Vectors, Rows>& sums, const double* source,
                                                     const StencilProgram::Pair* pair, int count,
                                                     const double* weights) {
  for (int k = 0; k < count; ++k, ++pair) {
    const double* const left = source - pair->distance;
    const double* const right = source + pair->distance;
    const double* const weight = weights + pair->first_weight;
    Lane<Lanes> values[Vectors];
    for (int v = 0; v < Vectors; ++v) {
      values[v] = *reinterpret_cast<const Lane<Lanes>*>(left + v * Lanes) +
                  *reinterpret_cast<const Lane<Lanes>*>(right + v * Lanes);
    }
    for (int row = Low; row <= High; ++row) {
      for (int v = 0; v < Vectors; ++v) sums[row][v] += weight[row - Low] * values[v];
    }
  }
}

/// Turns the rows of a step into template arguments.
template <int Lanes, int Vectors>
__attribute__((always_inline)) inline void run_step(Sums<Lanes, Vectors, 6>& sums, const StencilProgram::Step& step,
                                                    const double* source, const StencilProgram& program) {
  const StencilProgram::Pair* const pairs = program.pairs.data() + step.first_pair;
  const double* const weights = program.weights.data();
  const int count = step.pair_count;
  switch (step.low * 6 + step.high) {
    case 0:
      return add_pairs<Lanes, Vectors, 6, 0, 0>(sums, source, pairs, count, weights);
    case 1:
      return add_pairs<Lanes, Vectors, 6, 0, 1>(sums, source, pairs, count, weights);
    case 2:
      return add_pairs<Lanes, Vectors, 6, 0, 2>(sums, source, pairs, count, weights);
    case 3:
      return add_pairs<Lanes, Vectors, 6, 0, 3>(sums, source, pairs, count, weights);
    case 4:
      return add_pairs<Lanes, Vectors, 6, 0, 4>(sums, source, pairs, count, weights);
    case 5:
      return add_pairs<Lanes, Vectors, 6, 0, 5>(sums, source, pairs, count, weights);
    case 7:
      return add_pairs<Lanes, Vectors, 6, 1, 1>(sums, source, pairs, count, weights);
    case 8:
      return add_pairs<Lanes, Vectors, 6, 1, 2>(sums, source, pairs, count, weights);
    case 9:
      return add_pairs<Lanes, Vectors, 6, 1, 3>(sums, source, pairs, count, weights);
    case 10:
      return add_pairs<Lanes, Vectors, 6, 1, 4>(sums, source, pairs, count, weights);
    case 11:
      return add_pairs<Lanes, Vectors, 6, 1, 5>(sums, source, pairs, count, weights);
    case 14:
      return add_pairs<Lanes, Vectors, 6, 2, 2>(sums, source, pairs, count, weights);
    case 15:
      return add_pairs<Lanes, Vectors, 6, 2, 3>(sums, source, pairs, count, weights);
    case 16:
      return add_pairs<Lanes, Vectors, 6, 2, 4>(sums, source, pairs, count, weights);
    case 17:
      return add_pairs<Lanes, Vectors, 6, 2, 5>(sums, source, pairs, count, weights);
    case 21:
      return add_pairs<Lanes, Vectors, 6, 3, 3>(sums, source, pairs, count, weights);
    case 22:
      return add_pairs<Lanes, Vectors, 6, 3, 4>(sums, source, pairs, count, weights);
    case 23:
      return add_pairs<Lanes, Vectors, 6, 3, 5>(sums, source, pairs, count, weights);
    case 28:
      return add_pairs<Lanes, Vectors, 6, 4, 4>(sums, source, pairs, count, weights);
    case 29:
      return add_pairs<Lanes, Vectors, 6, 4, 5>(sums, source, pairs, count, weights);
    case 35:
      return add_pairs<Lanes, Vectors, 6, 5, 5>(sums, source, pairs, count, weights);
    default:
      return;
  }
}

template <int Lanes, int Vectors>
__attribute__((always_inline)) inline void run_step(Sums<Lanes, Vectors, 1>& sums, const StencilProgram::Step& step,
                                                    const double* source, const StencilProgram& program) {
  add_pairs<Lanes, Vectors, 1, 0, 0>(sums, source, program.pairs.data() + step.first_pair, step.pair_count,
                                     program.weights.data());
}

template <int Lanes, int Vectors, int Rows>
void run_block(const StencilProgram& program, const FoldedPlane* planes, int columns, double* out,
               std::ptrdiff_t out_stride) {
  for (int x = 0; x < columns; x += Lanes * Vectors) {
    Sums<Lanes, Vectors, Rows> sums{};
    for (const StencilProgram::Step& step : program.steps) {
      const FoldedPlane& plane = planes[step.plane];
      run_step<Lanes, Vectors>(sums, step, plane.origin + step.row * plane.stride + x, program);
    }
    for (int row = 0; row < Rows; ++row) {
      for (int v = 0; v < Vectors; ++v) {
        *reinterpret_cast<Lane<Lanes>*>(out + row * out_stride + x + v * Lanes) = sums[row][v];
      }
    }
  }
}

template <int Lanes>
void sum_block(const StencilProgram& program, const FoldedPlane* planes, int columns, double* out,
               std::ptrdiff_t out_stride) {
  if (program.dimension == 1) {
    run_block<Lanes, lanes_margin / Lanes, 1>(program, planes, columns, out, out_stride);
  } else {
    run_block<Lanes, 2, StencilProgram::block_rows>(program, planes, columns, out, out_stride);
  }
}

template <std::size_t Count>
void combine_terms(const double* sums, double factor, const Term* terms, int length, double* out) {
  double weights[Count + 1];
  const double* values[Count + 1];
  for (std::size_t k = 0; k < Count; ++k) {
    weights[k] = terms[k].weight;
    values[k] = terms[k].values;
  }
  // Each entry depends on the same entry of its terms only, so an output among them is no obstacle.
#pragma GCC ivdep
  for (int x = 0; x < length; ++x) {
    double value = factor * sums[x];
    for (std::size_t k = 0; k < Count; ++k) value += weights[k] * values[k][x];
    out[x] = value;
  }
}

void combine_row(const double* sums, double factor, const Term* terms, std::size_t term_count, int length,
                 double* out) {
  switch (term_count) {
    case 0:
      return combine_terms<0>(sums, factor, terms, length, out);
    case 1:
      return combine_terms<1>(sums, factor, terms, length, out);
    case 2:
      return combine_terms<2>(sums, factor, terms, length, out);
    case 3:
      return combine_terms<3>(sums, factor, terms, length, out);
    case 4:
      return combine_terms<4>(sums, factor, terms, length, out);
    default:
      break;
  }
  for (int x = 0; x < length; ++x) {
    double value = factor * sums[x];
    for (std::size_t k = 0; k < term_count; ++k) value += terms[k].weight * terms[k].values[x];
    out[x] = value;
  }
}

void accumulate_row(double a_weight, const double* __restrict a, double b_weight, const double* __restrict b,
                    int length, double* __restrict target) {
  for (int x = 0; x < length; ++x) target[x] += a_weight * a[x] + b_weight * b[x];
}

void fold_row(const double* above, const double* below, int length, double* out) {
  for (int x = 0; x < length; ++x) out[x] = above[x] + below[x];
}

}  // namespace
}  // namespace peritherm
