#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "peritherm/base/field.hpp"

namespace peritherm {

inline bool is_finite(const Coordinates& coordinates) {
  return std::all_of(coordinates.begin(), coordinates.end(), [](double v) { return std::isfinite(v); });
}

/// What is wrong with coordinates in a body of this dimension; empty if nothing is.
inline std::string find_fault(const std::string& name, const Coordinates& coordinates, int dimension) {
  if (static_cast<int>(coordinates.size()) != dimension) {
    return name + " has " + std::to_string(coordinates.size()) + " coordinates. Give " + std::to_string(dimension) +
           ", one per axis";
  }
  return is_finite(coordinates) ? "" : name + " is not finite. Give ordinary numbers";
}

}  // namespace peritherm
