#include <algorithm>
#include <cmath>

#include "peritherm/geometry/crack.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

using Corners = std::array<Point, 2>;  // lower and upper

Corners box_around(std::initializer_list<Point> points) {
  Corners box{*points.begin(), *points.begin()};
  for (const Point& x : points) {
    for (int axis = 0; axis < 3; ++axis) {
      box[0][axis] = std::min(box[0][axis], x[axis]);
      box[1][axis] = std::max(box[1][axis], x[axis]);
    }
  }
  return box;
}

bool meet(const Corners& a, const Corners& b, double slack) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a[1][axis] < b[0][axis] - slack || a[0][axis] > b[1][axis] + slack) return false;
  }
  return true;
}

int count_for(double extent, double length) { return std::max(1, static_cast<int>(std::ceil(extent / length))); }

/// Shares of the way from a to b between which it lies in a box; empty (first > second) if it never does.
std::array<double, 2> shares_inside(const Point& a, const Point& b, const Corners& box) {
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double run = b[axis] - a[axis];
    if (run == 0.0) {
      if (a[axis] < box[0][axis] || a[axis] > box[1][axis]) last = -1.0;
      continue;
    }
    const double low = (box[0][axis] - a[axis]) / run, high = (box[1][axis] - a[axis]) / run;
    first = std::max(first, std::min(low, high));
    last = std::min(last, std::max(low, high));
  }
  return {first, last};
}

/// Span of a box's corners along a direction, from a point.
std::array<double, 2> span_along(const Corners& box, const Point& from, const Point& direction) {
  std::array<double, 2> span{};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = (box[0][axis] - from[axis]) * direction[axis];
    const double high = (box[1][axis] - from[axis]) * direction[axis];
    span[0] += std::min(low, high);
    span[1] += std::max(low, high);
  }
  return span;
}

}  // namespace

std::vector<int> CrackSurface::parts_in(const Point& lower, const Point& upper) const {
  const Corners box{lower, upper};
  if (!meet({lower_, upper_}, box, 2.0 * tolerance_)) return {};
  if (dimension_ == 1) return parts_;
  std::vector<int> parts;
  for (const int part : parts_) {
    const auto k = static_cast<std::size_t>(part);
    if (dimension_ == 2 && !meet(box_around({points_[k], points_[k + 1]}), box, 2.0 * tolerance_)) continue;
    const auto heights = span_along(box, points_[k], normal_of(part));
    if (heights[0] <= 2.0 * tolerance_ && heights[1] >= -2.0 * tolerance_) parts.push_back(part);
  }
  return parts;
}

std::vector<std::array<Point, 2>> CrackSurface::pieces(double length, const Point& lower, const Point& upper) const {
  const Corners box{lower, upper};
  if (!meet(bounds(), box, 0.0)) return {};
  if (dimension_ == 1) return {bounds()};
  return dimension_ == 2 ? segment_pieces(length, box) : plane_pieces(length, box);
}

std::vector<std::array<Point, 2>> CrackSurface::segment_pieces(double length, const std::array<Point, 2>& box) const {
  std::vector<Corners> boxes;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const auto [first, last] = shares_inside(points_[k], points_[k + 1], box);
    if (first > last) continue;
    const int count = count_for((last - first) * (arc_[k + 1] - arc_[k]), length);
    const double step = (last - first) / count;
    for (int n = 0; n < count; ++n) {
      boxes.push_back(box_around({between(points_[k], points_[k + 1], first + n * step),
                                  between(points_[k], points_[k + 1], first + (n + 1) * step)}));
    }
  }
  return boxes;
}

/// Squares in the plane of the crack, over the rectangle around what of it may lie in the box.
std::vector<std::array<Point, 2>> CrackSurface::plane_pieces(double length, const std::array<Point, 2>& box) const {
  std::array<double, 2> low{-radius_, -radius_}, high{radius_, radius_};
  for (const auto& corner : plane_corners_) {
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], corner[k]);
      high[k] = std::max(high[k], corner[k]);
    }
  }
  std::array<int, 2> counts{};
  for (int k = 0; k < 2; ++k) {
    const auto span = span_along(box, points_[0], k == 0 ? along_ : across_);
    low[k] = std::max(low[k], span[0]);
    high[k] = std::max(low[k], std::min(high[k], span[1]));
    counts[k] = count_for(high[k] - low[k], length);
  }
  const auto at = [&](int n, int m) {
    const double along = low[0] + (high[0] - low[0]) * n / counts[0];
    const double across = low[1] + (high[1] - low[1]) * m / counts[1];
    Point x;
    for (int axis = 0; axis < 3; ++axis) x[axis] = points_[0][axis] + along * along_[axis] + across * across_[axis];
    return x;
  };
  std::vector<Corners> boxes;
  for (int n = 0; n < counts[0]; ++n) {
    for (int m = 0; m < counts[1]; ++m) {
      const Corners square = box_around({at(n, m), at(n + 1, m), at(n, m + 1), at(n + 1, m + 1)});
      if (meet(square, box, 0.0)) boxes.push_back(square);
    }
  }
  return boxes;
}

}  // namespace peritherm
