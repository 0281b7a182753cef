#pragma once

#include <vector>

#include "peritherm/discretisation/grid.hpp"

namespace peritherm {

/// Numbers of the points of a lattice by their places, with a margin of empty places around them.
class PlaceNumbers {
 public:
  PlaceNumbers(const std::vector<GridIndex>& places, int margin);

  /// −1 where no point stands, and everywhere beyond the margin.
  PointIndex at(const GridIndex& place) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (place[axis] < lower_[axis] || place[axis] > upper_[axis]) return -1;
    }
    return numbers_[entry(place)];
  }
  /// `offset` from the place of a point must be within the margin.
  PointIndex at(const GridIndex& place, const GridIndex& offset) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (upper_[axis] == lower_[axis] && offset[axis] != 0) return -1;
    }
    return numbers_[entry({place[0] + offset[0], place[1] + offset[1], place[2] + offset[2]})];
  }

 private:
  std::size_t entry(const GridIndex& place) const {
    std::ptrdiff_t sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += (place[axis] - lower_[axis]) * strides_[axis];
    return static_cast<std::size_t>(sum);
  }

  GridIndex lower_{}, upper_{};
  std::array<std::ptrdiff_t, 3> strides_{};
  std::vector<PointIndex> numbers_;
};

}  // namespace peritherm
