#pragma once

#include <string>
#include <vector>

#include "peritherm/base/matrix.hpp"
#include "peritherm/base/sparse_matrix.hpp"
#include "peritherm/reduction/load.hpp"
#include "peritherm/reduction/method.hpp"

namespace peritherm {

/// Decoupled equations dy/dt = −rate · y + gains · u, with y(0) = (projected start) − start_gains · u(0).
struct ModalEquations {
  std::vector<double> rates;  ///< r [1/s], ascending
  Matrix gains;               ///< r × m
  Matrix start_gains;         ///< r × m; empty: zeros
  std::size_t size() const { return rates.size(); }
  bool operator==(const ModalEquations&) const = default;
};

/// Equations that hold up to a time, in unknowns z = modes · y of the basis.
struct ModalStage {
  double end = 0.0;  ///< [s]; of the last stage: infinite
  ModalEquations equations;
  Matrix modes;  ///< r × r, orthogonal; empty: z = y
  /// a × (r + m): rates of heat through the accounts from (z, u) in this stage [W]; empty: those of HeatOutputs.
  Matrix heats{};
  bool operator==(const ModalStage&) const = default;
};

/// Columns over all points of the grid, x fastest, orthonormal in Σ C a b: `dense`, or shapes · modes.
struct ModelBasis {
  Matrix dense;         ///< n × r
  SparseMatrix shapes;  ///< n × q
  Matrix modes;         ///< q × r
  bool is_dense() const { return !dense.empty(); }
  std::size_t points() const { return is_dense() ? dense.rows : shapes.rows(); }
  std::size_t size() const { return is_dense() ? dense.columns : modes.columns; }
  bool operator==(const ModelBasis&) const = default;
};

/// A second set of equations for the same loads, coarser or much finer than the model. Its distance from the model is
/// the estimate of the error: with x = (z, u) and the judge's unknowns y', Σ C ΔT² = xᵀ products x + |y'|² − 2 y'ᵀ
/// cross x.
struct ErrorJudge {
  ModalEquations equations;  ///< k of them; none: no estimate at run time
  Matrix cross;              ///< k × (r + m): Σ C (judge's basis) · (basis, direct)
  Matrix products;           ///< (r + m)²: Σ C (basis, direct) · (basis, direct); empty: 1 for z, 0 for u
  Matrix start;              ///< n × k: the judge's basis; empty: it lies within the model's, so y'(0) = cross · z(0)
  bool operator==(const ErrorJudge&) const = default;
};

/// Rates of heat through boundaries and sources [W] and the heat stored [J], from unknowns and inputs.
struct HeatOutputs {
  std::vector<std::string> names;     ///< a accounts
  Matrix modes;                       ///< a × r
  Matrix inputs;                      ///< a × m
  std::vector<double> stored_modes;   ///< r
  std::vector<double> stored_inputs;  ///< m
  double heat_capacity = 0.0;         ///< Σ C of the free points [J/K]
  bool operator==(const HeatOutputs&) const = default;
};

/// What a body answers to its loads, T(x, t) = level + basis · z(t) + direct · u(t). The level is any constant
/// temperature: loads of kind temperature are counted from it, so a uniform start is exact.
struct ReducedModel {
  std::string program;    ///< name and version of what built it
  std::string case_text;  ///< the whole case, resolved
  ReductionMethod method;
  std::vector<Load> loads;  ///< their shapes are the m inputs, behind one another
  std::vector<ModalStage> stages;
  ModelBasis basis;
  Matrix direct;                   ///< n × m: held points, and what follows loads at once
  std::vector<double> capacities;  ///< n [J/K]; 0 where held or cut away
  HeatOutputs heat;
  ErrorJudge judge;
  ModelStart start = ModelStart::projected;
  /// Point numbers, ascending; the first unknowns of basis.shapes are their temperatures. Condensed models only.
  std::vector<std::int64_t> retained;
  std::vector<double> lumped_capacities;  ///< of the unknowns of basis.shapes [J/K]; empty: Σ C of the shapes
  double shortest_time = 0.0;             ///< for which it was built [s]
  double longest_time = 0.0;
  double estimated_error = 0.0;  ///< for its own case, rms over the span of temperatures
  std::size_t inputs() const;
  std::size_t unknowns() const { return basis.size(); }
  bool operator==(const ReducedModel&) const = default;
};

}  // namespace peritherm
