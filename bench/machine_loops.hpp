#pragma once

#include <cmath>

#include "machine.hpp"

/// Compiled once per instruction set from the files that include this one; everything stands in an unnamed namespace,
/// so that no two of those files share a compiled function.
namespace peritherm::bench {
namespace {

/// As many chains as registers allow: enough to hide the latency of every multiply-add.
template <class Number, int Bytes>
double multiply_adds(long iterations) {
  typedef Number Vector __attribute__((vector_size(Bytes)));
  constexpr int chains = 12, lanes = Bytes / static_cast<int>(sizeof(Number));
  Vector sums[chains];
  for (int k = 0; k < chains; ++k) sums[k] = Vector{} + static_cast<Number>(k);
  Vector factor = Vector{} + static_cast<Number>(0.999), shift = Vector{} + static_cast<Number>(1e-3);
  for (long n = 0; n < iterations; ++n) {
#pragma GCC unroll 12
    for (int k = 0; k < chains; ++k) sums[k] = sums[k] * factor + shift;
  }
  Vector total{};
  for (int k = 0; k < chains; ++k) total += sums[k];
  volatile Number kept = total[0];
  (void)kept;
  return static_cast<double>(iterations) * chains * lanes;
}

void triad(double* __restrict a, const double* __restrict b, const double* __restrict c, std::size_t count) {
  for (std::size_t n = 0; n < count; ++n) a[n] = b[n] + 3.0 * c[n];
}

void sparse_scalar(const SparseRows& matrix, const double* x, double* y) {
  const std::int32_t* const column = matrix.columns.data();
  const double* const value = matrix.values.data();
  for (std::size_t row = 0; row + 1 < matrix.row_begin.size(); ++row) {
    const std::int64_t end = matrix.row_begin[row + 1];
    std::int64_t k = matrix.row_begin[row];
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    for (; k + 4 <= end; k += 4) {
      sums[0] += value[k] * x[column[k]];
      sums[1] += value[k + 1] * x[column[k + 1]];
      sums[2] += value[k + 2] * x[column[k + 2]];
      sums[3] += value[k + 3] * x[column[k + 3]];
    }
    for (; k < end; ++k) sums[0] += value[k] * x[column[k]];
    y[row] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
}

void sparse_vector(const SparseRows& matrix, const double* x, double* y) {
  const std::int32_t* const column = matrix.columns.data();
  const double* const value = matrix.values.data();
  for (std::size_t row = 0; row + 1 < matrix.row_begin.size(); ++row) {
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::int64_t k = matrix.row_begin[row]; k < matrix.row_begin[row + 1]; ++k) sum += value[k] * x[column[k]];
    y[row] = sum;
  }
}

/// κ(ξ) V_j (T_j − T_i) of one bond, from the positions of its ends.
inline double bond_rate(const NeighbourList& list, const double* temperature, std::int32_t i, std::int32_t j) {
  const double dx = list.x[j] - list.x[i], dy = list.y[j] - list.y[i], dz = list.z[j] - list.z[i];
  const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
  const double weight = length <= list.horizon ? list.micro_conductivity / (length * length) : 0.0;
  return weight * list.volumes[j] * (temperature[j] - temperature[i]);
}

void list_scalar(const NeighbourList& list, const double* temperature, double* rate) {
  for (std::size_t row = 0; row < list.owners.size(); ++row) {
    double sum = 0.0;
    for (std::int64_t k = list.row_begin[row]; k < list.row_begin[row + 1]; ++k) {
      sum += bond_rate(list, temperature, list.owners[row], list.neighbours[k]);
    }
    rate[row] = list.inverse_capacity * sum;
  }
}

void list_vector(const NeighbourList& list, const double* temperature, double* rate) {
  for (std::size_t row = 0; row < list.owners.size(); ++row) {
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::int64_t k = list.row_begin[row]; k < list.row_begin[row + 1]; ++k) {
      sum += bond_rate(list, temperature, list.owners[row], list.neighbours[k]);
    }
    rate[row] = list.inverse_capacity * sum;
  }
}

template <int Bytes>
constexpr MachineLoops loops_of(const char* name) {
  return {name,
          multiply_adds<double, Bytes>,
          multiply_adds<float, Bytes>,
          triad,
          sparse_scalar,
          sparse_vector,
          list_scalar,
          list_vector};
}

}  // namespace
}  // namespace peritherm::bench
