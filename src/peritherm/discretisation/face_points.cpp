#include "peritherm/discretisation/face_points.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

constexpr double off_face = 1e-6;       ///< spacings; a point on a face is moved this far to its own side
constexpr double on_face = 1e-9;        ///< spacings
constexpr double passage_place = 1e-6;  ///< of a bond's length
constexpr int most_reflections = 6;
constexpr double least_rise = 0.4;    ///< spacings between layers of cells
constexpr double least_volume = 0.2;  ///< of a cell, left after balancing or a second cut
constexpr std::size_t largest_box = std::size_t{1} << 26;
constexpr double half_diagonal = 0.87;   ///< of a cube, rounded up
constexpr double taking_distance = 1.2;  ///< spacings; from the middle of what is given to the points that take it

GridIndex sum_of(const GridIndex& p, const GridIndex& offset) {
  return {p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]};
}

/// Volume of the part of a unit cell about the origin that lies where normal · x > height: inclusion and exclusion
/// over its corners.
double cell_share_above(const Point& normal, double height) {
  std::vector<double> slopes;
  for (const double entry : normal) {
    if (std::abs(entry) > 1e-5) slopes.push_back(std::abs(entry));
  }
  const auto count = static_cast<int>(slopes.size());
  double half_width = 0.0, product = 1.0;
  for (int k = 0; k < count; ++k) {
    half_width += 0.5 * slopes[static_cast<std::size_t>(k)];
    product *= slopes[static_cast<std::size_t>(k)] * (k + 1);
  }
  double sum = 0.0;
  for (int corner = 0; corner < 1 << count; ++corner) {
    double reach = half_width - height, sign = 1.0;
    for (int k = 0; k < count; ++k) {
      if ((corner >> k & 1) == 0) continue;
      reach -= slopes[static_cast<std::size_t>(k)];
      sign = -sign;
    }
    if (reach > 0.0) sum += sign * std::pow(reach, count);
  }
  return std::clamp(sum / product, 0.0, 1.0);
}

/// All bonds of a point exist and conduct alike.
bool is_whole(const Body& body, const Stencil& stencil, const GridIndex& p) {
  const MaterialIndex material = body.material_of[body.grid.number(p)];
  return std::all_of(stencil.entries.begin(), stencil.entries.end(), [&](const StencilEntry& entry) {
    return body.material_of_extended({p[0] + entry.offset[0], p[1] + entry.offset[1], p[2] + entry.offset[2]}) ==
           material;
  });
}

/// Conductivity of a bond in a body of several materials, the same from both ends.
double conductivity_to(const Body& body, const FacePoint& point, const GridIndex& q) {
  const MaterialIndex other = body.material_of_extended(q);
  if (other == no_material) return point.conductivity;
  const double there = body.materials[other].conductivity;
  return 2.0 * point.conductivity * there / (point.conductivity + there);
}

/// Where two pieces of a crack meet, or one and its image in a wall, a bond through both passes but one face.
bool is_repeated(const std::vector<std::pair<std::size_t, FacePiece::Cut>>& passages, std::size_t crack,
                 const FacePiece::Cut& cut) {
  return std::any_of(passages.begin(), passages.end(), [&](const auto& passage) {
    const auto& [other, before] = passage;
    return other == crack && std::abs(before.place - cut.place) < passage_place && before.share >= cut.share;
  });
}

}  // namespace

FacePoints::FacePoints(const Body& body, const Stencil& stencil, const std::vector<FacePiece>& pieces,
                       double horizon_ratio)
    : stencil_(stencil), pieces_(pieces), grid_(body.grid) {
  // Bonds lead from points with cut bonds to others that have none.
  collect(body, 2.0 * longest_offset(stencil) + 1.0);
  const auto count = static_cast<std::int64_t>(points_.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::int64_t n = 0; n < count; ++n) {
    settle(body, static_cast<std::size_t>(n), horizon_ratio);
    look_along_bonds(body, static_cast<std::size_t>(n), horizon_ratio);
  }
  share_cells(body);
}

std::int64_t FacePoints::find(const GridIndex& index) const {
  if (in_box_.empty()) return grid_.contains(index) ? find(grid_.number(index)) : -1;
  const std::int64_t place = place_in_box(index);
  return place < 0 ? -1 : in_box_[static_cast<std::size_t>(place)];
}

/// −1: outside.
std::int64_t FacePoints::place_in_box(const GridIndex& index) const {
  std::int64_t place = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const int step = index[axis] - box_low_[axis];
    if (step < 0 || step >= box_size_[axis]) return -1;
    place = place * box_size_[axis] + step;
  }
  return place;
}

void FacePoints::fill_box() {
  if (points_.empty()) return;
  GridIndex high = points_.front().index;
  box_low_ = high;
  for (const FacePoint& point : points_) {
    for (int axis = 0; axis < 3; ++axis) {
      box_low_[axis] = std::min(box_low_[axis], point.index[axis]);
      high[axis] = std::max(high[axis], point.index[axis]);
    }
  }
  std::size_t size = 1;
  for (int axis = 0; axis < 3; ++axis) {
    box_size_[axis] = high[axis] - box_low_[axis] + 1;
    size *= static_cast<std::size_t>(box_size_[axis]);
  }
  if (size > largest_box) return;
  in_box_.assign(size, -1);
  for (std::size_t n = 0; n < points_.size(); ++n) {
    in_box_[static_cast<std::size_t>(place_in_box(points_[n].index))] = static_cast<std::int32_t>(n);
  }
}

std::int64_t FacePoints::find(std::size_t number) const {
  const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), number);
  return found != numbers_.end() && *found == number ? found - numbers_.begin() : -1;
}

void FacePoints::collect(const Body& body, double reach) {
  std::vector<std::pair<std::size_t, int>> found;
  for (std::size_t n = 0; n < pieces_.size(); ++n) {
    const auto bounds = pieces_[n].bounds();
    GridIndex low{}, high{};
    for (int axis = 0; axis < grid_.dimension; ++axis) {
      low[axis] = static_cast<int>(std::ceil(std::max(0.0, bounds[0][axis] - reach)));
      high[axis] = static_cast<int>(std::floor(std::min(grid_.count(axis) - 1.0, bounds[1][axis] + reach)));
    }
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          const Point place = in_spacings({x, y, z});
          if (std::abs(pieces_[n].height(place)) > reach || pieces_[n].distance_to(place) > reach) continue;
          const std::size_t number = grid_.number({x, y, z});
          if (body.material_of[number] != no_material) found.emplace_back(number, static_cast<int>(n));
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  for (const auto& [number, piece] : found) {
    if (numbers_.empty() || numbers_.back() != number) {
      numbers_.push_back(number);
      points_.emplace_back().index = grid_.index(number);
      pieces_near_.emplace_back();
    }
    pieces_near_.back().push_back(piece);
  }
  fill_box();
}

Point FacePoints::off_faces(const Point& x, const std::vector<int>& pieces) const {
  Point moved = x;
  for (const int n : pieces) {
    const FacePiece& piece = pieces_[static_cast<std::size_t>(n)];
    if (std::abs(piece.height(x)) <= on_face && piece.touches(x, on_face)) {
      moved = added(moved, scaled(piece.normal(), off_face));
    }
  }
  return moved;
}

/// What a point is, and which piece it is nearest to.
void FacePoints::settle(const Body& body, std::size_t n, double horizon_ratio) {
  FacePoint& point = points_[n];
  point.whole = is_whole(body, stencil_, point.index);
  point.conductivity = body.materials[body.material_of[grid_.number(point.index)]].conductivity;
  const std::vector<int>& near = pieces_near_[n];
  const Point own = in_spacings(point.index);
  point.place = off_faces(own, near);
  double nearest = HUGE_VAL;
  for (const int k : near) {
    const FacePiece& piece = pieces_[static_cast<std::size_t>(k)];
    const double distance = piece.distance_to(point.place);
    if (distance < nearest - 1e-9) {
      nearest = distance;
      point.frame = k;
    }
    point.near_tip = point.near_tip || piece.distance_to_tip(point.place) < horizon_ratio;
  }
}

void FacePoints::look_along_bonds(const Body& body, std::size_t n, double horizon_ratio) {
  FacePoint& point = points_[n];
  const std::vector<int>& near = pieces_near_[n];
  const std::size_t count = stencil_.entries.size();
  std::vector<std::pair<std::size_t, FacePiece::Cut>> passages;
  for (std::size_t k = 0; k < count; ++k) {
    const GridIndex q = sum_of(point.index, stencil_.entries[k].offset);
    const Point end = off_faces(in_spacings(q), near);
    const double conductivity = conductivity_to(body, point, q);
    double whole = 1.0, resistance = 0.0;
    bool exchanges = true;
    Point jumps{};
    passages.clear();
    for (const int m : near) {
      const FacePiece& piece = pieces_[static_cast<std::size_t>(m)];
      if (!piece.meets(point.place, end, 2.0 * horizon_ratio)) continue;
      const FacePiece::Cut found = piece.cut(point.place, end, conductivity);
      const double share = found.share;
      if (is_repeated(passages, piece.crack(), found)) continue;
      passages.emplace_back(piece.crack(), found);
      const double jump = piece.jump(conductivity);
      // At tips, where less is cut than the gap would, such bonds are left alone.
      const double across = dot(difference(end, point.place), piece.normal());
      exchanges = exchanges && jump > 0.0 && share * (std::abs(across) + jump) > jump * (1.0 - 1e-9);
      whole *= 1.0 - share;
      if (!exchanges) continue;
      resistance += jump / std::abs(across);
      jumps = added(jumps, scaled(piece.normal(), std::copysign(jump, across)));
    }
    // Gaps resist one after the other.
    if (exchanges) whole = 1.0 / (1.0 + resistance);
    if (whole < 1.0) {
      if (point.cut.empty()) point.cut.assign(count, 0.0);
      point.cut[k] = 1.0 - whole;
    }
    if (passages.empty()) continue;
    if (point.ways.empty()) point.ways.assign(count, Way::free);
    point.ways[k] = exchanges ? Way::exchanges : Way::parted;
    if (!exchanges) continue;
    if (point.jumps.empty()) point.jumps.assign(count, Point{});
    point.jumps[k] = jumps;
  }
}

Point FacePoints::unfolded_end(std::size_t n, int k) const {
  const std::vector<int>& near = pieces_near_[n];
  const double conductivity = points_[n].conductivity;
  Point begin = points_[n].place;
  Point end =
      off_faces(in_spacings(sum_of(points_[n].index, stencil_.entries[static_cast<std::size_t>(k)].offset)), near);
  int last = -1;
  for (int round = 0; round < most_reflections; ++round) {
    double first = 2.0;
    int met = -1;
    for (const int m : near) {
      if (m == last) continue;
      const FacePiece::Cut cut = pieces_[static_cast<std::size_t>(m)].cut(begin, end, conductivity);
      if (cut.share > 0.0 && cut.place < first && cut.place > 1e-9) {
        first = cut.place;
        met = m;
      }
    }
    if (met < 0) break;
    begin = between(begin, end, first);
    end = pieces_[static_cast<std::size_t>(met)].mirrored(end);
    last = met;
  }
  return end;
}

/// The part of a cell that lies beyond a face belongs to points there.
void FacePoints::share_cells(const Body& body) {
  struct Shared {
    std::size_t point;
    const FacePiece& piece;
    double beyond;
    Takers takers;
  };
  std::vector<Shared> shared;
  for (std::size_t n = 0; n < points_.size(); ++n) {
    if (!points_[n].whole) continue;
    for (const int k : faces_around(n)) {
      const FacePiece& piece = pieces_[static_cast<std::size_t>(k)];
      const double height = piece.height(points_[n].place);
      const Point foot = added(points_[n].place, scaled(piece.normal(), -height));
      const double beyond = piece.share_at(foot) * cell_share_above(piece.normal(), std::abs(height));
      if (beyond <= 1e-12 || (k != points_[n].frame && points_[n].volume - beyond < least_volume)) continue;
      Takers takers = find_takers(body, n, piece, -0.25);
      if (takers.empty()) continue;
      points_[n].volume -= beyond;
      give(takers, beyond * grid_.volume_share(points_[n].index));
      if (piece.jump(points_[n].conductivity) > 0.0) shared.push_back({n, piece, beyond, std::move(takers)});
    }
  }
  for (const auto& [n, piece, beyond, takers] : shared) balance_cells(body, n, piece, beyond, takers);
}

/// The nearest face, and others that may cut the cell on the opposite side: an image, if the wall is near.
std::vector<int> FacePoints::faces_around(std::size_t n) const {
  const FacePoint& point = points_[n];
  const auto towards = [&](int k) {
    const FacePiece& piece = pieces_[static_cast<std::size_t>(k)];
    return scaled(piece.normal(), piece.height(point.place) >= 0.0 ? -1.0 : 1.0);
  };
  std::vector<int> found;
  for (const int k : pieces_near_[n]) {
    if (std::abs(pieces_[static_cast<std::size_t>(k)].height(point.place)) >= half_diagonal) continue;
    if (k == point.frame || dot(towards(k), towards(point.frame)) < -0.9) found.push_back(k);
  }
  return found;
}

void FacePoints::give(const Takers& takers, double volume) {
  double sum = 0.0;
  for (const auto& [taker, weight] : takers) sum += weight;
  for (const auto& [taker, weight] : takers) {
    points_[taker].volume += volume * weight / (sum * grid_.volume_share(points_[taker].index));
  }
}

/// Height above a piece of what is given to takers.
double FacePoints::mean_height(const Takers& takers, const FacePiece& piece) const {
  double sum = 0.0, heights = 0.0;
  for (const auto& [taker, weight] : takers) {
    sum += weight;
    heights += weight * piece.height(points_[taker].place);
  }
  return heights / sum;
}

/// Where heat passes between the faces, what is given across must not move the middle of all volume: rows for steps of
/// temperature and for parabolas could not both be met. As much as it has moved is moved back on both sides.
void FacePoints::balance_cells(const Body& body, std::size_t n, const FacePiece& piece, double beyond,
                               const Takers& takers) {
  const double height = std::abs(piece.height(points_[n].place));
  const double side = piece.height(points_[n].place) >= 0.0 ? 1.0 : -1.0;
  const Takers above = find_takers(body, n, piece, height + 1.0), below = find_takers(body, n, piece, -1.25);
  if (above.empty() || below.empty()) return;
  const double taken_at = side * mean_height(takers, piece);
  const double rise = side * mean_height(above, piece) - height, fall = taken_at - side * mean_height(below, piece);
  if (rise < least_rise || fall < least_rise) return;
  const double moved = 0.5 * beyond * (height - taken_at), cell = grid_.volume_share(points_[n].index);
  const bool enough = std::all_of(below.begin(), below.end(), [&](const auto& taker) {
    return points_[taker.first].volume - moved / fall * cell / grid_.volume_share(points_[taker.first].index) >
           least_volume;
  });
  if (!enough || points_[n].volume - moved / rise < least_volume) return;
  points_[n].volume -= moved / rise;
  give(above, moved / rise * cell);
  give(below, -moved / fall * cell);
  give(takers, moved / fall * cell);
}

/// Points around the place at a height above the face, counted towards the point's own side, and on the same side as
/// it, which no other face parts from it.
FacePoints::Takers FacePoints::find_takers(const Body& body, std::size_t n, const FacePiece& piece,
                                           double above) const {
  const FacePoint& point = points_[n];
  const double height = piece.height(point.place), side = height >= 0.0 ? 1.0 : -1.0;
  const Point middle = added(point.place, scaled(piece.normal(), above * side - height));
  Takers takers;
  GridIndex reach{};
  for (int axis = 0; axis < grid_.dimension; ++axis) reach[axis] = above < 0.0 ? 3 : 2;
  for (int z = -reach[2]; z <= reach[2]; ++z) {
    for (int y = -reach[1]; y <= reach[1]; ++y) {
      for (int x = -reach[0]; x <= reach[0]; ++x) {
        const GridIndex q = sum_of(point.index, {x, y, z});
        const Point there = off_faces(in_spacings(q), pieces_near_[n]);
        const double weight = taking_distance - length(difference(there, middle));
        if (weight <= 0.0 || piece.height(there) * side * above <= 0.0) continue;
        const bool parted = std::any_of(pieces_near_[n].begin(), pieces_near_[n].end(), [&](int m) {
          const FacePiece& other = pieces_[static_cast<std::size_t>(m)];
          return &other != &piece && other.meets(middle, there, 0.0);
        });
        const std::int64_t taker = parted ? -1 : find(body.fold(q));
        if (taker >= 0 && points_[static_cast<std::size_t>(taker)].whole)
          takers.emplace_back(static_cast<std::size_t>(taker), weight);
      }
    }
  }
  return takers;
}

}  // namespace peritherm
