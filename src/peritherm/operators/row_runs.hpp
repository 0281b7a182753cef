#pragma once

#include <cstdint>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/held_points.hpp"

namespace peritherm {

/// Neighbouring points of a row of a grid that turn heat into temperature alike.
struct RowRun {
  std::int32_t begin, end;  ///< points [begin, end) of the row
  double rate_scale;        ///< k / (ρ c V) of whole cells [W/(m K) K/J]; 0 if held or cut away
  double capacity;          ///< ρ c V of whole cells [J/K]; 0 if cut away
};

/// The runs of each row of a grid, rows in the order of their points.
struct RowRuns {
  std::vector<std::int64_t> row_begin{0};  ///< rows + 1
  std::vector<RowRun> runs;
  std::size_t free_points = 0;
};

/// One run per row where material and holding do not change.
RowRuns make_row_runs(const Body& body, const HeldPoints& held_by);

}  // namespace peritherm
