#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "peritherm/base/field_storage.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/reduction/reduced_model.hpp"
#include "peritherm/system/heat_system.hpp"

namespace peritherm {

/// A body with its loads, ready to be reduced. Nothing in it may change in time but the loads, unless the method says
/// otherwise.
struct FullSystem {
  HeatSystem& system;
  PaddedGrid layout;
  std::vector<bool> present;  ///< per point of the grid: not cut away
  std::vector<Load> loads;
  FieldStorage start;          ///< state at time 0, held and fictitious entries filled
  double level = 0.0;          ///< temperature that the start is counted from [K]
  double shortest_time = 0.0;  ///< after a jump from which on the model shall be accurate [s]
  double longest_time = 0.0;   ///< end of the run [s]
  std::vector<double> times;   ///< of the case's outputs, ascending, at least one [s]
  std::size_t memory = 0;      ///< that a reduction may use [B]; 0: unknown
  /// The case's own, one per load; only methods that compare with a run need them.
  std::vector<Profile> profiles{};
};

/// Where the time of a reduction went [s], and its size.
struct ReductionCost {
  double solves = 0.0;         ///< linear systems, factorisations included
  double projection = 0.0;     ///< orthonormalisation and reduced matrices
  double modes = 0.0;          ///< eigenvalue problems
  double run = 0.0;            ///< a full run that a method needs
  long evaluations = 0;        ///< of the full rate
  std::size_t peak_bytes = 0;  ///< of what the reduction itself holds
};

struct Reduction {
  ReducedModel model;  ///< all but program and case_text
  ReductionCost cost;
  std::vector<std::string> notes;  ///< for the user: points added to those retained, shifts taken, …
};

/// Told from time to time what is being done, and a share from 0 to 1; false stops the reduction (Error).
using ReductionProgress = std::function<bool(const std::string& stage, double share)>;

/// Throws Error if the method does not apply (naming the reason), or if its options select nothing sensible.
Reduction reduce(const RationalKrylov& method, FullSystem& full, const ReductionProgress& progress = {});
Reduction reduce(const StaticCondensation& method, FullSystem& full, const ReductionProgress& progress = {});
Reduction reduce(const CraigBampton& method, FullSystem& full, const ReductionProgress& progress = {});
/// Cracks may grow: the model then has a stage for each stretch of time, and holds for this growth only.
Reduction reduce(const ProperOrthogonal& method, FullSystem& full, const ReductionProgress& progress = {});
inline Reduction reduce(const ReductionMethod& method, FullSystem& full, const ReductionProgress& progress = {}) {
  return std::visit([&](const auto& chosen) { return reduce(chosen, full, progress); }, method);
}

/// Gives a model that its method does not judge (condensation, Craig-Bampton, proper orthogonal without growth) a much
/// finer companion for the same loads, by rational Krylov subspaces.
void add_judge(ReducedModel& model, FullSystem& full, ReductionCost& cost);

}  // namespace peritherm
