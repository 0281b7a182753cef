#include "peritherm/operators/row_runs.hpp"

#include <algorithm>

namespace peritherm {
namespace {

/// Do all entries of a row look like its first?
template <class Label>
bool alike(const Label* row, int length) {
  return std::equal(row + 1, row + length, row);
}

}  // namespace

RowRuns make_row_runs(const Body& body, const HeldPoints& held_by) {
  std::vector<double> capacities;
  for (const Material& material : body.materials) {
    capacities.push_back(volumetric_heat_capacity(material) * body.grid.cell_volume());
  }
  RowRuns result;
  const int length = body.grid.count(0);
  for (std::size_t n = 0; n < body.grid.size(); n += static_cast<std::size_t>(length)) {
    const std::size_t first = result.runs.size();
    const bool uniform = alike(body.material_of.data() + n, length) &&
                         (held_by.empty() || alike(held_by.boundaries().data() + n, length));
    const int step = uniform ? length : 1;
    for (int x = 0; x < length; x += step) {
      const MaterialIndex material = body.material_of[n + static_cast<std::size_t>(x)];
      const bool free = material != no_material && held_by[n + static_cast<std::size_t>(x)] < 0;
      const double capacity = material != no_material ? capacities[material] : 0.0;
      const double scale = free ? body.materials[material].conductivity / capacity : 0.0;
      result.free_points += free ? static_cast<std::size_t>(step) : 0;
      if (result.runs.size() > first && result.runs.back().rate_scale == scale &&
          result.runs.back().capacity == capacity) {
        result.runs.back().end += step;
      } else {
        result.runs.push_back({x, x + step, scale, capacity});
      }
    }
    result.row_begin.push_back(static_cast<std::int64_t>(result.runs.size()));
  }
  return result;
}

}  // namespace peritherm
