#include "peritherm/discretisation/displacements.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

using GridPlace = std::array<double, 3>;  ///< in spacings; points stand at whole numbers

/// Where a bond passes a face of the box.
struct WallPassage {
  double share = 0.0;  ///< of the bond's length
  int axis = 0;
  bool upper = false;
};

double wall_coordinate(const Grid& grid, int axis, bool upper) {
  return upper ? grid.cells[axis] - grid.first_depth() : -grid.first_depth();
}

Point vector_at(const std::vector<double>& values, int dimension, std::size_t place) {
  Point vector{};
  const auto width = static_cast<std::size_t>(dimension);
  for (std::size_t c = 0; c < width; ++c) vector[c] = values[place * width + c];
  return vector;
}

Point point_displacement(const Body& body, const Displacements& displacements, const GridIndex& p) {
  return vector_at(displacements.points, body.grid.dimension, body.grid.number(p));
}

/// The point below a place of a face whose coordinates along the face are whole numbers.
GridIndex outermost_point(const Grid& grid, Face face, GridIndex along) {
  const int axis = axis_of(face);
  along[axis] = is_upper(face) ? grid.count(axis) - 1 : 0;
  return along;
}

/// Linear between the places above the outermost points. Where one of them is cut away the nearest one stands in;
/// `otherwise` where all are.
Point wall_displacement(const Body& body, const Displacements& displacements, const WallPassage& passage,
                        const GridPlace& place, const Point& otherwise) {
  const Grid& grid = body.grid;
  const Face face = make_face(passage.axis, passage.upper);
  Point sum{}, nearest = otherwise;
  double largest = 0.0;
  bool complete = true;
  for (int corner = 0; corner < 1 << grid.dimension; ++corner) {
    if ((corner >> passage.axis & 1) != 0) continue;
    double weight = 1.0;
    GridIndex along{};
    for (int axis = 0; axis < grid.dimension; ++axis) {
      if (axis == passage.axis) continue;
      const int low = std::clamp(static_cast<int>(std::floor(place[axis])), 0, std::max(0, grid.count(axis) - 2));
      const bool far = (corner >> axis & 1) != 0;
      const double share = grid.count(axis) > 1 ? place[axis] - low : 0.0;
      along[axis] = std::min(low + (far ? 1 : 0), grid.count(axis) - 1);
      weight *= far ? share : 1.0 - share;
    }
    if (weight == 0.0) continue;
    const GridIndex below = outermost_point(grid, face, along);
    if (body.material_of[grid.number(below)] == no_material) {
      complete = false;
      continue;
    }
    const Point u =
        vector_at(displacements.walls[static_cast<int>(face)], grid.dimension, body.wall_place(face, below));
    for (int c = 0; c < 3; ++c) sum[c] += weight * u[c];
    if (weight > largest) nearest = u;
    largest = std::max(largest, weight);
  }
  return complete ? sum : nearest;
}

/// Ordered along the bond.
int find_passages(const Grid& grid, const DirectedBond& bond, std::array<WallPassage, 3>& passages) {
  int count = 0;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const bool upper = bond.to[axis] >= grid.count(axis);
    if (!upper && bond.to[axis] >= 0) continue;
    const double run = bond.to[axis] - bond.from[axis];
    passages[static_cast<std::size_t>(count++)] = {(wall_coordinate(grid, axis, upper) - bond.from[axis]) / run, axis,
                                                   upper};
  }
  std::stable_sort(passages.begin(), passages.begin() + count,
                   [](const WallPassage& a, const WallPassage& b) { return a.share < b.share; });
  return count;
}

void carry_to_place(const Body& body, Face face, const GridIndex& outer, Displacements& displacements) {
  const Grid& grid = body.grid;
  const auto width = static_cast<std::size_t>(grid.dimension);
  const int axis = axis_of(face);
  GridIndex inner = outer;
  inner[axis] += is_upper(face) ? -1 : 1;
  if (!grid.contains(inner) || body.material_of[grid.number(inner)] == no_material) inner = outer;
  for (std::size_t c = 0; c < width; ++c) {
    const double first = displacements.points[grid.number(outer) * width + c];
    const double second = displacements.points[grid.number(inner) * width + c];
    displacements.walls[static_cast<int>(face)][body.wall_place(face, outer) * width + c] =
        first + grid.first_depth() * (first - second);
  }
}

}  // namespace

Displacements Displacements::of(const Body& body) {
  const auto width = static_cast<std::size_t>(body.grid.dimension);
  Displacements displacements;
  displacements.points.resize(body.grid.size() * width);
  for (int face = 0; face < 2 * body.grid.dimension; ++face) {
    displacements.walls[face].resize(body.wall_places(static_cast<Face>(face)) * width);
  }
  return displacements;
}

void carry_to_walls(const Body& body, Displacements& displacements) {
  const Grid& grid = body.grid;
  for (int f = 0; f < 2 * grid.dimension; ++f) {
    const Face face = static_cast<Face>(f);
    GridIndex end{grid.count(0), grid.count(1), grid.count(2)};
    end[axis_of(face)] = 1;
    for (int z = 0; z < end[2]; ++z) {
      for (int y = 0; y < end[1]; ++y) {
        for (int x = 0; x < end[0]; ++x) {
          carry_to_place(body, face, outermost_point(grid, face, {x, y, z}), displacements);
        }
      }
    }
  }
}

DirectedBond representative(const Body& body, const GridIndex& p, const GridIndex& q) {
  const Grid& grid = body.grid;
  const GridIndex folded = body.fold(q);
  if (grid.number(p) <= grid.number(folded)) return {p, q};
  const int shift = grid.placement == PointPlacement::boundary ? 0 : 1;
  GridIndex image = p;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    if (q[axis] < 0) image[axis] = -p[axis] - shift;
    if (q[axis] >= grid.count(axis)) image[axis] = 2 * (grid.count(axis) - 1) - p[axis] + shift;
  }
  return {folded, image};
}

Point relative_displacement(const Body& body, const Displacements& displacements, const DirectedBond& bond) {
  const Grid& grid = body.grid;
  const Point start = point_displacement(body, displacements, bond.from);
  const Point target = point_displacement(body, displacements, body.fold(bond.to));
  std::array<WallPassage, 3> passages;
  const int count = find_passages(grid, bond, passages);
  Point relative{}, last = start;
  std::array<bool, 3> mirrored{};
  const auto go_to = [&](const Point& next) {
    for (std::size_t c = 0; c < 3; ++c) relative[c] += mirrored[c] ? last[c] - next[c] : next[c] - last[c];
    last = next;
  };
  for (int k = 0; k < count; ++k) {
    const WallPassage& passage = passages[static_cast<std::size_t>(k)];
    GridPlace place{};
    Point otherwise{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = bond.from[axis] + passage.share * (bond.to[axis] - bond.from[axis]);
      if (mirrored[axis]) {
        place[axis] = 2.0 * wall_coordinate(grid, static_cast<int>(axis), bond.to[axis] > 0) - place[axis];
      }
      otherwise[axis] = start[axis] + passage.share * (target[axis] - start[axis]);
    }
    go_to(wall_displacement(body, displacements, passage, place, otherwise));
    mirrored[static_cast<std::size_t>(passage.axis)] = true;
  }
  go_to(target);
  return relative;
}

}  // namespace peritherm
