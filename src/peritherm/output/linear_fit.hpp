#pragma once

#include <array>
#include <cstddef>

#include "peritherm/base/field.hpp"

namespace peritherm {

/// A value at a place from points on one side of it: that of the linear function which fits them best, each with weight
/// 1/r⁴. Linear fields are met to rounding; directions along which the points do not differ are left out.
class LinearFit {
 public:
  explicit LinearFit(std::size_t dimension) : dimension_(dimension) {}
  void add(const Point& arm, double value);  ///< arm: from the place to the point [spacings]
  bool empty() const { return weight_ == 0.0; }
  double value() const;  ///< at the place; not of an empty fit

 private:
  std::size_t dimension_;
  double weight_ = 0.0, sum_ = 0.0;
  Point arm_{}, mixed_{};                          ///< Σ w a, Σ w a v
  std::array<std::array<double, 3>, 3> square_{};  ///< Σ w a aᵀ
};

}  // namespace peritherm
