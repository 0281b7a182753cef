#include "peritherm/two_field/face_traces.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

/// How exactly places must stand on faces, in spacings.
constexpr double place_slack = 1e-7;
/// A surface point stands for so many faces of cells along an axis at most.
constexpr int most_faces = 64;

/// −Gᵀ V 1 below an endless face. Parallel to it everything is alike, so that bonds count by their distance in layers.
std::vector<double> layer_weights(const Families& families, double spacing) {
  int reach = 0;
  for (const Families::Bond& bond : families.lattice_bonds()) {
    reach = std::max(reach, static_cast<int>(std::lround(bond.vector[0] / spacing)));
  }
  std::vector<double> by_layers(static_cast<std::size_t>(2 * reach + 1), 0.0);
  for (const Families::Bond& bond : families.lattice_bonds()) {
    by_layers[static_cast<std::size_t>(reach + std::lround(bond.vector[0] / spacing))] += bond.weight;
  }
  std::vector<double> sums(static_cast<std::size_t>(4 * reach), 0.0);
  for (int layer = 0; layer < 3 * reach; ++layer) {
    double shape_tensor = 0.0;
    for (int n = std::max(-layer, -reach); n <= reach; ++n) shape_tensor += by_layers[reach + n] * n * n;
    for (int n = std::max(-layer, -reach); n <= reach; ++n) {
      const double gradient = by_layers[reach + n] * n / shape_tensor;
      sums[layer + n] -= gradient;
      sums[layer] += gradient;
    }
  }
  // What deeper layers give and take cancels.
  sums.resize(static_cast<std::size_t>(2 * reach));
  return sums;
}

int direction_of(int axis, int step) { return 2 * axis + (step > 0 ? 1 : 0); }

}  // namespace

FaceTraces::FaceTraces(int dimension, const SubDomain& part, std::span<const SurfacePoint> surface,
                       const Families& families)
    : dimension_(dimension), part_(part), numbers_(part.places, 0), weights_(layer_weights(families, part.spacing)) {
  for (const SurfacePoint& place : surface) {
    if (place.second < 0) continue;
    const GridIndex cell = cell_below(place);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(place.normal[axis]) < 0.5) continue;
      touched_.insert({cell[0], cell[1], cell[2], direction_of(axis, place.normal[axis] > 0.0 ? 1 : -1)});
    }
  }
}

GridIndex FaceTraces::cell_below(const SurfacePoint& place) const {
  GridIndex cell{};
  for (int a = 0; a < dimension_; ++a) {
    const double middle = place.position[a] - 0.5 * part_.spacing * place.normal[a];
    const double from_first = (middle - part_.positions.front()[a]) / part_.spacing;
    cell[a] = part_.places.front()[a] + static_cast<int>(std::lround(from_first));
  }
  return cell;
}

std::optional<Trace> FaceTraces::at(const SurfacePoint& place) const {
  int axis = 0;
  while (axis < dimension_ && std::abs(place.normal[axis]) < 1.0 - place_slack) ++axis;
  if (axis == dimension_) return std::nullopt;
  const int side = place.normal[axis] > 0.0 ? 1 : -1;
  const double cell_face = std::pow(part_.spacing, dimension_ - 1);
  const double faces = std::pow(place.area / cell_face, 1.0 / (dimension_ - 1));
  const int count = static_cast<int>(std::lround(faces));
  if (count < 1 || count > most_faces || std::abs(faces - count) > place_slack) return std::nullopt;
  const int z_count = dimension_ == 3 ? count : 1;
  const int first_axis = axis == 0 ? 1 : 0;
  const int second_axis = 3 - axis - first_axis;
  Trace result;
  for (int z = 0; z < z_count; ++z) {
    for (int y = 0; y < count; ++y) {
      Point face = place.position;
      face[first_axis] += (y - 0.5 * (count - 1)) * part_.spacing;
      if (dimension_ == 3) face[second_axis] += (z - 0.5 * (count - 1)) * part_.spacing;
      const std::optional<Trace> row = row_below(face, axis, side);
      const bool outside = place.second < 0;
      if (!row || (outside && ends_beside(row->points.front(), axis))) return std::nullopt;
      result.points.insert(result.points.end(), row->points.begin(), row->points.end());
      for (const double weight : row->weights) result.weights.push_back(weight / (count * z_count));
    }
  }
  return result;
}

/// There both surfaces' rows would carry on to one and the same temperature, and hold it twice. Rows of faces of the
/// outside that belong to one cell are one (see the assembly of a case), so that only other parts matter.
bool FaceTraces::ends_beside(PointIndex first, int axis) const {
  const GridIndex cell = part_.places[static_cast<std::size_t>(first)];
  for (int along = 0; along < dimension_; ++along) {
    for (const int step : {-1, 1}) {
      GridIndex beside = cell;
      beside[along] += step;
      if (along == axis || numbers_.at(beside) >= 0) continue;
      if (touched_.count({cell[0], cell[1], cell[2], direction_of(along, step)}) > 0) return true;
    }
  }
  return false;
}

std::optional<Trace> FaceTraces::row_below(const Point& face, int axis, int side) const {
  const double cell = std::pow(part_.spacing, dimension_);
  GridIndex place{};
  Trace result;
  for (std::size_t layer = 0; layer < weights_.size(); ++layer) {
    Point wanted = face;
    wanted[axis] -= side * (static_cast<double>(layer) + 0.5) * part_.spacing;
    for (int a = 0; a < dimension_; ++a) {
      const double from_first = (wanted[a] - part_.positions.front()[a]) / part_.spacing;
      place[a] = part_.places.front()[a] + static_cast<int>(std::lround(from_first));
      if (std::abs(from_first - std::round(from_first)) > place_slack) return std::nullopt;
    }
    const PointIndex point = numbers_.at(place);
    if (point < 0 || std::abs(part_.volumes[point] - cell) > place_slack * cell) return std::nullopt;
    result.points.push_back(point);
    result.weights.push_back(weights_[layer]);
  }
  return result;
}

}  // namespace peritherm
