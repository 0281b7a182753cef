#pragma once

#include <vector>

#include "peritherm/base/matrix.hpp"
#include "peritherm/reduction/reduce.hpp"

namespace peritherm {

/// States of a full run.
struct Snapshots {
  std::vector<double> times;         ///< [s]
  std::vector<FieldStorage> states;  ///< minus the level at free points, 0 elsewhere [K]
  double span = 0.0;                 ///< of the temperatures of body and surroundings [K]
};

/// Runs the full system once. `count` times from the shortest to the longest, spread evenly in their logarithm; as many
/// spread evenly if the body or loads change in time; and the times of the case's outputs.
Snapshots run_for_snapshots(FullSystem& full, double shortest_time, int count, double tolerance, ConstField capacities,
                            ReductionCost& cost, const ReductionProgress& progress);

/// Directions in which snapshots vary, the most important one first [sirovich1987].
struct SnapshotDirections {
  std::vector<FieldStorage> states;  ///< orthonormal in Σ C a b
  Matrix shares;                     ///< directions × snapshots: Σ C direction · snapshot
  std::vector<double> rest;          ///< per snapshot: √(Σ C r²) of what all of them leave out
};
/// Empties the snapshots. What is smaller than `negligible`, √(Σ C r²), is left out, and what needs more than `most`
/// directions.
SnapshotDirections find_directions(std::vector<FieldStorage> snapshots, ConstField capacities, double negligible,
                                   std::size_t most);

}  // namespace peritherm
