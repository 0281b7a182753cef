#include "peritherm/discretisation/face_system.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

/// Share with which bonds to points that have no row of their own may change: their far ends are not watched.
constexpr double unwatched_weight = 0.05;
constexpr double elastic_share = 1e-4;
/// Heat across a gap is the same in every row that it crosses; second moments beside it give way first.
constexpr double elastic_share_of_jumps = 1e-8;

}  // namespace

FaceMoments FaceFrame::operator()(const Point& step, const Point& jumps) const {
  FaceMoments m{};
  const double across = dot(step, normal);
  std::size_t c = 0;
  if (dimension > 1) m[c++] = dot(step, tangents[0]);
  if (dimension > 2) m[c++] = dot(step, tangents[1]);
  if (dimension > 1) m[c++] = m[0] * m[0];
  if (dimension > 2) m[c++] = m[1] * m[1];
  if (dimension > 2) m[c++] = m[0] * m[1];
  m[c++] = across * (across + 2.0 * height);
  if (jump > 0.0) m[c] = across + dot(jumps, normal);
  for (int axis = 0; axis + 1 < dimension; ++axis) m[axis] += dot(jumps, tangents[axis]);
  return m;
}

FaceSystem::FaceSystem(const Body& body, const Stencil& stencil, const FacePoints& points)
    : stencil_(stencil), points_(points), table_(stencil), classes_(body, stencil, table_) {
  double second_moment = 0.0;
  for (const auto& [offset, conductance] : stencil.entries) second_moment += conductance * offset[0] * offset[0];
  for (const auto& [offset, conductance] : stencil.entries) weights_.push_back(2.0 * conductance / second_moment);
  const auto& pieces = points.pieces();
  exchanges_ = std::any_of(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.jump(1.0) > 0.0; });
  moments_ = FaceFrame{.dimension = body.grid.dimension}.count() + (exchanges_ ? 1 : 0);
  for (std::size_t n = 0; n < points.points().size(); ++n) {
    if (points.points()[n].has_row) add_row(body, n);
  }
  find_members();
  scale_rows();
  scale_members();
}

double FaceSystem::weight(std::size_t e) const {
  return strength_[e] * weights_[static_cast<std::size_t>(members_[member_begin_[e]].entry)];
}

FaceMoments FaceSystem::moments_of(const Row& row, int entry) const {
  const GridIndex& offset = stencil_.entries[static_cast<std::size_t>(entry)].offset;
  return row.frame(in_spacings(offset), points_.points()[row.point].jump(static_cast<std::size_t>(entry)));
}

void FaceSystem::scale_members() {
  for (const Member& member : members_) {
    FaceMoments m = moments_of(rows_[member.row], member.entry);
    for (std::size_t c = 0; c < moments(); ++c) {
      const double scale = scale_[member.row * moments() + c];
      m[c] = scale > 0.0 ? m[c] / scale : 0.0;
    }
    scaled_.push_back(m);
  }
}

void FaceSystem::gather(const std::vector<double>& lambda, std::vector<double>& result) const {
  result.resize(class_count());
  const auto count = static_cast<std::int64_t>(class_count());
#pragma omp parallel for schedule(static) if (count > 4096)
  for (std::int64_t number = 0; number < count; ++number) {
    const auto e = static_cast<std::size_t>(number);
    double sum = 0.0;
    for (const Member& member : members(e)) {
      const FaceMoments& m = scaled_moments(member);
      const double* const own = lambda.data() + member.row * moments();
      for (std::size_t c = 0; c < moments(); ++c) sum += own[c] * m[c];
    }
    result[e] = sum / times_[e];
  }
}

void FaceSystem::scatter(const std::vector<double>& values, std::vector<double>& result) const {
  result.resize(target_.size());
  const auto count = static_cast<std::int64_t>(rows_.size());
#pragma omp parallel for schedule(static) if (count > 1024)
  for (std::int64_t row = 0; row < count; ++row) {
    const auto r = static_cast<std::size_t>(row);
    FaceMoments sum{};
    for (std::size_t b = rows_[r].begin; b < row_end(r); ++b) {
      const FaceMoments m = moments_of(rows_[r], bonds_[b].entry);
      const double value = values[static_cast<std::size_t>(bonds_[b].number)];
      for (std::size_t c = 0; c < moments(); ++c) sum[c] += value * m[c];
    }
    for (std::size_t c = 0; c < moments(); ++c) {
      const std::size_t n = r * moments() + c;
      result[n] = scale_[n] > 0.0 ? sum[c] / scale_[n] : 0.0;
    }
  }
}

void FaceSystem::add_row(const Body& body, std::size_t n) {
  const FacePoint& point = points_.points()[n];
  const FacePiece& piece = points_.pieces()[static_cast<std::size_t>(point.frame)];
  Row row{n,
          {body.grid.dimension, piece.normal(), piece.tangents(), piece.height(point.place),
           piece.jump(point.conductivity)},
          bonds_.size(),
          body.grid.volume_share(point.index)};
  FaceMoments target{};
  for (int c = 0; c < moments_; ++c) target[c] = row.frame.is_square(c) ? 2.0 * (point.volume - 1.0) : 0.0;
  const auto aim = [&](double weight, const FaceMoments& moments, int count) {
    for (int c = 0; c < count; ++c) target[c] += weight * moments[c];
  };
  for (std::size_t k = 0; k < stencil_.entries.size(); ++k) {
    const double cut = point.cut_of(k);
    if (cut > 0.0) {
      const Point end = points_.unfolded_end(n, static_cast<int>(k));
      FaceMoments lost = row.frame(difference(end, point.place), Point{});
      if (point.way(k) == Way::exchanges) replace_slopes(row, static_cast<int>(k), cut, lost);
      aim(weights_[k] * cut, lost, point.way(k) == Way::exchanges ? moments_ : row.frame.count());
    }
    if (point.way(k) == Way::parted) continue;
    bonds_.push_back({class_of(n, static_cast<int>(k)), static_cast<std::int32_t>(k)});
  }
  rows_.push_back(row);
  target_.insert(target_.end(), target.begin(), target.begin() + moments_);
}

/// Through gaps that resist one after the other a bond does not pass what belongs to the slope and jumps of each.
void FaceSystem::replace_slopes(const Row& row, int entry, double cut, FaceMoments& lost) const {
  const GridIndex& offset = stencil_.entries[static_cast<std::size_t>(entry)].offset;
  const FaceMoments jumping = moments_of(row, entry), whole = row.frame(in_spacings(offset), Point{});
  const auto replace = [&](int c) { lost[c] = (whole[c] - (1.0 - cut) * jumping[c]) / cut; };
  for (int axis = 0; axis + 1 < row.frame.dimension; ++axis) replace(axis);
  if (row.frame.jump > 0.0) replace(row.frame.count());
}

/// Number of a bond's class; a new one is given its weight.
std::int32_t FaceSystem::class_of(std::size_t n, int k) {
  const FacePoint& point = points_.points()[n];
  const auto [found, is_new] =
      number_of_.try_emplace(classes_.key(point.index, k), static_cast<std::int32_t>(strength_.size()));
  if (!is_new) return found->second;
  const std::int64_t other = points_.find(classes_.reversed(point.index, k).first);
  const FacePoint* const end = other < 0 ? nullptr : &points_.points()[static_cast<std::size_t>(other)];
  const bool watched = (end != nullptr && (end->has_row || end->near_tip)) || point.near_tip;
  base_.push_back(1.0 - point.cut_of(static_cast<std::size_t>(k)));
  // Heat that crosses a gap has a slope at the far ends, where a changed bond would move it.
  const double jump = points_.pieces()[static_cast<std::size_t>(point.frame)].jump(point.conductivity);
  const double unwatched = jump > 0.0 ? 0.0 : unwatched_weight;
  strength_.push_back((watched ? 1.0 : unwatched) * base_.back());
  times_.push_back(classes_.weight(point.index, k));
  return found->second;
}

void FaceSystem::find_members() {
  member_begin_.assign(strength_.size() + 1, 0);
  for (const RowBond& bond : bonds_) ++member_begin_[static_cast<std::size_t>(bond.number) + 1];
  for (std::size_t e = 0; e < strength_.size(); ++e) member_begin_[e + 1] += member_begin_[e];
  members_.resize(bonds_.size());
  std::vector<std::size_t> next(member_begin_.begin(), member_begin_.end() - 1);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t b = rows_[r].begin; b < row_end(r); ++b) {
      members_[next[static_cast<std::size_t>(bonds_[b].number)]++] = {static_cast<std::uint32_t>(r), bonds_[b].entry};
    }
  }
}

void FaceSystem::scale_rows() {
  scale_.assign(target_.size(), 0.0);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    double* const scale = scale_.data() + r * static_cast<std::size_t>(moments_);
    for (std::size_t b = rows_[r].begin; b < row_end(r); ++b) {
      const FaceMoments m = moments_of(rows_[r], bonds_[b].entry);
      const double own = weight(static_cast<std::size_t>(bonds_[b].number));
      for (int c = 0; c < moments_; ++c) scale[c] += own * m[c] * m[c];
    }
    // On a wall half of the bonds are images of the other half.
    for (int c = 0; c < moments_; ++c) scale[c] = std::sqrt(scale[c]) / rows_[r].wall_share;
    for (int c = 0; c < moments_; ++c) {
      elasticity_.push_back((is_jump(elasticity_.size()) ? elastic_share_of_jumps : elastic_share) *
                            rows_[r].wall_share);
    }
  }
  for (std::size_t n = 0; n < target_.size(); ++n) {
    if (scale_[n] < 1e-8) {
      scale_[n] = 0.0;
      target_[n] = 0.0;
    } else {
      target_[n] /= scale_[n];
    }
  }
}

}  // namespace peritherm
