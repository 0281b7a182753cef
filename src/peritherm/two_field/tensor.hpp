#pragma once

#include <array>
#include <cmath>

#include "peritherm/base/field.hpp"

namespace peritherm {

using Tensor = std::array<Point, 3>;  ///< symmetric; rows and columns of unused directions are 0

inline double trace(const Tensor& tensor) { return tensor[0][0] + tensor[1][1] + tensor[2][2]; }

inline Point product(const Tensor& tensor, const Point& vector) {
  Point result{};
  for (int a = 0; a < 3; ++a) {
    result[a] = tensor[a][0] * vector[0] + tensor[a][1] * vector[1] + tensor[a][2] * vector[2];
  }
  return result;
}

inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The same conductivity in every direction.
inline Tensor isotropic_tensor(int dimension, double value) {
  Tensor result{};
  for (int axis = 0; axis < dimension; ++axis) result[axis][axis] = value;
  return result;
}

}  // namespace peritherm
