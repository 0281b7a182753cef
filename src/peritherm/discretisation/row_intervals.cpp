#include "peritherm/discretisation/row_intervals.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/discretisation/point_blocks.hpp"

namespace peritherm {
namespace {

/// Index of the point at or below a coordinate; far outside the grid it is held where it overflows nothing.
double place_along(const Grid& grid, int axis, double x) {
  return std::clamp((x - grid.origin[axis]) / grid.spacing - grid.first_depth(), -1e6, 1e9);
}

void append_near_surface(const Body& body, double distance, const PointBlock& block,
                         std::vector<RowInterval>& intervals) {
  for (int z = block.low[2]; z < block.high[2]; ++z) {
    for (int y = block.low[1]; y < block.high[1]; ++y) {
      const std::int64_t row = y + static_cast<std::int64_t>(body.grid.count(1)) * z;
      for (int x = block.low[0]; x < block.high[0]; ++x) {
        if (!any_surface_within(body.regions, body.grid.position({x, y, z}), distance)) continue;
        if (!intervals.empty() && intervals.back().row == row && intervals.back().end == x) {
          ++intervals.back().end;
        } else {
          intervals.push_back({row, x, x + 1});
        }
      }
    }
  }
}

}  // namespace

void append_box(const Grid& grid, const GridIndex& low, const GridIndex& high, std::vector<RowInterval>& intervals) {
  const int begin = std::max(low[0], 0);
  const int end = std::min(high[0], grid.count(0) - 1) + 1;
  if (begin >= end) return;
  for (int z = std::max(low[2], 0); z <= std::min(high[2], grid.count(2) - 1); ++z) {
    for (int y = std::max(low[1], 0); y <= std::min(high[1], grid.count(1) - 1); ++y) {
      intervals.push_back({y + static_cast<std::int64_t>(grid.count(1)) * z, begin, end});
    }
  }
}

void merge(std::vector<RowInterval>& intervals) {
  std::sort(intervals.begin(), intervals.end());
  std::size_t count = 0;
  for (const RowInterval& interval : intervals) {
    if (count > 0 && intervals[count - 1].row == interval.row && interval.begin <= intervals[count - 1].end) {
      intervals[count - 1].end = std::max(intervals[count - 1].end, interval.end);
    } else {
      intervals[count++] = interval;
    }
  }
  intervals.resize(count);
}

std::vector<RowInterval> points_near_cracks(const Body& body, int radius) {
  const Grid& grid = body.grid;
  const double reach = (radius + 1) * grid.spacing;
  Point lower{}, upper{};
  for (int axis = 0; axis < grid.dimension; ++axis) {
    lower[axis] = grid.origin[axis] - reach;
    upper[axis] = grid.origin[axis] + grid.length(axis) + reach;
  }
  std::vector<RowInterval> intervals;
  for (const CrackSurface& crack : body.cracks) {
    for (const auto& piece : crack.pieces(radius * grid.spacing, lower, upper)) {
      GridIndex low{}, high{};
      for (int axis = 0; axis < grid.dimension; ++axis) {
        low[axis] = static_cast<int>(std::floor(place_along(grid, axis, piece[0][axis]))) - radius;
        high[axis] = static_cast<int>(std::ceil(place_along(grid, axis, piece[1][axis]))) + radius;
      }
      append_box(grid, low, high, intervals);
    }
  }
  for (const auto points : {body.broken.points(), body.faces.points()}) {
    for (const std::int64_t point : points) {
      const GridIndex p = grid.index(static_cast<std::size_t>(point));
      append_box(grid, p, p, intervals);
    }
  }
  merge(intervals);
  return intervals;
}

std::vector<RowInterval> points_near_regions(const Body& body, double distance) {
  std::vector<RowInterval> intervals;
  if (body.regions.empty()) return intervals;
  const PointBlocks blocks(body.grid);
#pragma omp parallel
  {
    std::vector<RowInterval> found;
#pragma omp for schedule(dynamic, 16)
    for (std::int64_t b = 0; b < blocks.size(); ++b) {
      const PointBlock block = blocks[b];
      if (!any_surface_within(body.regions, block.centre, block.half_diagonal + distance)) continue;
      append_near_surface(body, distance, block, found);
    }
#pragma omp critical
    intervals.insert(intervals.end(), found.begin(), found.end());
  }
  merge(intervals);
  return intervals;
}

IntervalBlocks cut_into_blocks(const std::vector<RowInterval>& merged, int longest, int points_per_block) {
  IntervalBlocks blocks;
  int points = 0;
  for (const RowInterval& interval : merged) {
    for (std::int32_t begin = interval.begin; begin < interval.end; begin += longest) {
      const std::int32_t end = std::min(interval.end, begin + longest);
      blocks.intervals.push_back({interval.row, begin, end});
      points += end - begin;
      if (points < points_per_block) continue;
      blocks.begin.push_back(blocks.intervals.size());
      points = 0;
    }
  }
  if (points > 0) blocks.begin.push_back(blocks.intervals.size());
  return blocks;
}

}  // namespace peritherm
