#pragma once

#include <cstddef>
#include <vector>

#include "peritherm/base/field.hpp"

namespace peritherm {

/// Dense matrix, column behind column.
struct Matrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;

  Matrix() = default;
  Matrix(std::size_t row_count, std::size_t column_count)
      : rows(row_count), columns(column_count), values(row_count * column_count, 0.0) {}

  bool empty() const { return values.empty(); }
  double& operator()(std::size_t row, std::size_t column) { return values[column * rows + row]; }
  double operator()(std::size_t row, std::size_t column) const { return values[column * rows + row]; }
  Field column(std::size_t k) { return Field(values).subspan(k * rows, rows); }
  ConstField column(std::size_t k) const { return ConstField(values).subspan(k * rows, rows); }
  bool operator==(const Matrix&) const = default;
};

}  // namespace peritherm
