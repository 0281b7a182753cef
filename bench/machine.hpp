#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace peritherm::bench {

/// A sparse matrix row by row, as most codes hold their bonds.
struct SparseRows {
  std::vector<std::int64_t> row_begin;
  std::vector<std::int32_t> columns;
  std::vector<double> values;
};

/// A list of neighbours without weights: those are worked out from the positions at every evaluation.
struct NeighbourList {
  std::vector<std::int64_t> row_begin;
  std::vector<std::int32_t> owners;  ///< of each row
  std::vector<std::int32_t> neighbours;
  std::vector<double> x, y, z;      ///< positions [m]
  std::vector<double> volumes;      ///< [m³]
  double micro_conductivity = 0.0;  ///< times |ξ|²
  double horizon = 0.0;             ///< [m]
  double inverse_capacity = 0.0;    ///< 1/(ρ c)
};

/// Loops that are compiled once per instruction set.
struct MachineLoops {
  const char* name;
  /// Independent chains of multiply-adds in registers; returns how many multiply-adds of single numbers were made.
  double (*multiply_adds)(long iterations);
  double (*multiply_adds_single)(long iterations);
  /// a = b + s c.
  void (*triad)(double* a, const double* b, const double* c, std::size_t count);
  /// y = A x, with four sums per row, or with vectors that gather.
  void (*sparse_scalar)(const SparseRows& matrix, const double* x, double* y);
  void (*sparse_vector)(const SparseRows& matrix, const double* x, double* y);
  /// Rate of every row of the list.
  void (*list_scalar)(const NeighbourList& list, const double* temperature, double* rate);
  void (*list_vector)(const NeighbourList& list, const double* temperature, double* rate);
};

/// Those of each instruction set; none if this build or this processor lacks it.
const MachineLoops* machine_baseline();
const MachineLoops* machine_avx2();
const MachineLoops* machine_avx512();

/// What this processor can run, the widest vectors first.
const std::vector<MachineLoops>& machine_loops();

}  // namespace peritherm::bench
