#pragma once

#include <vector>

#include "peritherm/discretisation/points.hpp"

namespace peritherm {

/// For each owned point the numbers of all other points closer than a distance, ascending; row by row.
struct Neighbours {
  std::vector<BondIndex> row_begin;  ///< owned points + 1
  std::vector<PointIndex> points;
};

/// Cell list: cost proportional to the number of pairs.
Neighbours find_neighbours(const Points& points, double distance);

}  // namespace peritherm
