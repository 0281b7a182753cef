#include "peritherm/output/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "peritherm/output/linear_fit.hpp"

namespace peritherm {
namespace {

/// The cell of points around a place.
struct Cell {
  GridIndex first{};  ///< corner with the lowest indices
  Point fraction{};   ///< place in the cell, 0 to 1 between the points, beyond outside them; 0 along single layers
  GridIndex extent{1, 1, 1};
};

Cell find_cell(const Grid& grid, const Point& place) {
  // Places that stand on points to rounding count as such, so that nearest points are not a matter of luck.
  constexpr double slack = 1e-9;
  Cell cell;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    if (grid.count(axis) < 2) continue;
    double layers = (place[axis] - grid.origin[axis]) / grid.spacing - grid.first_depth();
    if (std::abs(layers - std::round(layers)) < slack) layers = std::round(layers);
    cell.first[axis] = std::clamp(static_cast<int>(std::floor(layers)), 0, grid.count(axis) - 2);
    cell.fraction[axis] = layers - cell.first[axis];
    cell.extent[axis] = 2;
  }
  return cell;
}

/// Linear in the values of all points around a cell, up to one more on each side; nothing if there are none.
template <class Exists>
std::optional<double> fit_around(const Grid& grid, const Cell& cell, const PointValues& field, const Exists& exists) {
  LinearFit fit(static_cast<std::size_t>(grid.dimension));
  GridIndex low{}, high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int last = grid.count(static_cast<int>(axis)) - 1;
    low[axis] = std::clamp(cell.first[axis] - 1, 0, last);
    high[axis] = std::clamp(cell.first[axis] + 2, 0, last);
  }
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const std::size_t number = grid.number({i, j, k});
        if (!exists(number)) continue;
        fit.add({i - cell.first[0] - cell.fraction[0], j - cell.first[1] - cell.fraction[1],
                 k - cell.first[2] - cell.fraction[2]},
                field[number]);
      }
    }
  }
  if (fit.empty()) return std::nullopt;
  return fit.value();
}

double sum_of(const InterpolationWeights& weights, const PointValues& field) {
  if (weights.count == 0) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const WeightedPoint& point : weights) sum += point.weight * field[point.number];
  return sum;
}

}  // namespace

GridIndex nearest_point(const Grid& grid, const Point& place) {
  GridIndex nearest{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double layer = (place[axis] - grid.origin[axis]) / grid.spacing - grid.first_depth();
    nearest[axis] = std::clamp(static_cast<int>(std::lround(layer)), 0, grid.count(axis) - 1);
  }
  return nearest;
}

InterpolationWeights interpolation_weights(const Grid& grid, const Point& place,
                                           const std::function<bool(std::size_t number)>& exists) {
  const Cell cell = find_cell(grid, place);
  InterpolationWeights weights;
  std::optional<std::size_t> nearest;
  double shortest = std::numeric_limits<double>::infinity();
  bool complete = true;
  for (int corner = 0; corner < 8; ++corner) {
    GridIndex p = cell.first;
    double weight = 1.0;
    double distance = 0.0;
    bool in_cell = true;
    for (int axis = 0; axis < 3; ++axis) {
      const int step = corner >> axis & 1;
      in_cell = in_cell && step < cell.extent[axis];
      p[axis] += step;
      if (cell.extent[axis] == 2) weight *= step == 1 ? cell.fraction[axis] : 1.0 - cell.fraction[axis];
      distance += (cell.fraction[axis] - step) * (cell.fraction[axis] - step);
    }
    if (!in_cell) continue;
    const std::size_t number = grid.number(p);
    const bool there = exists(number);
    if (there && distance < shortest) {
      shortest = distance;
      nearest = number;
    }
    if (weight == 0.0) continue;
    if (!there) complete = false;
    weights.points[weights.count++] = {number, weight};
  }
  if (complete) return weights;
  weights.count = nearest ? 1 : 0;
  if (nearest) weights.points[0] = {*nearest, 1.0};
  return weights;
}

double interpolate(const Grid& grid, const PointValues& field, const Point& place) {
  const InterpolationWeights weights =
      interpolation_weights(grid, place, [&field](std::size_t number) { return !std::isnan(field[number]); });
  return sum_of(weights, field);
}

double interpolate(const Grid& grid, const PointValues& field, std::span<const MaterialIndex> materials,
                   const MaterialJumps& jumps, const Point& place) {
  MaterialIndex material = jumps.material_at(place);
  if (material == no_material) material = materials[grid.number(nearest_point(grid, place))];
  bool alone = true;
  const auto on_this_side = [&](std::size_t number) {
    const bool across = jumps.between(material, materials[number], place);
    alone = alone && !across;
    return !across && !std::isnan(field[number]);
  };
  const InterpolationWeights weights = interpolation_weights(grid, place, on_this_side);
  if (alone) return sum_of(weights, field);
  // A shape between the points holds none of them; the body does not know of it.
  const std::optional<double> fitted = fit_around(grid, find_cell(grid, place), field, on_this_side);
  return fitted ? *fitted : interpolate(grid, field, place);
}

}  // namespace peritherm
