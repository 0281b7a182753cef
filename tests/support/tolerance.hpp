#pragma once

#include <cstddef>
#include <limits>

namespace peritherm {

/// What a sum of n terms of this size may lose to rounding: 8 ε n scale.
inline double rounding(std::size_t n, double scale) {
  return 8.0 * std::numeric_limits<double>::epsilon() * static_cast<double>(n) * scale;
}

}  // namespace peritherm
