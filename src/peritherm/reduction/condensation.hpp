#pragma once

#include <string>
#include <vector>

#include "peritherm/reduction/reduce.hpp"
#include "peritherm/reduction/retained_points.hpp"
#include "peritherm/reduction/sparse_factor.hpp"
#include "peritherm/reduction/sparse_heat.hpp"

namespace peritherm {

/// What each of the m inputs of a system does alone, at temperature 0.
struct UnitLoads {
  Matrix heat;                  ///< n free points × m, heat rate at input 1 [W]
  Matrix held;                  ///< points of the grid × m: temperatures of held points
  Matrix accounts;              ///< a × m: heat rate through boundaries and from sources [W]
  std::vector<LoadKind> kinds;  ///< m
};
UnitLoads find_unit_loads(FullSystem& full, const SparseHeat& heat);

/// The free points of a system, split into r retained and t truncated ones; K_tt factored.
struct SplitHeat {
  SparseHeat heat;
  std::vector<std::int32_t> retained, truncated;  ///< as `heat` numbers the free points, ascending
  SparseFactor factor;                            ///< of K_tt
};

/// Throws Error if the system changes in time, is not symmetric, if too many points are chosen, or if they do not
/// decide the temperatures of all others.
SplitHeat split_heat(FullSystem& full, const RetainedPoints& choice, std::vector<std::string>& notes);

/// Shapes of a condensed model over the n free points: a column for each retained point, its temperature 1 and those of
/// the truncated ones R = −K_tt⁻¹ K_tr [galadima2022, eqs. 60 to 62], and behind them modes of the truncated points.
/// Shares |R_ij| below `drop` are left out, the others of the row scaled so that constants stay what they are.
SparseMatrix condensed_shapes(const SplitHeat& split, double drop, const Matrix& modes, std::size_t most_bytes);

/// shapesᵀ K shapes, the lower half of it [galadima2022, eq. 65].
Matrix condensed_conductances(const SplitHeat& split, const SparseMatrix& shapes);

/// K_tt⁻¹ h_t of loads of some kinds, n × m: what truncated points take on at once. 0 for the others.
Matrix static_responses(const SplitHeat& split, const UnitLoads& loads, bool of_heat_too);

/// A model of T = shapes · z + statics · u that is exact in the sense of Galerkin; derivatives of inputs, Σ C shapes ·
/// statics du/dt, are taken into the unknowns.
struct CondensedParts {
  SparseMatrix shapes;  ///< n × q
  Matrix statics;       ///< n × m
  CondensedCapacity capacity = CondensedCapacity::consistent;
  ModelStart start = ModelStart::projected;
};
ReducedModel make_condensed_model(FullSystem& full, const SplitHeat& split, const UnitLoads& loads,
                                  CondensedParts parts, ReductionCost& cost);

/// Tells of progress; throws Error if it was answered with false.
void tell(const ReductionProgress& progress, const std::string& stage, double share);

/// Seconds since the last call.
class Lap {
 public:
  Lap();
  double operator()();

 private:
  double last_;
};

/// Throws Error if a model of that many unknowns would need too much time and memory to be diagonalised.
void require_few_unknowns(std::size_t unknowns);

}  // namespace peritherm
