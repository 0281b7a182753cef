#include "peritherm/discretisation/tip_spreader.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "peritherm/discretisation/tip_patch.hpp"

namespace peritherm {
namespace {

/// At least this much of a bond's conductance is left beside a tip.
constexpr double least_left = 0.1;
/// Spacings by which places within a cell are told apart, so that those of a tip on its way repeat. Well below the
/// distance at which points lie on a crack.
constexpr double finest_place = 1e-10;

struct Tip {
  GridIndex base;
  TipPlace place;
  double shift, strength;
};

class TipSpreader {
 public:
  TipSpreader(const Body& body, const Stencil& stencil, const FacePoints& points,
              std::vector<std::vector<double>>& shares)
      : body_(body), stencil_(stencil), points_(points), table_(stencil), shares_(shares) {}

  void add(const Tip& tip, const std::vector<TipChange>& changes) {
    for (const TipChange& change : changes) {
      const GridIndex& offset = stencil_.entries[static_cast<std::size_t>(change.entry)].offset;
      const GridIndex p{tip.base[0] + change.point[0], tip.base[1] + change.point[1], 0};
      add_one_way(p, offset, tip.strength * change.change);
      add_one_way({p[0] + offset[0], p[1] + offset[1], 0}, {-offset[0], -offset[1], 0}, tip.strength * change.change);
    }
  }

  /// A wall or another crack may have left less of a bond than the patch knows.
  void apply() {
    for (const auto& [n, changes] : changes_) {
      std::vector<double>& own = shares_[n];
      if (own.empty()) own.assign(stencil_.entries.size(), 1.0);
      for (std::size_t k = 0; k < own.size(); ++k) own[k] = std::max(own[k] + changes[k], least_left * own[k]);
    }
  }

 private:
  /// What happens beyond a wall is what the image of the tip does inside; on the wall it does it too.
  void add_one_way(const GridIndex& p, const GridIndex& offset, double change) {
    const GridIndex folded = body_.fold(p);
    const std::int64_t n = points_.find(folded);
    if (n < 0) return;
    int on_wall = 0;
    GridIndex inside = offset;
    for (int axis = 0; axis < body_.grid.dimension; ++axis) {
      if (folded[axis] != p[axis]) inside[axis] = -offset[axis];
      const bool corners = body_.grid.placement == PointPlacement::boundary;
      if (corners && (p[axis] == 0 || p[axis] == body_.grid.cells[axis])) on_wall |= 1 << axis;
    }
    for (int turned = 0; turned < 8; ++turned) {
      if ((turned & ~on_wall) != 0) continue;
      GridIndex seen = inside;
      for (int axis = 0; axis < 3; ++axis) seen[axis] = (turned >> axis & 1) != 0 ? -inside[axis] : inside[axis];
      change_bond(static_cast<std::size_t>(n), table_[seen], change);
    }
  }

  void change_bond(std::size_t n, int k, double change) {
    std::vector<double>& own = changes_.try_emplace(n, stencil_.entries.size(), 0.0).first->second;
    own[static_cast<std::size_t>(k)] += change;
  }

  const Body& body_;
  const Stencil& stencil_;
  const FacePoints& points_;
  const OffsetTable table_;
  std::vector<std::vector<double>>& shares_;
  std::map<std::size_t, std::vector<double>> changes_;  ///< by all tips, per point and entry
};

/// Tips of images lie outside. In spacings.
bool is_inside(const Grid& grid, const Point& place) {
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double lower = -grid.first_depth();
    if (place[axis] < lower || place[axis] > lower + grid.cells[axis]) return false;
  }
  return true;
}

std::vector<Tip> find_tips(const Body& body, const FacePoints& points, double horizon_ratio) {
  std::vector<Tip> found;
  for (const FacePiece& piece : points.pieces()) {
    for (const FacePiece::Tip& tip : piece.tips()) {
      const bool adjusts = body.cracks[piece.crack()].adjusts_tips() && is_inside(body.grid, tip.place);
      if (!adjusts || piece.strength() == 0.0) continue;
      // The patch knows one tip only.
      const double horizons = body.cracks[piece.crack()].full_length() / (horizon_ratio * body.grid.spacing);
      Tip one{{}, {}, piece.shift(), piece.strength() * std::clamp(horizons - 1.0, 0.0, 1.0)};
      std::array<double, 2> within{};
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double place = finest_place * std::round(tip.place[axis] / finest_place);
        one.base[axis] = static_cast<int>(std::floor(place));
        within[axis] = finest_place * std::round((place - one.base[axis]) / finest_place);
      }
      one.place = {within[0], within[1], std::atan2(tip.direction[1], tip.direction[0]), tip.at_end};
      found.push_back(one);
    }
  }
  return found;
}

}  // namespace

void adjust_tips(const Body& body, const Stencil& stencil, const FacePoints& points, double horizon_ratio,
                 std::vector<std::vector<double>>& shares) {
  const std::vector<Tip> tips = find_tips(body, points, horizon_ratio);
  std::vector<std::vector<TipChange>> changes(tips.size());
  const auto count = static_cast<std::int64_t>(tips.size());
#pragma omp parallel for schedule(dynamic) if (count > 1)
  for (std::int64_t n = 0; n < count; ++n) {
    const Tip& tip = tips[static_cast<std::size_t>(n)];
    changes[static_cast<std::size_t>(n)] = calibrate_tip(stencil, horizon_ratio, tip.place, tip.shift);
  }
  TipSpreader spreader(body, stencil, points, shares);
  for (std::size_t n = 0; n < tips.size(); ++n) spreader.add(tips[n], changes[n]);
  spreader.apply();
}

}  // namespace peritherm
