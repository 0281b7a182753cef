#include "peritherm/two_field/families.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "peritherm/discretisation/neighbours.hpp"
#include "peritherm/two_field/place_numbers.hpp"

namespace peritherm {
namespace {

/// Bonds whose ω is as good as nothing, such as the longest of a kernel that falls to zero, only cost time.
constexpr double least_shape = 1e-12;
/// Points at the horizon belong to it, however it was rounded.
constexpr double horizon_slack = 1e-9;

/// ω of a bond; none if it is too weak to count.
std::optional<double> bond_weight(const Kernel& kernel, double distance, double horizon) {
  const double form = shape(kernel, distance / horizon);
  if (form <= least_shape) return std::nullopt;
  return form / std::pow(distance, kernel.exponent);
}

/// Offsets within the horizon in the order of the points' numbers, x fastest.
std::vector<GridIndex> lattice_offsets(int dimension, int reach, double limit) {
  const int y_reach = dimension > 1 ? reach : 0;
  const int z_reach = dimension > 2 ? reach : 0;
  std::vector<GridIndex> offsets;
  for (int z = -z_reach; z <= z_reach; ++z) {
    for (int y = -y_reach; y <= y_reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const int square = x * x + y * y + z * z;
        if (square > 0 && static_cast<double>(square) <= limit * limit) offsets.push_back({x, y, z});
      }
    }
  }
  return offsets;
}

}  // namespace

Families::Families(int dimension, const SubDomain& part, const Kernel& kernel) {
  begin_.reserve(part.size() + 1);
  if (part.places.empty()) {
    find_anywhere(dimension, part, kernel);
  } else {
    find_on_lattice(dimension, part, kernel);
  }
}

Families::Bond Families::bond(std::size_t i, std::size_t k) const {
  const std::size_t place = static_cast<std::size_t>(begin_[i]) + k;
  return on_lattice() ? offsets_[offset_of_[place]] : bonds_[place];
}

void Families::find_on_lattice(int dimension, const SubDomain& part, const Kernel& kernel) {
  const double limit = part.horizon / part.spacing + horizon_slack;
  const int reach = static_cast<int>(limit);
  std::vector<GridIndex> offsets;
  for (const GridIndex& offset : lattice_offsets(dimension, reach, limit)) {
    Bond bond{};
    for (int axis = 0; axis < 3; ++axis) bond.vector[axis] = offset[axis] * part.spacing;
    const double distance = std::hypot(bond.vector[0], bond.vector[1], bond.vector[2]);
    const std::optional<double> weight = bond_weight(kernel, distance, part.horizon);
    if (!weight) continue;
    bond.weight = *weight;
    offsets.push_back(offset);
    offsets_.push_back(bond);
  }
  const PlaceNumbers numbers(part.places, reach);
  std::vector<std::pair<PointIndex, std::uint16_t>> family;
  points_.reserve(part.size() * offsets.size());
  offset_of_.reserve(part.size() * offsets.size());
  for (const GridIndex& place : part.places) {
    family.clear();
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      const PointIndex neighbour = numbers.at(place, offsets[k]);
      if (neighbour >= 0) family.emplace_back(neighbour, static_cast<std::uint16_t>(k));
    }
    // Nothing to do where points are numbered with x fastest.
    std::sort(family.begin(), family.end());
    for (const auto& [neighbour, offset] : family) {
      points_.push_back(neighbour);
      offset_of_.push_back(offset);
    }
    begin_.push_back(static_cast<BondIndex>(points_.size()));
  }
}

void Families::find_anywhere(int dimension, const SubDomain& part, const Kernel& kernel) {
  Points points;
  points.dimension = dimension;
  points.spacing = part.spacing;
  points.owned = part.size();
  points.positions = part.positions;
  const Neighbours near = find_neighbours(points, part.horizon);
  for (std::size_t i = 0; i < part.size(); ++i) {
    for (BondIndex n = near.row_begin[i]; n < near.row_begin[i + 1]; ++n) {
      const PointIndex j = near.points[static_cast<std::size_t>(n)];
      Bond bond{};
      for (int axis = 0; axis < 3; ++axis) bond.vector[axis] = part.positions[j][axis] - part.positions[i][axis];
      const double distance = std::hypot(bond.vector[0], bond.vector[1], bond.vector[2]);
      const std::optional<double> weight = bond_weight(kernel, distance, part.horizon);
      if (!weight) continue;
      bond.weight = *weight;
      points_.push_back(j);
      bonds_.push_back(bond);
    }
    begin_.push_back(static_cast<BondIndex>(points_.size()));
  }
}

}  // namespace peritherm
