#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/integrators/integrator.hpp"
#include "peritherm/simulation/plan.hpp"

namespace peritherm {

/// Temperatures of all points at some times, and what they cost.
struct Solution {
  Grid grid;
  double horizon = 0.0;                           ///< [m]
  std::vector<double> times;                      ///< ascending [s]
  std::vector<std::vector<double>> temperatures;  ///< per time: of every point, x fastest; NaN where cut away
  std::vector<MaterialIndex> materials;           ///< of a two-field body, per point; else empty
  StepCount count;
  std::string integrator;  ///< the one that was taken
  double bonds = 0.0;      ///< pairs of points that exchange heat, each counted once
  double wall = 0.0;       ///< [s]
  /// Temperature at a place, linear between points.
  double at(std::size_t time, const Point& place) const;
};

/// Checks a problem that is to be marched through times (ascending, from 0 on), and chooses its backend; its
/// `time.end` and its outputs do not matter. Throws Error with every fault of the problem.
Prepared prepare_to_solve(Problem problem, std::span<const double> times);

/// Marches through the times it was prepared for, by `prepared.threads` threads, without writing files.
/// `stop_requested` is asked after each step; true ends the march with fewer times.
/// Throws Error (Fault::numerics) with place and time where a temperature is not finite.
Solution solve(const Prepared& prepared, std::span<const double> times,
               const std::function<bool()>& stop_requested = {});

/// Prepares and marches.
Solution solve(const Problem& problem, std::span<const double> times, const std::function<bool()>& stop_requested = {});

}  // namespace peritherm
