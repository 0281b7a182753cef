#pragma once

#include <array>
#include <cmath>

#include "peritherm/base/field.hpp"
#include "peritherm/geometry/vector.hpp"

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

struct InvertedTensor {
  Tensor inverse{};
  bool is_singular = true;  ///< to working accuracy; then the inverse is 0
};
/// Of the part within the first directions.
inline InvertedTensor invert(Tensor tensor, int dimension) {
  const double size = trace(tensor);
  for (int axis = dimension; axis < 3; ++axis) tensor[axis][axis] = size;
  const auto cofactor = [&](int a, int b) {
    const int r = (a + 1) % 3, s = (a + 2) % 3, t = (b + 1) % 3, u = (b + 2) % 3;
    return tensor[r][t] * tensor[s][u] - tensor[r][u] * tensor[s][t];
  };
  const double determinant =
      tensor[0][0] * cofactor(0, 0) + tensor[0][1] * cofactor(0, 1) + tensor[0][2] * cofactor(0, 2);
  constexpr double least_determinant = 1e-6;  // Of trace 1. Points in a row or a plane have 0.
  InvertedTensor result;
  result.is_singular = !(determinant > least_determinant * size * size * size);
  if (result.is_singular) return result;
  for (int a = 0; a < dimension; ++a) {
    for (int b = 0; b < dimension; ++b) result.inverse[a][b] = cofactor(b, a) / determinant;
  }
  return result;
}

/// The same conductivity in every direction.
inline Tensor isotropic_tensor(int dimension, double value) {
  Tensor result{};
  for (int axis = 0; axis < dimension; ++axis) result[axis][axis] = value;
  return result;
}

}  // namespace peritherm
