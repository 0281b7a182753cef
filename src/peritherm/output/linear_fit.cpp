#include "peritherm/output/linear_fit.hpp"

namespace peritherm {

void LinearFit::add(const Point& arm, double value) {
  // A point at the place itself decides.
  constexpr double least_square = 1e-6;
  const double square = arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2] + least_square;
  const double weight = 1.0 / (square * square);
  weight_ += weight;
  sum_ += weight * value;
  for (std::size_t a = 0; a < dimension_; ++a) {
    arm_[a] += weight * arm[a];
    mixed_[a] += weight * arm[a] * value;
    for (std::size_t b = 0; b < dimension_; ++b) square_[a][b] += weight * arm[a] * arm[b];
  }
}

double LinearFit::value() const {
  // Slopes about the mean, by elimination of a positive semi-definite matrix.
  constexpr double least_pivot = 1e-6;
  std::array<std::array<double, 4>, 3> rows{};
  Point pivots{};
  for (std::size_t a = 0; a < dimension_; ++a) {
    for (std::size_t b = 0; b < dimension_; ++b) rows[a][b] = square_[a][b] - arm_[a] * arm_[b] / weight_;
    rows[a][3] = mixed_[a] - arm_[a] * sum_ / weight_;
    pivots[a] = least_pivot * square_[a][a];
  }
  for (std::size_t k = 0; k < dimension_; ++k) {
    if (rows[k][k] <= pivots[k]) continue;
    for (std::size_t a = k + 1; a < dimension_; ++a) {
      const double share = rows[a][k] / rows[k][k];
      for (std::size_t b = k; b < 4; ++b) rows[a][b] -= share * rows[k][b];
    }
  }
  Point slope{};
  double value = sum_ / weight_;
  for (std::size_t k = dimension_; k-- > 0;) {
    if (rows[k][k] <= pivots[k]) continue;
    slope[k] = rows[k][3];
    for (std::size_t b = k + 1; b < dimension_; ++b) slope[k] -= rows[k][b] * slope[b];
    slope[k] /= rows[k][k];
    value -= slope[k] * arm_[k] / weight_;
  }
  return value;
}

}  // namespace peritherm
