#include "peritherm/output/material_jumps.hpp"

#include <cmath>

namespace peritherm {

std::pair<Point, Point> find_change(const MaterialJumps& jumps, const Point& from, const Point& to) {
  constexpr int halvings = 40;  // To a share of 1e-12 of the way.
  const MaterialIndex material = jumps.material_at(from);
  const auto on_way = [&](double share) {
    return Point{std::lerp(from[0], to[0], share), std::lerp(from[1], to[1], share), std::lerp(from[2], to[2], share)};
  };
  double low = 0.0, high = 1.0;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (jumps.material_at(on_way(middle)) == material ? low : high) = middle;
  }
  return {on_way(low), on_way(high)};
}

}  // namespace peritherm
