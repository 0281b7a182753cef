#pragma once

#include <cmath>

#include "peritherm/base/describe.hpp"
#include "peritherm/physics/covered_cell.hpp"

namespace peritherm {

/// How much of a cell at the edge of the horizon counts, and what stands for the kernel inside the cells.
enum class PartialVolumes {
  whole,            ///< all of it if its point lies within the horizon
  half,             ///< the part within the horizon: one half where the edge passes its point in 1-D
  half_normalised,  ///< as half, all parts scaled so that together they fill the horizon
  trapezoid,        ///< as half, and the nearest neighbours stand for the point's own cell too
  cell_integrated,  ///< the kernel integrated over the part within the horizon
  partial_area      ///< Algorithm 1 of [bobaru2012], with its adjusted kernel distance
};

template <>
struct EnumNames<PartialVolumes> {
  static constexpr std::array<std::pair<PartialVolumes, std::string_view>, 6> values{
      {{PartialVolumes::whole, "whole"},
       {PartialVolumes::half, "half"},
       {PartialVolumes::half_normalised, "half_normalised"},
       {PartialVolumes::trapezoid, "trapezoid"},
       {PartialVolumes::cell_integrated, "cell_integrated"},
       {PartialVolumes::partial_area, "partial_area"}}};
};

/// Share of a cell's volume that counts, and the distance at which the kernel is evaluated, in spacings.
struct CountedCell {
  double share = 0.0;
  double kernel_distance = 0.0;
};

inline double distance_to(const CellOffset& cell) { return std::hypot(cell[0], cell[1], cell[2]); }

/// Shares below this, of cells that the horizon passes by but for rounding, count as none.
inline constexpr double least_share = 1e-9;

/// By the distance of the cell's point only; `ratio` = horizon over spacing.
inline CountedCell count_whole(double distance, double ratio) {
  return {distance <= ratio + least_share ? 1.0 : 0.0, distance};
}

/// Algorithm 1: both branches put the kernel at the middle of the covered part.
inline CountedCell count_partial_area(double distance, double ratio) {
  const double outside = distance - ratio;
  if (outside < -0.5) return {1.0, distance};
  const double share = 0.5 - outside;
  if (share <= least_share) return {};
  if (outside <= least_share) return {share, distance - 0.5 * (1.0 - share)};
  return {share, ratio - 0.5 * share};
}

/// What of a neighbour's cell counts. `cell_integrated` needs the kernel's integral instead of the share.
inline CountedCell count_cell(PartialVolumes rule, const CellOffset& cell, double ratio, int dimension) {
  const double distance = distance_to(cell);
  if (rule == PartialVolumes::whole) return count_whole(distance, ratio);
  if (rule == PartialVolumes::partial_area) return count_partial_area(distance, ratio);
  double share = covered_volume(cell, ratio, dimension);
  if (share <= least_share) share = 0.0;
  const double own = rule == PartialVolumes::half ? 0.0 : covered_volume({}, ratio, dimension);
  if (rule == PartialVolumes::half_normalised) {
    const double whole = ball_volume(ratio, dimension);
    share *= whole / (whole - own);
  } else if (rule == PartialVolumes::trapezoid && distance == 1.0) {
    share += own / (2.0 * dimension);
  }
  return {share, distance};
}

/// Distance beyond which no point's cell counts along an axis, in spacings.
inline double reach_of(PartialVolumes rule, double ratio) {
  return rule == PartialVolumes::whole ? ratio + least_share : ratio + 0.5;
}

/// Smallest horizon ratio: for some rules the nearest cells must lie within the horizon.
inline double least_ratio(PartialVolumes rule) {
  return rule == PartialVolumes::trapezoid || rule == PartialVolumes::cell_integrated ? 1.5 : 1.0;
}

}  // namespace peritherm
