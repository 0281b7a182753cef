#include <algorithm>
#include <cmath>

#include "peritherm/geometry/crack.hpp"

namespace peritherm {
namespace {

std::array<Point, 2> box_around(std::initializer_list<Point> points) {
  std::array<Point, 2> box{*points.begin(), *points.begin()};
  for (const Point& x : points) {
    for (int axis = 0; axis < 3; ++axis) {
      box[0][axis] = std::min(box[0][axis], x[axis]);
      box[1][axis] = std::max(box[1][axis], x[axis]);
    }
  }
  return box;
}

int count_for(double extent, double length) { return std::max(1, static_cast<int>(std::ceil(extent / length))); }

}  // namespace

std::vector<std::array<Point, 2>> CrackSurface::pieces(double length) const {
  if (dimension_ == 1) return {bounds()};
  std::vector<std::array<Point, 2>> boxes;
  if (dimension_ == 2) {
    for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
      const int count = count_for(arc_[k + 1] - arc_[k], length);
      const auto at = [&](int n) {
        const double way = static_cast<double>(n) / count;
        return Point{points_[k][0] + way * (points_[k + 1][0] - points_[k][0]),
                     points_[k][1] + way * (points_[k + 1][1] - points_[k][1]), 0.0};
      };
      for (int n = 0; n < count; ++n) boxes.push_back(box_around({at(n), at(n + 1)}));
    }
    return boxes;
  }
  // Squares in the plane of the crack over its bounding rectangle there.
  std::array<double, 2> low{-radius_, -radius_}, high{radius_, radius_};
  for (const auto& corner : plane_corners_) {
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], corner[k]);
      high[k] = std::max(high[k], corner[k]);
    }
  }
  const int count_along = count_for(high[0] - low[0], length);
  const int count_across = count_for(high[1] - low[1], length);
  const auto at = [&](int n, int m) {
    const double along = low[0] + (high[0] - low[0]) * n / count_along;
    const double across = low[1] + (high[1] - low[1]) * m / count_across;
    Point x;
    for (int axis = 0; axis < 3; ++axis) x[axis] = points_[0][axis] + along * along_[axis] + across * across_[axis];
    return x;
  };
  for (int n = 0; n < count_along; ++n) {
    for (int m = 0; m < count_across; ++m) {
      boxes.push_back(box_around({at(n, m), at(n + 1, m), at(n, m + 1), at(n + 1, m + 1)}));
    }
  }
  return boxes;
}

}  // namespace peritherm
