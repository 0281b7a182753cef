#pragma once

#include "peritherm/base/describe.hpp"

namespace peritherm {

/// How much of a cell at the edge of the horizon counts.
enum class PartialVolumes {
  whole,        ///< all of it if its point lies within the horizon
  half,         ///< one half if its point lies on the edge, else all of it
  partial_area  ///< Algorithm 1 of [bobaru2012], with its adjusted kernel distance
};

template <>
struct EnumNames<PartialVolumes> {
  static constexpr std::array<std::pair<PartialVolumes, std::string_view>, 3> values{
      {{PartialVolumes::whole, "whole"},
       {PartialVolumes::half, "half"},
       {PartialVolumes::partial_area, "partial_area"}}};
};

/// Share of a cell's volume inside the horizon, and the distance at which the kernel is evaluated [m].
struct CoveredCell {
  double share = 0.0;
  double kernel_distance = 0.0;
};

/// Comparisons are relative to the spacing, so that a micrometre body behaves like a metre one.
inline CoveredCell covered_cell(PartialVolumes rule, double distance, double horizon, double spacing) {
  const double slack = 1e-9 * spacing;
  const double outside = distance - horizon;
  if (rule == PartialVolumes::whole) return {outside <= slack ? 1.0 : 0.0, distance};
  if (rule == PartialVolumes::half) {
    if (outside > slack) return {};
    return {outside >= -slack ? 0.5 : 1.0, distance};
  }
  if (outside < -0.5 * spacing) return {1.0, distance};
  const double share = 0.5 - outside / spacing;
  if (share <= 1e-9) return {};
  // Both branches put the kernel at the middle of the covered part.
  if (outside <= slack) return {share, distance - 0.5 * spacing * (1.0 - share)};
  return {share, horizon - 0.5 * spacing * share};
}

/// Distance beyond which no cell is covered [m].
inline double reach(PartialVolumes rule, double horizon, double spacing) {
  return rule == PartialVolumes::partial_area ? horizon + 0.5 * spacing : horizon;
}

}  // namespace peritherm
