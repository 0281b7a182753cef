#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "peritherm/discretisation/sub_domains.hpp"
#include "peritherm/geometry/vector.hpp"
#include "support/tolerance.hpp"

namespace peritherm {

/// A segment, square or cube of edge 1 in cells.
inline Grid unit_box(int dimension, int cells) {
  Grid grid;
  grid.dimension = dimension;
  grid.spacing = 1.0 / cells;
  grid.cells = {cells, dimension > 1 ? cells : 1, dimension > 2 ? cells : 1};
  return grid;
}

/// Volume of a part, summed so finely that only the rounding of each point's own counts [m³].
inline double volume_of(const SubDomain& part) {
  long double sum = 0.0;
  for (const double volume : part.volumes) sum += volume;
  return static_cast<double>(sum);
}

/// Σ A n = 0 and Σ A n xᵀ = (Σ V) 1 for every part, to what sums of as many terms may lose.
inline void expect_closed(const DividedBody& body) {
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    std::array<long double, 3> sum{};
    std::array<std::array<long double, 3>, 3> moment{};
    double scale = 0.0;
    for (const SurfacePoint& point : body.surface) {
      if (point.first != static_cast<int>(p) && point.second != static_cast<int>(p)) continue;
      const double sign = point.first == static_cast<int>(p) ? 1.0 : -1.0;
      EXPECT_NEAR(length(point.normal), 1.0, rounding(3, 1.0));
      EXPECT_GT(point.area, 0.0);
      scale = std::max(scale, point.area * std::max(1.0, length(point.position)));
      for (int a = 0; a < 3; ++a) {
        sum[a] += sign * point.area * point.normal[a];
        for (int b = 0; b < 3; ++b) moment[a][b] += sign * point.area * point.normal[a] * point.position[b];
      }
    }
    const double tolerance = rounding(body.surface.size() + body.parts[p].size(), scale);
    for (int a = 0; a < body.dimension; ++a) {
      EXPECT_NEAR(static_cast<double>(sum[a]), 0.0, tolerance) << "part " << body.parts[p].name << ", component " << a;
      for (int b = 0; b < body.dimension; ++b) {
        EXPECT_NEAR(static_cast<double>(moment[a][b]), a == b ? volume_of(body.parts[p]) : 0.0, tolerance)
            << "part " << body.parts[p].name << ", components " << a << b;
      }
    }
  }
}

}  // namespace peritherm
