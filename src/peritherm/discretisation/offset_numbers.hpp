#pragma once

#include <cstdint>

#include "peritherm/base/field.hpp"

namespace peritherm {

/// Numbers the offsets between points up to so many spacings along each axis; numbers ascend as offsets do in a
/// stencil.
class OffsetNumbers {
 public:
  explicit OffsetNumbers(int radius = 0) : radius_(radius), width_(2 * radius + 1) {}
  bool contains(const GridIndex& offset) const {
    for (const int step : offset) {
      if (step < -radius_ || step > radius_) return false;
    }
    return true;
  }
  std::uint32_t operator()(const GridIndex& offset) const {
    return static_cast<std::uint32_t>(offset[0] + radius_ +
                                      width_ * (offset[1] + radius_ + width_ * (offset[2] + radius_)));
  }
  std::size_t count() const { return static_cast<std::size_t>(width_) * width_ * width_; }

 private:
  int radius_, width_;
};

}  // namespace peritherm
