#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace peritherm {

/// Which boundary holds each point of a grid; takes no memory if none is held.
class HeldPoints {
 public:
  /// Index of the boundary, −1 for free points.
  std::int16_t operator[](std::size_t point) const { return boundary_of_.empty() ? free : boundary_of_[point]; }

  /// `points`: how many there are in all.
  void hold(std::size_t point, std::int16_t boundary, std::size_t points) {
    if (boundary_of_.empty()) boundary_of_.assign(points, free);
    boundary_of_[point] = boundary;
  }

  /// True if all points are free.
  bool empty() const { return boundary_of_.empty(); }
  /// One index per point; none if all are free.
  std::span<const std::int16_t> boundaries() const { return boundary_of_; }

  static constexpr std::int16_t free = -1;

 private:
  std::vector<std::int16_t> boundary_of_;
};

}  // namespace peritherm
