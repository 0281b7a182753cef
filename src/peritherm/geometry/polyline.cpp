#include "peritherm/geometry/polyline.hpp"

#include "peritherm/geometry/plane_polygon.hpp"

namespace peritherm {
namespace {

/// Marks the corners between two others that are needed.
void keep_corners(const std::vector<Point>& corners, std::size_t first, std::size_t last, double distance,
                  std::vector<bool>& kept) {
  double largest = distance;
  std::size_t farthest = first;
  for (std::size_t k = first + 1; k < last; ++k) {
    const double beside = distance_from_edge(corners[first], corners[last], corners[k][0], corners[k][1]);
    if (beside <= largest) continue;
    largest = beside;
    farthest = k;
  }
  if (farthest == first) return;
  kept[farthest] = true;
  keep_corners(corners, first, farthest, distance, kept);
  keep_corners(corners, farthest, last, distance, kept);
}

}  // namespace

std::vector<Point> simplified(const std::vector<Point>& corners, double distance) {
  std::vector<bool> kept(corners.size(), false);
  kept.front() = kept.back() = true;
  keep_corners(corners, 0, corners.size() - 1, distance, kept);
  std::vector<Point> needed;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (kept[k]) needed.push_back(corners[k]);
  }
  return needed;
}

}  // namespace peritherm
