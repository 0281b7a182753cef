#include "peritherm/discretisation/cut_cell.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

struct CutCorner {
  Point x{};
  std::array<double, most_cut_surfaces> heights{};  ///< above each surface, negative inside [m]
};

/// A simplex of a cell (dimension + 1 corners), or a facet of one (dimension corners).
struct CutSimplex {
  std::array<CutCorner, 4> corners;
  int count = 0;
};

/// Surfaces [begin, end) of a layer run through the cell; it is inside where none of their heights is positive.
struct CutLayer {
  const CellLayer* layer;
  std::size_t begin, end;
  std::vector<std::size_t> numbers;  ///< of the surfaces, among those of the shape
};

/// One side of a facet: of what kind, or where the simplex goes on.
struct FacetSide {
  bool known = false;
  KindIndex kind = nothing;
  CutCorner far;  ///< the corner off the facet, for surfaces that the facet lies on
};

struct Facet {
  CutSimplex simplex;
  FacetSide first, second;
  Point direction{};  ///< from first to second
  int border = -1;
};

struct HeightRange {
  double lowest = 0.0, highest = 0.0;
  bool mixed() const { return lowest < 0.0 && highest > 0.0; }
  bool outside() const { return lowest >= 0.0 && highest > 0.0; }
  bool on_surface() const { return lowest == 0.0 && highest == 0.0; }
};

HeightRange height_range(const CutSimplex& simplex, std::size_t surface) {
  HeightRange range{simplex.corners[0].heights[surface], simplex.corners[0].heights[surface]};
  for (int c = 1; c < simplex.count; ++c) {
    range.lowest = std::min(range.lowest, simplex.corners[c].heights[surface]);
    range.highest = std::max(range.highest, simplex.corners[c].heights[surface]);
  }
  return range;
}

Point centroid_of(const CutSimplex& simplex) {
  Point sum{};
  for (int c = 0; c < simplex.count; ++c) sum = added(sum, simplex.corners[c].x);
  return scaled(sum, 1.0 / simplex.count);
}

/// Size of a facet times its normal, towards either side.
Point area_of(const CutSimplex& facet) {
  if (facet.count == 1) return {1.0, 0.0, 0.0};
  const Point edge = difference(facet.corners[1].x, facet.corners[0].x);
  if (facet.count == 2) return {edge[1], -edge[0], 0.0};
  return scaled(cross(edge, difference(facet.corners[2].x, facet.corners[0].x)), 0.5);
}

double volume_of(const CutSimplex& simplex) {
  CutSimplex facet = simplex;
  --facet.count;
  const Point edge = difference(simplex.corners[simplex.count - 1].x, simplex.corners[0].x);
  return std::abs(dot(area_of(facet), edge)) / (simplex.count - 1);
}

CutSimplex without(const CutSimplex& simplex, int corner) {
  CutSimplex facet = simplex;
  for (int c = corner; c + 1 < simplex.count; ++c) facet.corners[c] = simplex.corners[c + 1];
  --facet.count;
  return facet;
}

/// The point as far from the facet on its other side; heights are linear across it.
CutCorner mirrored(const CutCorner& far, const CutSimplex& facet) {
  CutCorner image;
  image.x = difference(scaled(centroid_of(facet), 2.0), far.x);
  for (std::size_t k = 0; k < most_cut_surfaces; ++k) {
    double sum = 0.0;
    for (int c = 0; c < facet.count; ++c) sum += facet.corners[c].heights[k];
    image.heights[k] = 2.0 * sum / facet.count - far.heights[k];
  }
  return image;
}

class CellDivider {
 public:
  CellDivider(const CellBlock& block, const NearLayers& layers, std::size_t cell)
      : block_(block), grid_(block.grid), place_(grid_.index(cell)) {
    const Point centre = grid_.position(place_);
    const double reach = 0.5 * (1.0 + 1e-6) * std::sqrt(static_cast<double>(grid_.dimension)) * grid_.spacing;
    const NearLayers near = near_layers(layers, centre, reach, 0.0);
    background_ = near.background;
    for (const CellLayer* layer : near.layers) add_layer(*layer);
    if (surfaces_ <= most_cut_surfaces) return;
    throw Error("more than " + std::to_string(most_cut_surfaces) + " surfaces run through the cell at " +
                    describe_place(centre, grid_.dimension),
                "Use a smaller spacing");
  }

  CellDivision divide() {
    std::array<int, 3> axes{0, 1, 2};
    do {
      CutSimplex simplex;
      simplex.count = grid_.dimension + 1;
      GridIndex node = place_;
      simplex.corners[0] = corner_at(node);
      for (int c = 1; c <= grid_.dimension; ++c) {
        ++node[axes[c - 1]];
        simplex.corners[c] = corner_at(node);
      }
      divide_simplex(simplex, layers_.size(), 0, false);
      visit_facets(simplex, axes, node);
    } while (std::next_permutation(axes.begin(), axes.begin() + grid_.dimension));
    return std::move(division_);
  }

 private:
  void add_layer(const CellLayer& layer) {
    const CornerHeights heights = heights_at_corners(layer.shape, grid_, place_);
    CutLayer cut{&layer, surfaces_, surfaces_, {}};
    for (std::size_t k = 0; k < heights.highest.size(); ++k) {
      if (heights.lowest[k] > 0.0) return;
      if (heights.highest[k] >= 0.0) cut.numbers.push_back(k);
    }
    cut.end = surfaces_ = surfaces_ + cut.numbers.size();
    layers_.push_back(std::move(cut));
  }

  CutCorner corner_at(const GridIndex& node) const {
    CutCorner corner;
    for (int axis = 0; axis < grid_.dimension; ++axis) {
      corner.x[axis] = grid_.origin[axis] + node[axis] * grid_.spacing;
    }
    std::vector<double> heights;
    for (const CutLayer& layer : layers_) {
      heights.clear();
      append_snapped_heights(layer.layer->shape, corner.x, grid_.spacing, heights);
      for (std::size_t k = 0; k < layer.numbers.size(); ++k)
        corner.heights[layer.begin + k] = heights[layer.numbers[k]];
    }
    return corner;
  }

  /// Where a surface crosses an edge.
  CutCorner crossing(const CutCorner& a, const CutCorner& b, std::size_t surface) const {
    const double share = a.heights[surface] / (a.heights[surface] - b.heights[surface]);
    CutCorner middle;
    middle.x = between(a.x, b.x, share);
    for (std::size_t k = 0; k < surfaces_; ++k) {
      middle.heights[k] = snapped((1.0 - share) * a.heights[k] + share * b.heights[k], grid_.spacing);
    }
    middle.heights[surface] = 0.0;
    return middle;
  }

  /// Cuts an edge that the surface crosses; calls visit with both halves.
  template <class Visit>
  void split(const CutSimplex& simplex, std::size_t surface, const Visit& visit) const {
    int low = 0, high = 0;
    while (simplex.corners[low].heights[surface] >= 0.0) ++low;
    while (simplex.corners[high].heights[surface] <= 0.0) ++high;
    const CutCorner middle = crossing(simplex.corners[low], simplex.corners[high], surface);
    for (const int replaced : {low, high}) {
      CutSimplex half = simplex;
      half.corners[replaced] = middle;
      visit(half);
    }
  }

  /// The first `count` layers are left, of the last of them all surfaces from number `next` on; `split_now`: it has
  /// just cut this simplex off another one.
  void divide_simplex(const CutSimplex& simplex, std::size_t count, std::size_t next, bool split_now) {
    if (count == 0) return add_share(simplex, background_);
    const CutLayer& layer = layers_[count - 1];
    const std::size_t surface = layer.begin + next;
    if (surface == layer.end) return add_share(simplex, layer.layer->kind);
    const HeightRange range = height_range(simplex, surface);
    if (range.mixed()) {
      split(simplex, surface, [&](const CutSimplex& half) { divide_simplex(half, count, next, true); });
    } else if (range.outside() || (range.on_surface() && !is_below(simplex, layer, next))) {
      if (split_now) add_section(simplex, surface, count);
      divide_simplex(simplex, count - 1, 0, false);
    } else {
      divide_simplex(simplex, count, next + 1, false);
    }
  }

  /// All corners on a surface: one cell between two of its sides.
  bool is_below(const CutSimplex& simplex, const CutLayer& layer, std::size_t next) const {
    std::vector<double> heights;
    append_heights(layer.layer->shape, centroid_of(simplex), heights);
    return heights[layer.numbers[next]] < 0.0;
  }

  /// The facet that a surface has just cut, seen from outside it.
  void add_section(const CutSimplex& outer, std::size_t surface, std::size_t count) {
    int off = -1;
    for (int c = 0; c < outer.count; ++c) {
      if (outer.corners[c].heights[surface] == 0.0) continue;
      if (off >= 0) return;
      off = c;
    }
    if (off < 0) return;
    Facet facet;
    facet.simplex = without(outer, off);
    facet.first.far = mirrored(outer.corners[off], facet.simplex);
    facet.second.far = outer.corners[off];
    facet.direction = difference(outer.corners[off].x, facet.simplex.corners[0].x);
    label_facet(facet, count);
  }

  /// Facets of a simplex of the cell that may be a surface themselves, each from one side only.
  void visit_facets(const CutSimplex& simplex, const std::array<int, 3>& axes, const GridIndex& last) {
    const int d = grid_.dimension;
    visit_outer_facet(simplex, 0, axes[0], true, last);
    visit_outer_facet(simplex, d, axes[d - 1], false, place_);
    GridIndex node = place_;
    for (int c = 1; c < d; ++c) {
      GridIndex opposite = node;
      ++opposite[axes[c]];
      if (axes[c - 1] < axes[c]) label_between(simplex, c, opposite, {}, -1);
      ++node[axes[c - 1]];
    }
  }

  /// A facet on a face of the cell; `node` is the corner from which the next cell's simplex goes on.
  void visit_outer_facet(const CutSimplex& simplex, int corner, int axis, bool upper, GridIndex node) {
    Point direction{};
    direction[axis] = upper ? 1.0 : -1.0;
    const int next = place_[axis] + (upper ? 1 : -1);
    if (next < 0 || next >= grid_.cells[axis]) {
      return label_between(simplex, corner, node, direction, 2 * axis + (upper ? 1 : 0));
    }
    GridIndex other = place_;
    other[axis] = next;
    if (!upper && block_.cut(grid_.number(other))) return;
    node[axis] += upper ? 1 : -1;
    label_between(simplex, corner, node, direction, -1);
  }

  void label_between(const CutSimplex& simplex, int corner, const GridIndex& opposite, Point direction, int border) {
    Facet facet;
    facet.simplex = without(simplex, corner);
    facet.first = {false, nothing, simplex.corners[corner]};
    facet.second = {border >= 0, beyond_border, border >= 0 ? CutCorner{} : corner_at(opposite)};
    facet.border = border;
    const bool given = dot(direction, direction) > 0.0;
    facet.direction = given ? direction : difference(facet.second.far.x, simplex.corners[corner].x);
    label_facet(facet, layers_.size());
  }

  /// Finds what stands on both sides, by the first `count` layers.
  void label_facet(const Facet& facet, std::size_t count) {
    if (count == 0 || (facet.first.known && facet.second.known)) return add_piece(facet);
    const CutLayer& layer = layers_[count - 1];
    std::optional<std::size_t> mixed;
    for (std::size_t surface = layer.begin; surface < layer.end; ++surface) {
      const HeightRange range = height_range(facet.simplex, surface);
      if (range.outside()) return label_facet(facet, count - 1);
      if (range.mixed()) mixed = surface;
    }
    if (mixed) {
      split(facet.simplex, *mixed, [&](const CutSimplex& half) {
        Facet part = facet;
        part.simplex = half;
        label_facet(part, count);
      });
      return;
    }
    Facet labelled = facet;
    for (FacetSide* side : {&labelled.first, &labelled.second}) {
      if (side->known || !is_inside(facet.simplex, *side, layer)) continue;
      side->known = true;
      side->kind = layer.layer->kind;
    }
    label_facet(labelled, count - 1);
  }

  /// A facet that no surface of the layer cuts, and that is outside none.
  static bool is_inside(const CutSimplex& facet, const FacetSide& side, const CutLayer& layer) {
    for (std::size_t surface = layer.begin; surface < layer.end; ++surface) {
      if (height_range(facet, surface).on_surface() && side.far.heights[surface] >= 0.0) return false;
    }
    return true;
  }

  void add_share(const CutSimplex& simplex, KindIndex kind) {
    auto share = std::find_if(division_.shares.begin(), division_.shares.end(),
                              [&](const CellShare& s) { return s.kind == kind; });
    if (share == division_.shares.end()) share = division_.shares.insert(share, {kind, 0.0, {}});
    const double volume = volume_of(simplex);
    share->volume += volume;
    share->moment = added(share->moment, scaled(centroid_of(simplex), volume));
  }

  void add_piece(const Facet& facet) {
    const KindIndex first = facet.first.known ? facet.first.kind : background_;
    const KindIndex second = facet.second.known ? facet.second.kind : background_;
    if (first == second) return;
    Point area = area_of(facet.simplex);
    if ((dot(area, facet.direction) < 0.0) != (first < second)) area = scaled(area, -1.0);
    // From the higher kind to the lower one, so that kinds of nothing come second.
    const KindIndex out = std::max(first, second), into = std::min(first, second);
    auto& pieces = division_.pieces;
    auto piece = std::find_if(pieces.begin(), pieces.end(), [&](const CellPiece& p) {
      return p.first == out && p.second == into && p.border == facet.border;
    });
    if (piece == pieces.end()) piece = pieces.insert(piece, {out, into, facet.border, {}, {}, 0.0});
    const double size = length(area);
    piece->size += size;
    piece->area = added(piece->area, area);
    piece->moment = added(piece->moment, scaled(centroid_of(facet.simplex), size));
  }

  const CellBlock& block_;
  const Grid& grid_;
  GridIndex place_;
  KindIndex background_ = nothing;
  std::vector<CutLayer> layers_;
  std::size_t surfaces_ = 0;
  CellDivision division_;
};

}  // namespace

CellDivision divide_cell(const CellBlock& block, const NearLayers& layers, std::size_t cell) {
  return CellDivider(block, layers, cell).divide();
}

}  // namespace peritherm
