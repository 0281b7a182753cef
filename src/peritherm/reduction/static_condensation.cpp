#include "peritherm/reduction/condensation.hpp"

namespace peritherm {

Reduction reduce(const StaticCondensation& method, FullSystem& full, const ReductionProgress& progress) {
  Reduction result;
  Lap lap;
  tell(progress, "factoring", 0.0);
  const SplitHeat split = split_heat(full, method.retained, result.notes);
  const UnitLoads loads = find_unit_loads(full, split.heat);
  tell(progress, "condensing", 0.1);
  CondensedParts parts;
  parts.shapes = condensed_shapes(split, method.drop, {}, full.memory);
  parts.statics = static_responses(split, loads, false);
  parts.capacity = method.capacity;
  parts.start = method.start;
  result.cost.solves = lap();
  tell(progress, "decoupling", 0.3);
  result.model = make_condensed_model(full, split, loads, std::move(parts), result.cost);
  result.model.method = method;
  tell(progress, "done", 1.0);
  return result;
}

}  // namespace peritherm
