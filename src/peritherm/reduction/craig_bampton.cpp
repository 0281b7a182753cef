#include <algorithm>
#include <string>

#include "peritherm/reduction/condensation.hpp"
#include "peritherm/reduction/symmetric_modes.hpp"

namespace peritherm {
namespace {

std::vector<double> capacities_of(const SparseHeat& heat, const std::vector<std::int32_t>& points) {
  std::vector<double> capacities;
  for (const std::int32_t point : points) capacities.push_back(heat.capacities[static_cast<std::size_t>(point)]);
  return capacities;
}

}  // namespace

Reduction reduce(const CraigBampton& method, FullSystem& full, const ReductionProgress& progress) {
  Reduction result;
  Lap lap;
  tell(progress, "factoring", 0.0);
  const SplitHeat split = split_heat(full, method.retained, result.notes);
  const std::size_t asked = static_cast<std::size_t>(std::max(0, method.modes));
  const std::size_t count = std::min(asked, split.truncated.size());
  require_few_unknowns(split.retained.size() + count);
  if (count < asked) {
    result.notes.push_back("only " + std::to_string(count) + " points are not retained, so there are no more than " +
                           std::to_string(count) + " modes between them");
  }
  const UnitLoads loads = find_unit_loads(full, split.heat);
  result.cost.solves = lap();
  const SymmetricModes modes = slowest_modes(split.factor, capacities_of(split.heat, split.truncated), count,
                                             [&] { tell(progress, "modes with the retained points held", 0.1); });
  result.cost.modes = lap();
  tell(progress, "condensing", 0.3);
  CondensedParts parts;
  parts.shapes = condensed_shapes(split, method.drop, modes.shapes, full.memory);
  parts.statics = static_responses(split, loads, true);
  parts.start = method.start;
  result.cost.solves += lap();
  tell(progress, "decoupling", 0.5);
  result.model = make_condensed_model(full, split, loads, std::move(parts), result.cost);
  result.model.method = method;
  tell(progress, "done", 1.0);
  return result;
}

}  // namespace peritherm
