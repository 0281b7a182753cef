#include "peritherm/discretisation/own_grids.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "peritherm/base/text.hpp"
#include "peritherm/discretisation/place_buckets.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// Lengths that differ by less than this share of a spacing are the same.
constexpr double same_length = 1e-6;

/// A face of a cell in space.
struct BorderFace {
  std::size_t block = 0, cell = 0;
  int axis = 0, part = 0;
  bool upper = false;
  double spacing = 0.0;
  Point low{}, high{};  ///< corners; equal along the axis [m]
  double area = 0.0;
  double covered = 0.0;  ///< by faces of other grids [m²]
  Point covered_moment{};
};

BorderFace border_face(const CellBlock& block, std::size_t number, const OpenFace& open) {
  const Grid& grid = block.grid;
  BorderFace face;
  face.block = number;
  face.cell = grid.number(open.place);
  face.axis = open.axis;
  face.part = open.part;
  face.upper = open.upper;
  face.spacing = grid.spacing;
  face.area = grid.cell_volume() / grid.spacing;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    face.low[axis] = grid.origin[axis] + open.place[axis] * grid.spacing;
    face.high[axis] = face.low[axis] + grid.spacing;
  }
  const double level = grid.origin[open.axis] + (open.place[open.axis] + (open.upper ? 1 : 0)) * grid.spacing;
  face.low[open.axis] = face.high[open.axis] = level;
  return face;
}

/// Area and centroid that two faces share.
struct Overlap {
  double area = 0.0;
  Point centroid{};
};
Overlap overlap_of(const BorderFace& a, const BorderFace& b, int dimension) {
  const double slack = same_length * std::min(a.spacing, b.spacing);
  Overlap shared{1.0, {}};
  for (int axis = 0; axis < dimension; ++axis) {
    const double low = std::max(a.low[axis], b.low[axis]);
    const double high = std::min(a.high[axis], b.high[axis]);
    shared.centroid[axis] = 0.5 * (low + high);
    if (axis == a.axis) {
      if (std::abs(a.low[axis] - b.low[axis]) > slack) return {};
    } else {
      if (high - low <= slack) return {};
      shared.area *= high - low;
    }
  }
  return shared;
}

Point middle_of(const BorderFace& face) { return between(face.low, face.high, 0.5); }

class GridJoiner {
 public:
  GridJoiner(const std::vector<CellBlock>& blocks, const std::vector<std::vector<OpenFace>>& open)
      : blocks_(blocks), dimension_(blocks.front().grid.dimension) {
    for (std::size_t b = 0; b < open.size(); ++b) {
      for (const OpenFace& face : open[b]) faces_.push_back(border_face(blocks[b], b, face));
    }
  }

  void join(std::vector<SurfacePiece>& pieces) {
    find_contacts();
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const std::size_t begin = pieces.size();
      for (const BorderFace& face : faces_) {
        if (face.block == b) add_bare(face, pieces);
      }
      for (const auto& [key, contact] : contacts_) {
        if (faces_[key.first].block == b) add_contact(faces_[key.first], key.second, contact, pieces);
      }
      merge_small_pieces(blocks_[b].grid, begin, pieces);
    }
  }

 private:
  void find_contacts() {
    double width = 0.0;
    for (const BorderFace& face : faces_) width = std::max(width, face.spacing);
    PlaceBuckets<std::size_t> lower(dimension_, width);
    for (std::size_t n = 0; n < faces_.size(); ++n) {
      if (!faces_[n].upper) lower.add(middle_of(faces_[n]), n);
    }
    for (std::size_t n = 0; n < faces_.size(); ++n) {
      if (!faces_[n].upper) continue;
      lower.for_each_near(middle_of(faces_[n]), [&](std::size_t other) { meet(n, other); });
    }
  }

  void meet(std::size_t upper, std::size_t lower) {
    BorderFace& a = faces_[upper];
    BorderFace& b = faces_[lower];
    if (a.axis != b.axis || a.block == b.block) return;
    const Overlap shared = overlap_of(a, b, dimension_);
    if (shared.area == 0.0) return;
    for (BorderFace* face : {&a, &b}) {
      face->covered += shared.area;
      face->covered_moment = added(face->covered_moment, scaled(shared.centroid, shared.area));
    }
    const bool upper_counts = a.spacing > b.spacing || (a.spacing == b.spacing && a.block < b.block);
    Overlap& contact =
        contacts_.try_emplace({upper_counts ? upper : lower, upper_counts ? b.part : a.part}, Overlap{}).first->second;
    contact.area += shared.area;
    contact.centroid = added(contact.centroid, scaled(shared.centroid, shared.area));
  }

  /// What of a face meets nothing.
  void add_bare(const BorderFace& face, std::vector<SurfacePiece>& pieces) const {
    const double bare = face.area - face.covered;
    if (bare <= same_length * face.area) return;
    Overlap rest{bare, scaled(added(face.low, face.high), 0.5 * face.area)};
    rest.centroid = difference(rest.centroid, face.covered_moment);
    add_contact(face, -1, rest, pieces);
  }

  /// `contact.centroid` is still a moment.
  void add_contact(const BorderFace& face, int other, const Overlap& contact, std::vector<SurfacePiece>& pieces) const {
    const bool turned = other >= 0 && other < face.part;
    SurfacePiece piece;
    piece.position = scaled(contact.centroid, 1.0 / contact.area);
    piece.position[face.axis] = face.low[face.axis];
    piece.area[face.axis] = face.upper != turned ? contact.area : -contact.area;
    piece.first = turned ? other : face.part;
    piece.second = turned ? face.part : other;
    piece.cell = face.cell;
    pieces.push_back(piece);
  }

  const std::vector<CellBlock>& blocks_;
  int dimension_;
  std::vector<BorderFace> faces_;
  /// By face of the coarser grid and part beyond it; centroids are moments until all is added.
  std::map<std::pair<std::size_t, int>, Overlap> contacts_;
};

/// As near as surfaces along cells are told from others.
bool is_whole(double ratio) { return std::abs(ratio - std::round(ratio)) <= 1e-9; }

Issue misfit(const PartRegion& region, double side, int axis, const Grid& grid) {
  const double below = grid.origin[axis] + std::floor((side - grid.origin[axis]) / grid.spacing) * grid.spacing;
  return {region.where,
          "region '" + region.name + "' has points of its own, but its side at " + "xyz"[axis] + " = " +
              shortest(side) + " m cuts through cells of what it overwrites",
          "Let it stand at " + shortest(below) + " or " + shortest(below + grid.spacing) + " m"};
}

/// Sides that run through a grid must be along its cells.
void find_misfits(const PartRegion& region, const Point& low, const Point& high, const Grid& grid,
                  std::vector<Issue>& issues) {
  const double slack = same_length * grid.spacing;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double end = grid.origin[axis] + grid.length(axis);
    if (high[axis] < grid.origin[axis] + slack || low[axis] > end - slack) return;
  }
  for (int axis = 0; axis < grid.dimension; ++axis) {
    for (const double side : {low[axis], high[axis]}) {
      const double ratio = (side - grid.origin[axis]) / grid.spacing;
      if (ratio > 0.0 && ratio < grid.cells[axis] && !is_whole(ratio)) {
        issues.push_back(misfit(region, side, axis, grid));
      }
    }
  }
}

}  // namespace

void join_grids(const std::vector<CellBlock>& blocks, const std::vector<std::vector<OpenFace>>& open,
                std::vector<SurfacePiece>& pieces) {
  GridJoiner(blocks, open).join(pieces);
}

Grid make_own_grid(const PartRegion& region, const Grid& body, const std::vector<CellBlock>& overwritten,
                   std::vector<Issue>& issues) {
  const Box& box = std::get<Box>(region.shape);
  Grid grid;
  grid.dimension = body.dimension;
  grid.spacing = region.spacing;
  Point high{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    grid.origin[axis] = std::max(box.from[axis], body.origin[axis]);
    high[axis] = std::min(box.to[axis], body.origin[axis] + body.length(axis));
    const double size = high[axis] - grid.origin[axis];
    const double cells = std::max(1.0, std::round(size / region.spacing));
    grid.cells[axis] = static_cast<int>(cells);
    if (size <= 0.0) {
      issues.push_back({region.where, "region '" + region.name + "' lies outside the box", "Let it lie inside"});
      return grid;
    }
    if (is_whole(size / region.spacing)) continue;
    issues.push_back({region.where,
                      "region '" + region.name + "' is " + shortest(size) + " m long along " + "xyz"[axis] +
                          ", which is no whole number of its spacings of " + shortest(region.spacing) + " m",
                      "Use a spacing of " + shortest(size / cells) + " m, or another size"});
  }
  for (const CellBlock& block : overwritten) find_misfits(region, grid.origin, high, block.grid, issues);
  return grid;
}

}  // namespace peritherm
