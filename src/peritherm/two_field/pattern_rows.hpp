#pragma once

#include <memory>
#include <vector>

#include "peritherm/base/field.hpp"
#include "peritherm/base/sparse_matrix.hpp"
#include "peritherm/two_field/point_classes.hpp"

namespace peritherm {

/// Rows of a square matrix, those of a class of points stored once.
class PatternRows {
 public:
  struct Entry {
    PointIndex distance;  ///< column − row
    double value;
  };

  PatternRows() = default;
  explicit PatternRows(std::shared_ptr<const PointClasses> classes);

  /// The row of the next class.
  void append(const std::vector<Entry>& row);

  std::size_t size() const { return classes_ == nullptr ? 0 : classes_->class_of.size(); }
  /// result += factor · rows · field; the same bits for any number of threads.
  void add_product(double factor, ConstField field, Field result) const;
  /// Fills columns, ascending, and values of a row.
  void row(std::size_t i, std::vector<PointIndex>& columns, std::vector<double>& values) const;
  double diagonal(std::size_t i) const;
  SparseMatrix matrix() const;
  std::size_t bytes() const;

 private:
  struct Piece {
    PointIndex begin, end, number;
  };

  std::shared_ptr<const PointClasses> classes_;
  std::vector<Piece> pieces_;  ///< runs, the long ones cut
  std::vector<std::int64_t> begin_{0};
  std::vector<PointIndex> distances_;
  std::vector<double> values_;
};

}  // namespace peritherm
