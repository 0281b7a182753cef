#include "peritherm/discretisation/mirrored_faces.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/face_history.hpp"

namespace peritherm {

MirroredFaces::MirroredFaces(int radius, const std::vector<PointBonds>& points, std::vector<std::int64_t> cut_points,
                             double lowest_share)
    : number_of_(radius), cut_points_(std::move(cut_points)), lowest_(lowest_share) {
  for (const PointBonds& own : points) {
    points_.push_back(own.point);
    volumes_.push_back(own.volume);
    for (const Bond& bond : own.bonds) {
      bonds_.push_back(bond.number);
      shares_.push_back(bond.share);
      highest_ = std::max(highest_, bond.share);
      for (const ShareKnot& knot : bond.later) highest_ = std::max(highest_, knot.share);
      knots_.insert(knots_.end(), bond.later.begin(), bond.later.end());
      knot_end_.push_back(knots_.size());
    }
    end_.push_back(bonds_.size());
  }
}

std::optional<double> MirroredFaces::Row::find(std::uint32_t bond) const {
  const auto found = std::lower_bound(bonds.begin(), bonds.end(), bond);
  if (found == bonds.end() || *found != bond) return std::nullopt;
  return shares[static_cast<std::size_t>(found - bonds.begin())];
}

/// Place among the points concerned; −1: none of them.
std::ptrdiff_t MirroredFaces::find(std::size_t point) const {
  const auto found = std::lower_bound(points_.begin(), points_.end(), static_cast<std::int64_t>(point));
  return found == points_.end() || *found != static_cast<std::int64_t>(point) ? -1 : found - points_.begin();
}

MirroredFaces::Row MirroredFaces::row(std::size_t point) const {
  const std::ptrdiff_t n = find(point);
  if (n < 0) return {};
  const std::size_t begin = n == 0 ? 0 : end_[static_cast<std::size_t>(n - 1)];
  const std::size_t count = end_[static_cast<std::size_t>(n)] - begin;
  return {std::span(bonds_).subspan(begin, count), std::span(shares_).subspan(begin, count)};
}

double MirroredFaces::volume(std::size_t point) const {
  const std::ptrdiff_t n = find(point);
  return n < 0 ? 1.0 : volumes_[static_cast<std::size_t>(n)];
}

void MirroredFaces::look_up(const Grid& grid, const Point& from, const Point& to, double& share,
                            std::vector<ShareKnot>& later) const {
  GridIndex p{}, offset{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    p[axis] = static_cast<int>(std::lround((from[axis] - grid.origin[axis]) / grid.spacing - grid.first_depth()));
    offset[axis] = static_cast<int>(std::lround((to[axis] - from[axis]) / grid.spacing));
  }
  share = 1.0;
  later.clear();
  const std::ptrdiff_t n = find(grid.number(p));
  if (n < 0) return;
  const double volume = volumes_[static_cast<std::size_t>(n)];
  share /= volume;
  const std::uint32_t* const begin = bonds_.data() + (n == 0 ? 0 : end_[static_cast<std::size_t>(n - 1)]);
  const std::uint32_t* const end = bonds_.data() + end_[static_cast<std::size_t>(n)];
  const std::uint32_t* const found = std::lower_bound(begin, end, number_of(offset));
  if (found == end || *found != number_of(offset)) return;
  const auto bond = static_cast<std::size_t>(found - bonds_.data());
  share = shares_[bond] / volume;
  for (std::size_t k = bond == 0 ? 0 : knot_end_[bond - 1]; k < knot_end_[bond]; ++k) {
    later.push_back({knots_[k].time, knots_[k].share / volume});
  }
}

MirroredFaces mirror_faces(const Body& body, const Stencil& stencil, double horizon_ratio,
                           std::span<const double> shifts, double end) {
  return FaceHistory({body, stencil, horizon_ratio, shifts}, end).take();
}

}  // namespace peritherm
