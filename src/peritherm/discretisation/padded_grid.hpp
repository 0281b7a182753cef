#pragma once

#include <algorithm>

#include "peritherm/discretisation/grid.hpp"

namespace peritherm {

/// How a field of a grid lies in memory: the points, and `padding` fictitious points beyond each face of the used
/// axes. Behind the last entry there is room that kernels may read and never use.
class PaddedGrid {
 public:
  PaddedGrid(const Grid& grid, int padding) : grid_(grid) {
    for (int axis = 0; axis < 3; ++axis) {
      padding_[axis] = axis < grid.dimension ? padding : 0;
      extent_[axis] = grid.count(axis) + 2 * padding_[axis];
    }
    std::size_t row = static_cast<std::size_t>(extent_[0] + 7) / 8 * 8;
    // Rows a multiple of a page apart would all compete for the same cache sets.
    if (row % 512 == 0) row += 8;
    stride_ = {1, row, row * static_cast<std::size_t>(extent_[1])};
    used_ = stride_[2] * static_cast<std::size_t>(extent_[2]);
    first_ = padding_[0] + padding_[1] * stride_[1] + padding_[2] * stride_[2];
  }

  const Grid& grid() const { return grid_; }
  int padding(int axis) const { return padding_[axis]; }
  std::size_t stride(int axis) const { return stride_[axis]; }

  /// Entries of a field, the readable room behind included.
  std::size_t size() const { return used_ + (grid_.dimension > 1 ? 16 * stride_[1] : 0) + 64; }

  /// Entry of a point; indices may lie up to `padding` outside the grid.
  std::size_t entry(const GridIndex& p) const {
    return first_ +
           static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p[0]) + p[1] * static_cast<std::ptrdiff_t>(stride_[1]) +
                                    p[2] * static_cast<std::ptrdiff_t>(stride_[2]));
  }
  std::ptrdiff_t distance(const GridIndex& offset) const {
    return offset[0] + offset[1] * static_cast<std::ptrdiff_t>(stride_[1]) +
           offset[2] * static_cast<std::ptrdiff_t>(stride_[2]);
  }
  /// The point of an entry; outside the grid for fictitious ones.
  GridIndex index(std::size_t entry) const {
    const std::size_t z = entry / stride_[2];
    const std::size_t y = entry % stride_[2] / stride_[1];
    const std::size_t x = entry % stride_[1];
    return {static_cast<int>(x) - padding_[0], static_cast<int>(y) - padding_[1], static_cast<int>(z) - padding_[2]};
  }

  /// Copies the points out of a padded field, x fastest.
  void gather(ConstField padded, Field points) const {
    for_rows([&](std::size_t entry, std::size_t number, std::size_t length) {
      std::copy_n(padded.begin() + static_cast<std::ptrdiff_t>(entry), length,
                  points.begin() + static_cast<std::ptrdiff_t>(number));
    });
  }

  /// Calls visit(first entry, first point number, length) for each row of points.
  template <class Visit>
  void for_rows(Visit&& visit) const {
    const auto length = static_cast<std::size_t>(grid_.count(0));
    std::size_t number = 0;
    for (int z = 0; z < grid_.count(2); ++z) {
      for (int y = 0; y < grid_.count(1); ++y, number += length) visit(entry({0, y, z}), number, length);
    }
  }

 private:
  Grid grid_;
  GridIndex padding_{};
  GridIndex extent_{};
  std::array<std::size_t, 3> stride_{};
  std::size_t used_ = 0;
  std::size_t first_ = 0;
};

}  // namespace peritherm
