#include "peritherm/simulation/two_field_display.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peritherm {
namespace {

constexpr double most_cells_shown = 4e6;
/// As far as volumes are shared out to points.
constexpr double cells_to_points_of_tips = 4.0;

/// Half the edge of a cell, or its reach where points stand on no lattice [spacings].
double reach_of(const SubDomain& part) { return part.places.empty() ? 0.75 : 0.5 + 1e-6; }

/// Distance in spacings, as cells are shaped.
double distance_in(const SubDomain& part, const Point& a, const Point& b) {
  Point d{};
  for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = std::abs(a[axis] - b[axis]) / part.spacing;
  return part.places.empty() ? std::hypot(d[0], d[1], d[2]) : std::max({d[0], d[1], d[2]});
}

/// How many times finer than the grid of the case the finest points are, as far as the raster may grow.
int refinement(const Grid& grid, const DividedBody& body) {
  double finest = grid.spacing;
  for (const SubDomain& part : body.parts) finest = std::min(finest, part.spacing);
  const double most = std::pow(most_cells_shown / static_cast<double>(grid.size()), 1.0 / grid.dimension);
  return std::max(1, std::min(static_cast<int>(std::ceil(grid.spacing / finest - 1e-6)), static_cast<int>(most)));
}

}  // namespace

TwoFieldDisplay::TwoFieldDisplay(const Grid& grid, const DividedBody& body, MaterialAt material_at)
    : body_(body), material_at_(std::move(material_at)), raster_(grid) {
  const int times = refinement(grid, body);
  for (int axis = 0; axis < grid.dimension; ++axis) raster_.cells[static_cast<std::size_t>(axis)] *= times;
  raster_.spacing /= times;
  first_.push_back(0);
  for (const SubDomain& part : body.parts) {
    lattices_.push_back(make_lattice(part, first_.back()));
    first_.push_back(first_.back() + part.size());
    positions_.insert(positions_.end(), part.positions.begin(), part.positions.end());
  }
  paint();
}

TwoFieldDisplay::Lattice TwoFieldDisplay::make_lattice(const SubDomain& part, std::size_t first) const {
  Lattice lattice;
  if (part.places.empty()) return lattice;
  lattice.low = part.places.front();
  GridIndex high = lattice.low;
  for (const GridIndex& p : part.places) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lattice.low[axis] = std::min(lattice.low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  std::size_t size = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lattice.count[axis] = high[axis] - lattice.low[axis] + 1;
    size *= static_cast<std::size_t>(lattice.count[axis]);
    lattice.origin[axis] = part.positions[0][axis] - part.spacing * (part.places[0][axis] - lattice.low[axis]);
  }
  lattice.point.assign(size, -1);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const auto at = [&](std::size_t axis) {
      return static_cast<std::size_t>(part.places[i][axis] - lattice.low[axis]);
    };
    const auto nx = static_cast<std::size_t>(lattice.count[0]), ny = static_cast<std::size_t>(lattice.count[1]);
    lattice.point[at(0) + nx * (at(1) + ny * at(2))] = static_cast<std::int64_t>(first + i);
  }
  return lattice;
}

void TwoFieldDisplay::paint() {
  materials_.assign(raster_.size(), no_material);
  point_of_.assign(raster_.size(), -1);
  std::vector<float> distances(raster_.size(), std::numeric_limits<float>::infinity());
  for (std::size_t p = 0; p < body_.parts.size(); ++p) {
    const SubDomain& part = body_.parts[p];
    for (std::size_t i = 0; i < part.size(); ++i) paint_point(part, first_[p] + i, part.positions[i], distances);
  }
}

void TwoFieldDisplay::paint_point(const SubDomain& part, std::size_t number, const Point& position,
                                  std::vector<float>& distances) {
  GridIndex low{}, high{};
  for (int axis = 0; axis < raster_.dimension; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double place = (position[a] - raster_.origin[a]) / raster_.spacing - 0.5;
    const double reach = reach_of(part) * part.spacing / raster_.spacing;
    low[a] = std::max(0, static_cast<int>(std::ceil(place - reach)));
    high[a] = std::min(raster_.count(axis) - 1, static_cast<int>(std::floor(place + reach)));
  }
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const double distance = distance_in(part, position, raster_.position({i, j, k}));
        const std::size_t cell = raster_.number({i, j, k});
        if (distance > reach_of(part) || distance >= static_cast<double>(distances[cell])) continue;
        if (part.places.empty() && material_at_(raster_.position({i, j, k})) != part.material) continue;
        distances[cell] = static_cast<float>(distance);
        materials_[cell] = part.material;
        point_of_[cell] = static_cast<std::int64_t>(number);
      }
    }
  }
}

Point TwoFieldDisplay::offset(std::size_t cell) const {
  Point offset = raster_.position(raster_.index(cell));
  const Point& from = positions_[static_cast<std::size_t>(point_of_[cell])];
  for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] -= from[axis];
  return offset;
}

bool TwoFieldDisplay::interpolate(std::size_t part, const Point& place, PlaceValue& value) const {
  const Lattice& lattice = lattices_[part];
  if (lattice.point.empty()) return false;
  GridIndex corner{};
  Point share{};
  for (int axis = 0; axis < body_.dimension; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    double layers = (place[a] - lattice.origin[a]) / body_.parts[part].spacing;
    if (std::abs(layers - std::round(layers)) < 1e-9) layers = std::round(layers);
    corner[a] = static_cast<int>(std::floor(layers));
    share[a] = layers - corner[a];
  }
  value.points.clear();
  for (int c = 0; c < 8; ++c) {
    GridIndex p = corner;
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int step = c >> axis & 1;
      p[axis] += step;
      weight *= step == 1 ? share[axis] : 1.0 - share[axis];
    }
    if (weight == 0.0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (p[axis] < 0 || p[axis] >= lattice.count[axis]) return false;
    }
    const auto nx = static_cast<std::size_t>(lattice.count[0]), ny = static_cast<std::size_t>(lattice.count[1]);
    const std::int64_t point =
        lattice.point[static_cast<std::size_t>(p[0]) +
                      nx * (static_cast<std::size_t>(p[1]) + ny * static_cast<std::size_t>(p[2]))];
    if (point < 0) return false;
    value.points.emplace_back(static_cast<std::size_t>(point), weight);
  }
  return true;
}

std::optional<TwoFieldDisplay::NearestPoint> TwoFieldDisplay::nearest_point(const Point& place, double beyond,
                                                                            MaterialIndex material) const {
  std::optional<NearestPoint> found;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < body_.parts.size(); ++p) {
    const SubDomain& part = body_.parts[p];
    if (material != no_material && part.material != material) continue;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const double distance = distance_in(part, part.positions[i], place);
      if (distance >= nearest || distance > reach_of(part) + beyond) continue;
      nearest = distance;
      found = {p, first_[p] + i};
    }
  }
  return found;
}

PlaceValue TwoFieldDisplay::find(const Point& place) const {
  const MaterialIndex material = material_at_(place);
  std::optional<NearestPoint> nearest;
  // Shapes say which side of a surface a place is on; the point of a tip or sliver may stand some cells away.
  if (material != no_material) nearest = nearest_point(place, cells_to_points_of_tips, material);
  if (!nearest) nearest = nearest_point(place, 0.25, no_material);
  PlaceValue value;
  if (!nearest) return value;
  value.part = static_cast<int>(nearest->part);
  if (interpolate(nearest->part, place, value)) return value;
  value.points = {{nearest->number, 1.0}};
  for (std::size_t axis = 0; axis < 3; ++axis) value.offset[axis] = place[axis] - positions_[nearest->number][axis];
  return value;
}

const PlaceValue& TwoFieldDisplay::value_at(const Point& place) const {
  const auto known = known_.find(place);
  return known != known_.end() ? known->second : known_.emplace(place, find(place)).first->second;
}

}  // namespace peritherm
