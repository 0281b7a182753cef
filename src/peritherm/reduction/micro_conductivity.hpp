#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "peritherm/reduction/reduce.hpp"

namespace peritherm {

/// How two retained points exchange heat: conductance over both volumes, −K_ij / (V_i V_j), 0 where they do not.
struct MicroConductivity {
  std::int64_t first = 0, second = 0;  ///< their numbers in the grid, first < second
  double distance = 0.0;               ///< [m]
  double full = 0.0;                   ///< of their own bond [W/(m⁶ K)]
  double condensed = 0.0;              ///< once the points between them follow [galadima2022, figs. 4 and 5]
};

/// All pairs of retained points, for pictures of what condensation does to a kernel: it widens the horizon. Held
/// points are not among them. `volumes`: of each point of the grid [m³]. Throws Error as static condensation does.
std::vector<MicroConductivity> condensed_micro_conductivity(const RetainedPoints& choice, FullSystem& full,
                                                            ConstField volumes);

/// Writes a table to a CSV file: numbers and places of both points, distance, both micro-conductivities. Pairs whose
/// micro-conductivities both are 0 but for rounding are left out.
void write_micro_conductivity(const std::vector<MicroConductivity>& table, const Grid& grid,
                              const std::filesystem::path& file);

}  // namespace peritherm
