#include "peritherm/physics/covered_cell.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peritherm {
namespace {

constexpr int gauss_points = 16;

struct GaussRule {
  std::array<double, gauss_points> nodes, weights;  ///< on [0, 1]
};

/// Newton's method on Legendre's polynomial.
GaussRule make_gauss_rule() {
  GaussRule rule;
  for (int k = 0; k < gauss_points; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (gauss_points + 0.5));
    double slope = 0.0;
    for (int iteration = 0; iteration < 6; ++iteration) {
      double before = 1.0, value = x;
      for (int n = 2; n <= gauss_points; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
      }
      slope = gauss_points * (x * value - before) / (x * x - 1.0);
      x -= value / slope;
    }
    rule.nodes[k] = 0.5 * (1.0 - x);
    rule.weights[k] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

const GaussRule& gauss_rule() {
  static const GaussRule rule = make_gauss_rule();
  return rule;
}

/// Integrates over a cell inside a ball, axis by axis. Along each axis the inner integral is smooth between the places
/// where the sphere passes a corner of what is left of the cell; there it behaves like a power of the square root.
class CoveredCellIntegral {
 public:
  CoveredCellIntegral(const CellOffset& cell, double radius, int dimension)
      : square_(radius * radius), dimension_(dimension) {
    double nearest = 0.0, farthest = 0.0;
    for (int axis = 0; axis < dimension; ++axis) {
      const int offset = std::abs(cell[axis]);
      // Halves of a cell across a plane of symmetry count twice.
      low_[axis] = std::max(0.0, offset - 0.5);
      high_[axis] = offset + 0.5;
      images_ *= offset == 0 ? 2.0 : 1.0;
      nearest += low_[axis] * low_[axis];
      farthest += high_[axis] * high_[axis];
    }
    // Cells that only touch the sphere, but for rounding, count as on one side of it.
    constexpr double slack = 1e-12;
    outside_ = nearest >= square_ * (1.0 - slack);
    inside_ = farthest <= square_ * (1.0 + slack);
  }

  bool outside() const { return outside_; }
  bool inside() const { return inside_; }

  /// ∫ f(|x|) dV; without f the volume.
  double operator()(const std::function<double(double)>* f) const {
    return outside_ ? 0.0 : images_ * along(f, 0, 0.0);
  }

 private:
  double along(const std::function<double(double)>* f, int axis, double square) const {
    if (axis == dimension_) return (*f)(std::sqrt(square));
    const Pieces pieces = pieces_along(axis, square);
    if (f == nullptr && axis == dimension_ - 1) return pieces.ends[pieces.count] - low_[axis];
    const GaussRule& rule = gauss_rule();
    double sum = 0.0;
    for (int k = 0; k < pieces.count; ++k) {
      const double begin = pieces.ends[k];
      const double length = pieces.ends[k + 1] - begin;
      if (length == 0.0) continue;
      for (int n = 0; n < gauss_points; ++n) {
        const double u = rule.nodes[n];
        // With x ~ u² at either end, roots at the ends of a piece become polynomials.
        const double x = begin + length * (inside_ ? u : u * u * (3.0 - 2.0 * u));
        const double weight = length * rule.weights[n] * (inside_ ? 1.0 : 6.0 * u * (1.0 - u));
        sum += weight * along(f, axis + 1, square + x * x);
      }
    }
    return sum;
  }

  /// What is covered along an axis, in pieces that end in ends[1], …, ends[count].
  struct Pieces {
    int count = 0;
    std::array<double, 5> ends{};
  };
  Pieces pieces_along(int axis, double square) const {
    Pieces pieces;
    pieces.ends[0] = low_[axis];
    if (inside_) {
      pieces.ends[++pieces.count] = high_[axis];
      return pieces;
    }
    const int later = dimension_ - axis - 1;
    for (int corner = 0; corner < (1 << later); ++corner) {
      double left = square_ - square;
      for (int k = 0; k < later; ++k) {
        const double end = (corner >> k & 1) != 0 ? high_[axis + 1 + k] : low_[axis + 1 + k];
        left -= end * end;
      }
      const double place = left > 0.0 ? std::sqrt(left) : 0.0;
      if (place > low_[axis]) pieces.ends[++pieces.count] = std::min(place, high_[axis]);
    }
    std::sort(pieces.ends.begin() + 1, pieces.ends.begin() + 1 + pieces.count);
    return pieces;
  }

  double square_;  ///< of the radius
  int dimension_;
  std::array<double, 3> low_{}, high_{};
  double images_ = 1.0;
  bool outside_ = false, inside_ = false;
};

}  // namespace

double covered_volume(const CellOffset& cell, double radius, int dimension) {
  const CoveredCellIntegral covered(cell, radius, dimension);
  if (covered.inside()) return 1.0;
  return covered(nullptr);
}

double integral_over_covered(const std::function<double(double)>& f, const CellOffset& cell, double radius,
                             int dimension) {
  return CoveredCellIntegral(cell, radius, dimension)(&f);
}

double ball_volume(double radius, int dimension) {
  if (dimension == 1) return 2.0 * radius;
  if (dimension == 2) return std::numbers::pi * radius * radius;
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

}  // namespace peritherm
