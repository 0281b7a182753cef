#include "peritherm/discretisation/broken_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace peritherm {

BrokenBonds::BrokenBonds(const Grid& grid, int radius, double transmission, std::vector<Break> breaks)
    : grid_(grid), number_of_(radius), transmission_(transmission) {
  std::sort(breaks.begin(), breaks.end(),
            [](const Break& a, const Break& b) { return std::tie(a.point, a.bond) < std::tie(b.point, b.bond); });
  bonds_.reserve(breaks.size());
  times_.reserve(breaks.size());
  for (const Break& one : breaks) {
    if (points_.empty() || points_.back() != one.point) {
      points_.push_back(one.point);
      end_.push_back(bonds_.size());
    }
    bonds_.push_back(one.bond);
    times_.push_back(one.time);
    ++end_.back();
  }
}

std::optional<double> BrokenBonds::Row::find(std::uint32_t bond) const {
  const auto found = std::lower_bound(bonds.begin(), bonds.end(), bond);
  if (found == bonds.end() || *found != bond) return std::nullopt;
  return times[static_cast<std::size_t>(found - bonds.begin())];
}

BrokenBonds::Row BrokenBonds::row(std::size_t point) const {
  const auto found = std::lower_bound(points_.begin(), points_.end(), static_cast<std::int64_t>(point));
  if (found == points_.end() || *found != static_cast<std::int64_t>(point)) return {};
  const auto k = static_cast<std::size_t>(found - points_.begin());
  const std::size_t begin = k == 0 ? 0 : end_[k - 1];
  return {std::span(bonds_).subspan(begin, end_[k] - begin), std::span(times_).subspan(begin, end_[k] - begin)};
}

GridIndex BrokenBonds::index_at(const Point& place) const {
  GridIndex p{};
  for (int axis = 0; axis < grid_.dimension; ++axis) {
    p[axis] = static_cast<int>(std::lround((place[axis] - grid_.origin[axis]) / grid_.spacing - grid_.first_depth()));
  }
  return p;
}

std::optional<double> BrokenBonds::time_of(const Point& from, const Point& to) const {
  if (empty()) return std::nullopt;
  const GridIndex p = index_at(from), q = index_at(to);
  return row(grid_.number(p)).find(number_of({q[0] - p[0], q[1] - p[1], q[2] - p[2]}));
}

std::size_t BrokenBonds::count_times(double from, double to) const {
  std::vector<double> times;
  for (const double time : times_) {
    if (time > from && time < to) times.push_back(time);
  }
  std::sort(times.begin(), times.end());
  return static_cast<std::size_t>(std::unique(times.begin(), times.end()) - times.begin());
}

}  // namespace peritherm
