#include "peritherm/two_field/contact_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace peritherm {
namespace {

using PointEntry = std::pair<PointIndex, double>;

void add_trace(const Trace& trace, std::size_t first_point, double factor, SparseMatrix& matrix) {
  for (std::size_t k = 0; k < trace.points.size(); ++k) {
    matrix.column_of.push_back(static_cast<PointIndex>(first_point) + trace.points[k]);
    matrix.values.push_back(factor * trace.weights[k]);
  }
}

/// For each point the rows that it has weight in.
std::vector<std::vector<PointEntry>> rows_of_points(const SparseMatrix& matrix,
                                                    const std::vector<std::size_t>& chosen) {
  std::vector<std::vector<PointEntry>> result(matrix.columns);
  for (std::size_t r = 0; r < chosen.size(); ++r) {
    for (std::int64_t k = matrix.begin[chosen[r]]; k < matrix.begin[chosen[r] + 1]; ++k) {
      result[matrix.column_of[k]].push_back({static_cast<PointIndex>(r), matrix.values[k]});
    }
  }
  return result;
}

}  // namespace

ContactMatrix::ContactMatrix(const std::vector<ContactRow>& rows, const std::vector<std::size_t>& first_point) {
  matrix_.columns = first_point.back();
  for (const ContactRow& row : rows) {
    add_trace(row.first_trace, first_point[row.first], row.area, matrix_);
    second_begin_.push_back(static_cast<std::int64_t>(matrix_.values.size()));
    if (row.second >= 0) add_trace(row.second_trace, first_point[row.second], -row.area, matrix_);
    matrix_.begin.push_back(static_cast<std::int64_t>(matrix_.values.size()));
    areas_.push_back(row.area);
  }
}

void ContactMatrix::product(ConstField temperature, Field result) const {
  for (std::size_t r = 0; r < rows(); ++r) {
    double sum = 0.0;
    for (std::int64_t k = matrix_.begin[r]; k < matrix_.begin[r + 1]; ++k) {
      sum += matrix_.values[k] * temperature[matrix_.column_of[k]];
    }
    result[r] = sum;
  }
}

void ContactMatrix::add_adjoint(double factor, ConstField multipliers, Field result) const {
  for (std::size_t r = 0; r < rows(); ++r) {
    for (std::int64_t k = matrix_.begin[r]; k < matrix_.begin[r + 1]; ++k) {
      result[matrix_.column_of[k]] += factor * multipliers[r] * matrix_.values[k];
    }
  }
}

double ContactMatrix::variation(std::size_t row, ConstField temperature) const {
  double result = 0.0;
  const std::int64_t bounds[] = {matrix_.begin[row], second_begin_[row], matrix_.begin[row + 1]};
  for (int side = 0; side < 2; ++side) {
    double mean = 0.0, sum = 0.0;
    const double area = side == 0 ? areas_[row] : -areas_[row];
    for (std::int64_t k = bounds[side]; k < bounds[side + 1]; ++k) {
      mean += matrix_.values[k] / area * temperature[matrix_.column_of[k]];
    }
    for (std::int64_t k = bounds[side]; k < bounds[side + 1]; ++k) {
      sum += std::abs(matrix_.values[k] / area * (temperature[matrix_.column_of[k]] - mean));
    }
    result += sum;
  }
  return result;
}

SparseMatrix ContactMatrix::gram(ConstField weights, const std::vector<std::size_t>& chosen) const {
  const auto at_point = rows_of_points(matrix_, chosen);
  SparseMatrix result;
  result.columns = chosen.size();
  std::vector<double> sums(chosen.size(), 0.0);
  std::vector<PointIndex> columns;
  std::vector<char> seen(chosen.size(), 0);
  for (const std::size_t row : chosen) {
    columns.clear();
    for (std::int64_t k = matrix_.begin[row]; k < matrix_.begin[row + 1]; ++k) {
      const PointIndex point = matrix_.column_of[k];
      for (const auto& [other, value] : at_point[point]) {
        if (!std::exchange(seen[other], char{1})) columns.push_back(other);
        sums[other] += matrix_.values[k] * weights[point] * value;
      }
    }
    std::sort(columns.begin(), columns.end());
    for (const PointIndex column : columns) {
      result.column_of.push_back(column);
      result.values.push_back(std::exchange(sums[column], 0.0));
      seen[column] = 0;
    }
    result.begin.push_back(static_cast<std::int64_t>(result.values.size()));
  }
  return result;
}

}  // namespace peritherm
