#pragma once

#include <vector>

#include "peritherm/base/sparse_matrix.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// Conduction between the free points of a grid, and losses to their surroundings, as a sparse matrix:
/// C dθ/dt = −K θ + loads.
struct SparseHeat {
  std::vector<std::int64_t> points;  ///< number in the grid of each of the n free points, ascending
  std::vector<double> capacities;    ///< n, C [J/K]
  std::vector<double> losses;        ///< n, Σ_j K_ij: to what is held, and by convection [W/K]; 0 but for real ones
  SparseMatrix conductances;         ///< n × n, K [W/K]: symmetric, the diagonal always there
  std::size_t size() const { return points.size(); }
};

/// Asks the system for its rate once per colour of a pattern in which points of one colour share no neighbour,
/// (2 padding + 1)^dimension evaluations, so that every backend, mirrored face and crack is seen as it is.
/// `point_capacities`: per point of the grid, 0 where held or cut away [J/K]. Throws Error if the system is not
/// symmetric.
SparseHeat make_sparse_heat(ThermalSystem& system, const PaddedGrid& layout, ConstField point_capacities);

/// result += matrix · vector.
void add_product(const SparseMatrix& matrix, ConstField vector, Field result);
/// result += matrixᵀ · vector.
void add_transposed_product(const SparseMatrix& matrix, ConstField vector, Field result);

/// The rows `rows` and the columns `columns` of a square matrix, both ascending.
SparseMatrix part_of(const SparseMatrix& matrix, const std::vector<std::int32_t>& rows,
                     const std::vector<std::int32_t>& columns);

}  // namespace peritherm
