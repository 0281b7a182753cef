#include "peritherm/two_field/place_numbers.hpp"

#include <algorithm>

namespace peritherm {

PlaceNumbers::PlaceNumbers(const std::vector<GridIndex>& places, int margin) {
  lower_ = upper_ = places.front();
  for (const GridIndex& place : places) {
    for (int axis = 0; axis < 3; ++axis) {
      lower_[axis] = std::min(lower_[axis], place[axis]);
      upper_[axis] = std::max(upper_[axis], place[axis]);
    }
  }
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (upper_[axis] > lower_[axis]) {
      lower_[axis] -= margin;
      upper_[axis] += margin;
    }
    strides_[axis] = static_cast<std::ptrdiff_t>(count);
    count *= static_cast<std::size_t>(upper_[axis] - lower_[axis] + 1);
  }
  numbers_.assign(count, -1);
  for (std::size_t i = 0; i < places.size(); ++i) numbers_[entry(places[i])] = static_cast<PointIndex>(i);
}

}  // namespace peritherm
