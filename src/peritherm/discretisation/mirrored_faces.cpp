#include "peritherm/discretisation/mirrored_faces.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/face_fit.hpp"
#include "peritherm/discretisation/tip_patch.hpp"

namespace peritherm {
namespace {

/// At least this much of a bond's conductance is left beside a tip.
constexpr double least_left = 0.1;

/// Adds the changes around tips to the shares of the points near faces.
class TipSpreader {
 public:
  TipSpreader(const Body& body, const Stencil& stencil, const FacePoints& points,
              std::vector<std::vector<double>>& shares)
      : body_(body), stencil_(stencil), points_(points), table_(stencil), shares_(shares) {}

  void add(const GridIndex& base, const std::vector<TipChange>& changes, double strength) {
    for (const TipChange& change : changes) {
      const GridIndex& offset = stencil_.entries[static_cast<std::size_t>(change.entry)].offset;
      const GridIndex p{base[0] + change.point[0], base[1] + change.point[1], 0};
      add_one_way(p, offset, strength * change.change);
      add_one_way({p[0] + offset[0], p[1] + offset[1], 0}, {-offset[0], -offset[1], 0}, strength * change.change);
    }
  }

 private:
  /// What happens beyond a wall is what the image of the tip does inside; on the wall it does it too.
  void add_one_way(const GridIndex& p, const GridIndex& offset, double change) {
    const GridIndex folded = body_.fold(p);
    const std::int64_t n = points_.find(folded);
    if (n < 0) return;
    std::vector<double>& own = shares_[static_cast<std::size_t>(n)];
    if (own.empty()) own.assign(stencil_.entries.size(), 1.0);
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
      // A wall or another crack may have left less of the bond than the patch knows.
      double& share = own[static_cast<std::size_t>(table_[seen])];
      share = std::max(share + change, least_left * share);
    }
  }

  const Body& body_;
  const Stencil& stencil_;
  const FacePoints& points_;
  const OffsetTable table_;
  std::vector<std::vector<double>>& shares_;
};

/// Tips of images lie outside. In spacings.
bool is_inside(const Grid& grid, const Point& place) {
  for (int axis = 0; axis < grid.dimension; ++axis) {
    const double lower = -grid.first_depth();
    if (place[axis] < lower || place[axis] > lower + grid.cells[axis]) return false;
  }
  return true;
}

/// The shares of all points near faces, those of bonds that no face changes among them.
std::vector<std::vector<double>> find_shares(const Body& body, const Stencil& stencil, double horizon_ratio,
                                             FacePoints& points, FaceFitReport& report) {
  auto shares = fit_faces(body, stencil, points, report);
  TipSpreader spreader(body, stencil, points, shares);
  for (const FacePiece& piece : points.pieces()) {
    for (const FacePiece::Tip& tip : piece.tips()) {
      const GridIndex base{static_cast<int>(std::floor(tip.place[0])), static_cast<int>(std::floor(tip.place[1])), 0};
      if (!body.cracks[piece.crack()].adjusts_tips() || !is_inside(body.grid, tip.place)) continue;
      const TipPlace place{tip.place[0] - base[0], tip.place[1] - base[1],
                           std::atan2(tip.direction[1], tip.direction[0]), tip.at_end};
      spreader.add(base, calibrate_tip(stencil, horizon_ratio, place, piece.shift()), piece.strength());
    }
  }
  return shares;
}

}  // namespace

std::optional<double> MirroredFaces::Row::find(std::uint32_t bond) const {
  const auto found = std::lower_bound(bonds.begin(), bonds.end(), bond);
  if (found == bonds.end() || *found != bond) return std::nullopt;
  return shares[static_cast<std::size_t>(found - bonds.begin())];
}

std::uint32_t MirroredFaces::number_of(const GridIndex& offset) const {
  const auto width = static_cast<std::uint32_t>(2 * radius_ + 1);
  std::uint32_t number = 0;
  for (int axis = 2; axis >= 0; --axis) number = number * width + static_cast<std::uint32_t>(offset[axis] + radius_);
  return number;
}

MirroredFaces::Row MirroredFaces::row(std::size_t point) const {
  const auto found = std::lower_bound(points_.begin(), points_.end(), static_cast<std::int64_t>(point));
  if (found == points_.end() || *found != static_cast<std::int64_t>(point)) return {};
  const auto n = static_cast<std::size_t>(found - points_.begin());
  const std::size_t begin = n == 0 ? 0 : end_[n - 1];
  return {std::span(bonds_).subspan(begin, end_[n] - begin), std::span(shares_).subspan(begin, end_[n] - begin)};
}

double MirroredFaces::volume(std::size_t point) const {
  const auto found = std::lower_bound(points_.begin(), points_.end(), static_cast<std::int64_t>(point));
  if (found == points_.end() || *found != static_cast<std::int64_t>(point)) return 1.0;
  return volumes_[static_cast<std::size_t>(found - points_.begin())];
}

double MirroredFaces::share_of(const Grid& grid, const Point& from, const Point& to) const {
  GridIndex p{}, offset{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    p[axis] = static_cast<int>(std::lround((from[axis] - grid.origin[axis]) / grid.spacing - grid.first_depth()));
    offset[axis] = static_cast<int>(std::lround((to[axis] - from[axis]) / grid.spacing));
  }
  const std::size_t point = grid.number(p);
  return row(point).find(number_of(offset)).value_or(1.0) / volume(point);
}

MirroredFaces mirror_faces(const Body& body, const Stencil& stencil, double horizon_ratio,
                           std::span<const double> shifts) {
  MirroredFaces faces;
  faces.radius_ = stencil.radius;
  const std::vector<FacePiece> pieces = make_face_pieces(body, shifts, longest_offset(stencil) + 2.0, HUGE_VAL);
  if (pieces.empty()) return faces;
  FacePoints points(body, stencil, pieces, horizon_ratio);
  FaceFitReport report;
  const auto shares = find_shares(body, stencil, horizon_ratio, points, report);
  for (std::size_t n = 0; n < points.points().size(); ++n) {
    const FacePoint& point = points.points()[n];
    if (shares[n].empty() && point.volume == 1.0) continue;
    faces.points_.push_back(static_cast<std::int64_t>(body.grid.number(point.index)));
    faces.volumes_.push_back(point.volume);
    std::vector<std::pair<std::uint32_t, double>> row;
    for (std::size_t k = 0; k < shares[n].size(); ++k) {
      if (shares[n][k] == 1.0) continue;
      row.emplace_back(faces.number_of(stencil.entries[k].offset), shares[n][k]);
      faces.highest_ = std::max(faces.highest_, shares[n][k]);
      if (point.cut.empty() || point.cut[k] == 0.0) faces.lowest_ = std::min(faces.lowest_, shares[n][k]);
    }
    std::sort(row.begin(), row.end());
    for (const auto& [bond, share] : row) {
      faces.bonds_.push_back(bond);
      faces.shares_.push_back(share);
    }
    faces.end_.push_back(faces.bonds_.size());
  }
  for (const std::size_t n : report.cut) {
    faces.cut_points_.push_back(static_cast<std::int64_t>(body.grid.number(points.points()[n].index)));
  }
  return faces;
}

}  // namespace peritherm
