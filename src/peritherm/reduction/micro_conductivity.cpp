#include "peritherm/reduction/micro_conductivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "peritherm/base/file.hpp"
#include "peritherm/reduction/condensation.hpp"

namespace peritherm {
namespace {

double distance_of(const Grid& grid, std::int64_t first, std::int64_t second) {
  const Point a = grid.position(grid.index(static_cast<std::size_t>(first)));
  const Point b = grid.position(grid.index(static_cast<std::size_t>(second)));
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

std::string place_columns(const Grid& grid, std::int64_t point) {
  const Point x = grid.position(grid.index(static_cast<std::size_t>(point)));
  std::string text;
  for (int axis = 0; axis < grid.dimension; ++axis) text += fmt::format(",{:.9g}", x[axis]);
  return text;
}

}  // namespace

std::vector<MicroConductivity> condensed_micro_conductivity(const RetainedPoints& choice, FullSystem& full,
                                                            ConstField volumes) {
  std::vector<std::string> notes;
  const SplitHeat split = split_heat(full, choice, notes);
  const SparseMatrix own = part_of(split.heat.conductances, split.retained, split.retained);
  const Matrix condensed = condensed_conductances(split, condensed_shapes(split, 0.0, {}, full.memory));
  std::vector<MicroConductivity> table;
  std::vector<double> row(split.retained.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    std::fill(row.begin(), row.end(), 0.0);
    for (auto n = static_cast<std::size_t>(own.begin[i]); n < static_cast<std::size_t>(own.begin[i + 1]); ++n)
      row[static_cast<std::size_t>(own.column_of[n])] = own.values[n];
    for (std::size_t j = i + 1; j < row.size(); ++j) {
      const std::int64_t first = split.heat.points[static_cast<std::size_t>(split.retained[i])];
      const std::int64_t second = split.heat.points[static_cast<std::size_t>(split.retained[j])];
      const double area = volumes[static_cast<std::size_t>(first)] * volumes[static_cast<std::size_t>(second)];
      // The lower half is there.
      table.push_back(
          {first, second, distance_of(full.layout.grid(), first, second), -row[j] / area, -condensed(j, i) / area});
    }
  }
  return table;
}

void write_micro_conductivity(const std::vector<MicroConductivity>& table, const Grid& grid,
                              const std::filesystem::path& file) {
  double largest = 0.0;
  for (const MicroConductivity& pair : table) largest = std::max({largest, pair.full, pair.condensed});
  write_file(file, [&](std::ostream& stream) {
    stream << "first,second";
    for (const char* point : {"first", "second"}) {
      for (int axis = 0; axis < grid.dimension; ++axis) stream << ',' << point << '_' << "xyz"[axis] << "_m";
    }
    stream << ",distance_m,full_W_per_m6_K,condensed_W_per_m6_K\n";
    for (const MicroConductivity& pair : table) {
      if (std::max(std::abs(pair.full), std::abs(pair.condensed)) <= 1e-14 * largest) continue;
      stream << pair.first << ',' << pair.second << place_columns(grid, pair.first) << place_columns(grid, pair.second)
             << fmt::format(",{:.9g},{:.12g},{:.12g}\n", pair.distance, pair.full, pair.condensed);
    }
  });
}

}  // namespace peritherm
