#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "peritherm/discretisation/body.hpp"

namespace peritherm {

/// A box of neighbouring points of a grid.
struct PointBlock {
  GridIndex low, high;   ///< [low, high)
  Point centre;          ///< [m]
  double half_diagonal;  ///< no point of the block is farther from the centre; a little more [m]
};

/// Boxes that cover a grid; a question about shapes is asked for each of them first, and for points only where needed.
class PointBlocks {
 public:
  explicit PointBlocks(const Grid& grid) : grid_(grid) {
    constexpr int widths[] = {512, 32, 16};
    for (int axis = 0; axis < 3; ++axis) {
      width_[axis] = axis < grid.dimension ? widths[grid.dimension - 1] : 1;
      counts_[axis] = (grid.count(axis) + width_[axis] - 1) / width_[axis];
    }
  }

  std::int64_t size() const { return static_cast<std::int64_t>(counts_[0]) * counts_[1] * counts_[2]; }

  PointBlock operator[](std::int64_t number) const {
    PointBlock block;
    const std::int64_t place[] = {number % counts_[0], number / counts_[0] % counts_[1],
                                  number / counts_[0] / counts_[1]};
    for (int axis = 0; axis < 3; ++axis) {
      block.low[axis] = static_cast<int>(place[axis]) * width_[axis];
      block.high[axis] = std::min(block.low[axis] + width_[axis], grid_.count(axis));
    }
    const Point first = grid_.position(block.low);
    const Point last = grid_.position({block.high[0] - 1, block.high[1] - 1, block.high[2] - 1});
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      block.centre[axis] = 0.5 * (first[axis] + last[axis]);
      square += (last[axis] - first[axis]) * (last[axis] - first[axis]);
    }
    block.half_diagonal = 0.5 * (1.0 + 1e-6) * std::sqrt(square) + 1e-6 * grid_.spacing;
    return block;
  }

 private:
  Grid grid_;
  GridIndex width_{}, counts_{};
};

inline bool any_surface_within(std::span<const MaterialRegion> regions, const Point& x, double distance) {
  return std::any_of(regions.begin(), regions.end(),
                     [&](const MaterialRegion& region) { return surface_within(region.shape, x, distance); });
}

}  // namespace peritherm
