#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "peritherm/discretisation/body.hpp"

namespace peritherm {

/// Neighbouring points [begin, end) of a row of a grid along x; rows are numbered with y fastest.
struct RowInterval {
  std::int64_t row;
  std::int32_t begin, end;
  auto operator<=>(const RowInterval&) const = default;
};

inline GridIndex first_point(const Grid& grid, const RowInterval& interval) {
  return {interval.begin, static_cast<int>(interval.row % grid.count(1)),
          static_cast<int>(interval.row / grid.count(1))};
}

/// Appends the rows of a box of indices, both corners included, as far as it lies in the grid.
void append_box(const Grid& grid, const GridIndex& low, const GridIndex& high, std::vector<RowInterval>& intervals);

/// Sorts, and joins what overlaps or touches.
void merge(std::vector<RowInterval>& intervals);

/// Points with a bond that may cross a crack, found by walking along the cracks, or that breaks; merged.
std::vector<RowInterval> points_near_cracks(const Body& body, int radius);

/// Points as near to a region's surface as `distance` [m], and few others; merged. Blocks of points that lie clear of
/// all surfaces are passed over as a whole.
std::vector<RowInterval> points_near_regions(const Body& body, double distance);

/// Intervals of at most `longest` points in the same order, and where every so many points a new block begins, so that
/// threads share the work in the same way whatever their number.
struct IntervalBlocks {
  std::vector<RowInterval> intervals;
  std::vector<std::size_t> begin{0};  ///< blocks + 1, into intervals
  std::size_t size() const { return begin.size() - 1; }
};
IntervalBlocks cut_into_blocks(const std::vector<RowInterval>& merged, int longest, int points_per_block);

}  // namespace peritherm
