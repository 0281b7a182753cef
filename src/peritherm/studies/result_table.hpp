#pragma once

#include <optional>
#include <string>
#include <vector>

#include "peritherm/base/field.hpp"

namespace peritherm {

/// Temperatures at places and times, from a CSV file.
struct ResultTable {
  struct Moment {
    double time = 0.0;  ///< [s]
    std::vector<Point> places;
    std::vector<double> temperatures;
    /// None if no place of the table lies within `slack` [m].
    std::optional<double> temperature_at(const Point& place, double slack) const;
  };
  std::vector<Moment> moments;  ///< ascending in time
  bool timed = false;           ///< has a column of times; else its one moment stands for any time

  /// Null if the table has nothing for this time (to a billionth of it).
  const Moment* find(double time) const;
};

/// Reads the columns x, y, z [m] (as many as `dimension`), t or time [s] (may be missing) and T or temperature, in any
/// order, by the names of the first line; other columns are passed over, and lines whose temperature is nan. Throws
/// Error that names the file and the line.
ResultTable read_result_table(const std::string& path, int dimension);

}  // namespace peritherm
