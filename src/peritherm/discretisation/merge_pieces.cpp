#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "peritherm/discretisation/surface_pieces.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// Least extent of a piece that is not along cells, in spacings. With linear traces on both sides the multipliers of
/// held temperatures on a disc are off by 2, 0.3 and 0.01 of the largest flux with 0.7, 1 and 1.4: rows much nearer to
/// each other than points are nearly dependent.
constexpr double least_extent = 1.4;
/// A piece of nearly the least extent may stay if it would become larger than this with any neighbour.
constexpr double largest_extent = 3.6;
/// Least size of a piece of a face of the box, in faces of cells.
constexpr double least_face_share = 0.7;
/// Below this size direction does not matter.
constexpr double sliver = 0.1;
/// Least cosine between the directions of pieces that merge.
constexpr double like_direction = 0.7;

class PieceMerger {
 public:
  PieceMerger(const Grid& grid, std::size_t begin, std::vector<SurfacePiece>& pieces)
      : grid_(grid),
        face_(grid.cell_volume() / grid.spacing),
        begin_(begin),
        pieces_(pieces),
        gone_(pieces.size(), false) {
    const auto by_cell = [](const SurfacePiece& a, const SurfacePiece& b) { return a.cell < b.cell; };
    std::stable_sort(pieces_.begin() + static_cast<std::ptrdiff_t>(begin_), pieces_.end(), by_cell);
  }

  void merge() {
    while (merge_once()) {
    }
    std::size_t kept = begin_;
    for (std::size_t p = begin_; p < pieces_.size(); ++p) {
      if (!gone_[p] && length(pieces_[p].area) > 0.0) pieces_[kept++] = pieces_[p];
    }
    pieces_.resize(kept);
  }

 private:
  /// Area of a piece of this extent.
  double area_of_extent(double extent) const { return face_ * std::pow(extent, grid_.dimension - 1); }

  bool is_small(const SurfacePiece& piece) const {
    return length(piece.area) < (piece.movable ? area_of_extent(least_extent) : least_face_share * face_);
  }

  /// One pass from the smallest to the largest; was any merged?
  bool merge_once() {
    std::vector<std::size_t> small;
    for (std::size_t p = begin_; p < pieces_.size(); ++p) {
      if (!gone_[p] && is_small(pieces_[p])) small.push_back(p);
    }
    std::stable_sort(small.begin(), small.end(), [&](std::size_t a, std::size_t b) {
      return dot(pieces_[a].area, pieces_[a].area) < dot(pieces_[b].area, pieces_[b].area);
    });
    bool merged = false;
    for (const std::size_t p : small) {
      if (gone_[p] || !is_small(pieces_[p])) continue;
      std::optional<std::size_t> other = find_partner(p, like_direction);
      if (!other && length(pieces_[p].area) < sliver * face_) other = find_partner(p, -2.0);
      if (!other) continue;
      absorb(*other, p);
      merged = true;
    }
    return merged;
  }

  void absorb(std::size_t into, std::size_t from) {
    SurfacePiece& target = pieces_[into];
    const SurfacePiece& source = pieces_[from];
    const double size = length(source.area);
    const double whole = size + length(target.area);
    target.position = between(target.position, source.position, whole > 0.0 ? size / whole : 0.0);
    target.area = added(target.area, source.area);
    target.movable = target.movable || source.movable;
    gone_[from] = true;
  }

  /// A near and small piece between the same parts, at most two cells away.
  std::optional<std::size_t> find_partner(std::size_t p, double least_cosine) const {
    std::optional<std::size_t> partner;
    const SurfacePiece& mine = pieces_[p];
    const double size = length(mine.area);
    const bool may_stay = mine.movable && size >= area_of_extent(0.9 * least_extent);
    for (int reach = 1; reach <= 2 && !partner; ++reach) {
      double best = std::numeric_limits<double>::infinity();
      for_each_near(p, reach, [&](std::size_t q) {
        const SurfacePiece& other = pieces_[q];
        if (q == p || gone_[q]) return;
        if (other.first != mine.first || other.second != mine.second || other.face != mine.face) return;
        const double other_size = length(other.area);
        if (dot(other.area, mine.area) < least_cosine * other_size * size) return;
        if (may_stay && size + other_size > area_of_extent(largest_extent)) return;
        const Point arm = difference(other.position, mine.position);
        const double score = dot(arm, arm) * (size + other_size);
        if (score >= best) return;
        best = score;
        partner = q;
      });
    }
    return partner;
  }

  template <class Visit>
  void for_each_near(std::size_t p, int reach, const Visit& visit) const {
    const GridIndex place = grid_.index(pieces_[p].cell);
    const auto low = [&](int axis) { return std::max(place[axis] - (axis < grid_.dimension ? reach : 0), 0); };
    const auto high = [&](int axis) {
      return std::min(place[axis] + (axis < grid_.dimension ? reach : 0), grid_.cells[axis] - 1);
    };
    for (int z = low(2); z <= high(2); ++z) {
      for (int y = low(1); y <= high(1); ++y) {
        const std::size_t from = grid_.number({low(0), y, z}), to = grid_.number({high(0), y, z});
        auto piece = std::lower_bound(pieces_.begin() + static_cast<std::ptrdiff_t>(begin_), pieces_.end(), from,
                                      [](const SurfacePiece& a, std::size_t cell) { return a.cell < cell; });
        for (; piece != pieces_.end() && piece->cell <= to; ++piece) {
          visit(static_cast<std::size_t>(piece - pieces_.begin()));
        }
      }
    }
  }

  const Grid& grid_;
  double face_;  ///< area of a face of a cell [m²]
  std::size_t begin_;
  std::vector<SurfacePiece>& pieces_;
  std::vector<bool> gone_;
};

}  // namespace

void merge_small_pieces(const Grid& grid, std::size_t begin, std::vector<SurfacePiece>& pieces) {
  PieceMerger(grid, begin, pieces).merge();
}

}  // namespace peritherm
