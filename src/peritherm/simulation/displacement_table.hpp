#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "peritherm/discretisation/grid.hpp"

namespace peritherm {

/// Reads a table of displacements, time after time. Its first line names the columns t, x, y, z, ux, uy, uz, as many as
/// the grid has dimensions; all numbers are in SI units. Rows ascend by time, and at each time every point of the body
/// stands once, no farther than `place_tolerance` spacings from its place. Empty lines and those that begin with # are
/// passed over.
class DisplacementTable {
 public:
  static constexpr double place_tolerance = 0.01;

  /// What is wrong with the table, and how to mend it.
  struct Fault {
    std::string problem, hint;
  };
  /// `is_point`: whether a point of the grid, by its number, belongs to the body.
  DisplacementTable(std::string path, const Grid& grid, std::function<bool(std::size_t)> is_point);

  /// Reads on to the end of the next time. Fills `displacements`, `dimension` numbers per point [m]; those of points
  /// that are cut away or missing are 0. False at the end of the table, or if it cannot be read at all.
  bool next(double& time, std::vector<double>& displacements);

  /// What has been found wrong so far; no more than a few, after which nothing more is read.
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  struct Row {
    long line = 0;
    double time = 0.0;
    Point place{}, displacement{};
  };
  void open();
  void add_fault(std::string problem, std::string hint);
  std::optional<Row> read_row();
  std::optional<Row> parse(const std::string& text);
  std::optional<std::size_t> point_at(const Row& row);
  void look_for_missing(double time);
  std::string columns() const;
  std::string at_line(long line) const;
  std::string place_text(const Point& place) const;

  std::string path_;
  Grid grid_;
  std::function<bool(std::size_t)> is_point_;
  std::ifstream in_;
  long line_ = 0;
  std::optional<Row> ahead_;  ///< read already, of a later time
  std::vector<std::uint8_t> listed_;
  std::vector<Fault> faults_;
};

}  // namespace peritherm
