#include "peritherm/discretisation/cut_cells.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "peritherm/discretisation/cut_cell.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// A part with less of its point's cell than this is lost there.
constexpr double least_share = 1e-6;
/// Pieces that cancel but for this share are two sides of something thin.
constexpr double opposite_share = 0.1;
/// How many cells away the next point of a thin tip may stand.
constexpr int farthest_point = 4;

class CellSharer {
 public:
  CellSharer(const CellBlock& block, const Grid& box, const std::vector<PartKind>& kinds, std::vector<SubDomain>& parts,
             std::vector<SurfacePiece>& pieces, std::vector<Issue>& issues)
      : block_(block), kinds_(kinds), parts_(parts), pieces_(pieces), issues_(issues), reported_(kinds.size(), false) {
    for (int n = 0; n < 2 * block.grid.dimension; ++n) border_[n] = box_face(box, block.grid, n / 2, n % 2 == 1);
  }

  void share(const NearLayers& layers, std::size_t cell) {
    const CellDivision division = divide_cell(block_, layers, cell);
    for (const CellShare& share : division.shares) {
      if (share.kind >= 0 && share.volume > 0.0) give(share, cell);
    }
    for (const CellPiece& piece : division.pieces) {
      if (piece.first < 0 || piece.size <= 0.0) continue;
      if (length(piece.area) < opposite_share * piece.size &&
          piece.size > block_.grid.cell_volume() / block_.grid.spacing) {
        report_thinner(division, piece, cell);
      } else {
        add(piece, cell);
      }
    }
  }

  void find_empty_points() {
    for (const std::size_t cell : block_.cut_cells) {
      if (block_.part_of[cell] < 0 || volume_at(cell) > least_share * block_.grid.cell_volume()) continue;
      report(block_.kind_of[cell], block_.grid.position(block_.grid.index(cell)));
    }
  }

 private:
  double& volume_at(std::size_t cell) {
    return parts_[static_cast<std::size_t>(block_.part_of[cell])]
        .volumes[static_cast<std::size_t>(block_.point_of[cell])];
  }

  void give(const CellShare& share, std::size_t cell) {
    const Point centroid = scaled(share.moment, 1.0 / share.volume);
    if (const auto nearest = nearest_cell(cell, share.kind, centroid)) {
      volume_at(*nearest) += share.volume;
    } else {
      report(share.kind, centroid);
    }
  }

  void add(const CellPiece& piece, std::size_t cell) {
    SurfacePiece made;
    made.position = scaled(piece.moment, 1.0 / piece.size);
    made.area = piece.area;
    made.cell = cell;
    made.movable = piece.border < 0;
    if (piece.second == on_other_grid || (piece.border >= 0 && border_[piece.border] < 0)) {
      return report_border(made.position);
    }
    const auto first = nearest_cell(cell, piece.first, made.position);
    const auto second = piece.second >= 0 ? nearest_cell(cell, piece.second, made.position) : std::nullopt;
    // Where no point is near, the volume has been missed already.
    if (!first || (piece.second >= 0 && !second)) return;
    made.first = block_.part_of[*first];
    made.second = second ? block_.part_of[*second] : -1;
    made.face = piece.border >= 0 ? border_[piece.border] : -1;
    if (made.second >= 0 && made.second < made.first) {
      std::swap(made.first, made.second);
      made.area = scaled(made.area, -1.0);
    }
    if (made.first != made.second) pieces_.push_back(made);
  }

  /// The nearest cell with a point of that kind; the cell itself if it can be.
  std::optional<std::size_t> nearest_cell(std::size_t cell, KindIndex kind, const Point& x) const {
    if (block_.kind_of[cell] == kind) return cell;
    std::optional<std::size_t> nearest;
    for (int reach = 1; reach <= farthest_point && !nearest; ++reach) nearest = nearest_within(cell, kind, x, reach);
    return nearest;
  }

  std::optional<std::size_t> nearest_within(std::size_t cell, KindIndex kind, const Point& x, int reach) const {
    const Grid& grid = block_.grid;
    const GridIndex place = grid.index(cell);
    GridIndex low{}, high{};
    for (int axis = 0; axis < grid.dimension; ++axis) {
      low[axis] = std::max(place[axis] - reach, 0);
      high[axis] = std::min(place[axis] + reach, grid.cells[axis] - 1);
    }
    std::optional<std::size_t> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          const std::size_t other = grid.number({i, j, k});
          if (block_.kind_of[other] != kind) continue;
          const Point arm = difference(grid.position({i, j, k}), x);
          if (dot(arm, arm) >= least) continue;
          least = dot(arm, arm);
          nearest = other;
        }
      }
    }
    return nearest;
  }

  /// Of the two kinds that a piece lies between, that of which less is in the cell.
  void report_thinner(const CellDivision& division, const CellPiece& piece, std::size_t cell) {
    KindIndex thin = piece.first;
    const auto volume = [&](KindIndex kind) {
      for (const CellShare& share : division.shares) {
        if (share.kind == kind) return share.volume;
      }
      return 0.0;
    };
    if (piece.second >= 0 && volume(piece.second) < volume(piece.first)) thin = piece.second;
    report(thin, block_.grid.position(block_.grid.index(cell)));
  }

  void report(KindIndex kind, const Point& x) {
    if (reported_[static_cast<std::size_t>(kind)]) return;
    reported_[static_cast<std::size_t>(kind)] = true;
    issues_.push_back(too_thin_for_cells(kinds_[static_cast<std::size_t>(kind)], block_.grid, x));
  }

  void report_border(const Point& x) {
    if (border_reported_) return;
    border_reported_ = true;
    issues_.push_back({{},
                       "a surface meets the border of a grid of its own at " + describe_place(x, block_.grid.dimension),
                       "Let shapes with curved or inclined surfaces stay a cell away from such borders"});
  }

  const CellBlock& block_;
  const std::vector<PartKind>& kinds_;
  std::vector<SubDomain>& parts_;
  std::vector<SurfacePiece>& pieces_;
  std::vector<Issue>& issues_;
  std::vector<bool> reported_;
  bool border_reported_ = false;
  std::array<int, 6> border_{};
};

}  // namespace

void share_cut_cells(const CellBlock& block, const Grid& box, const std::vector<PartKind>& kinds,
                     std::vector<SubDomain>& parts, std::vector<SurfacePiece>& pieces, std::vector<Issue>& issues) {
  CellSharer sharer(block, box, kinds, parts, pieces, issues);
  const NearLayers layers = all_layers(block);
  for (const std::size_t cell : block.cut_cells) sharer.share(layers, cell);
  sharer.find_empty_points();
}

}  // namespace peritherm
