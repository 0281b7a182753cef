#include "peritherm/two_field/coarse_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace peritherm {
namespace {

/// A row's sum of entries, column by column.
class EntrySum {
 public:
  explicit EntrySum(std::size_t columns) : values_(columns, 0.0), seen_(columns, 0) {}

  void add(PointIndex column, double value) {
    if (!std::exchange(seen_[column], char{1})) columns_.push_back(column);
    values_[column] += value;
  }

  void append_to(SparseMatrix& matrix) {
    std::sort(columns_.begin(), columns_.end());
    for (const PointIndex column : columns_) {
      matrix.column_of.push_back(column);
      matrix.values.push_back(std::exchange(values_[column], 0.0));
      seen_[column] = 0;
    }
    matrix.begin.push_back(static_cast<std::int64_t>(matrix.values.size()));
    columns_.clear();
  }

 private:
  std::vector<double> values_;
  std::vector<char> seen_;
  std::vector<PointIndex> columns_;
};

std::vector<std::vector<PointIndex>> points_of_bins(const Bins& bins) {
  std::vector<std::vector<PointIndex>> points(bins.count);
  for (std::size_t n = 0; n < bins.bin_of.size(); ++n) points[bins.bin_of[n]].push_back(static_cast<PointIndex>(n));
  return points;
}

}  // namespace

void Bins::sum(ConstField values, Field result) const {
  std::fill(result.begin(), result.end(), 0.0);
  for (std::size_t n = 0; n < values.size(); ++n) result[bin_of[n]] += values[n];
}

Bins make_bins(const TwoFieldSystem& system, double width) {
  Bins bins;
  for (const NonlocalOperators& part : system.parts()) {
    std::map<std::array<std::int64_t, 3>, PointIndex> numbers;
    const double edge = width * part.horizon();
    Point origin = part.positions().front();
    for (const Point& x : part.positions()) {
      for (int axis = 0; axis < 3; ++axis) origin[axis] = std::min(origin[axis], x[axis]);
    }
    for (const Point& x : part.positions()) {
      std::array<std::int64_t, 3> cube;
      for (int axis = 0; axis < 3; ++axis) cube[axis] = std::llround(std::floor((x[axis] - origin[axis]) / edge));
      const auto [found, is_new] = numbers.try_emplace(cube, static_cast<PointIndex>(bins.count));
      if (is_new) ++bins.count;
      bins.bin_of.push_back(found->second);
    }
  }
  return bins;
}

SparseMatrix bin_matrix(const StageMatrix& matrix, const Bins& bins) {
  const TwoFieldSystem& system = matrix.system();
  const auto points = points_of_bins(bins);
  SparseMatrix result;
  result.columns = bins.count;
  EntrySum row(bins.count);
  std::vector<PointIndex> columns;
  std::vector<double> values;
  std::size_t part = 0;
  for (const auto& own : points) {
    for (const PointIndex point : own) {
      while (static_cast<std::size_t>(point) >= system.first_point(part + 1)) ++part;
      const auto first = static_cast<PointIndex>(system.first_point(part));
      matrix.conduction()[part].row(static_cast<std::size_t>(point - first), columns, values);
      for (std::size_t k = 0; k < columns.size(); ++k) row.add(bins.bin_of[first + columns[k]], values[k]);
      row.add(bins.bin_of[point], matrix.shift() * system.capacities()[point]);
    }
    row.append_to(result);
  }
  return result;
}

SparseMatrix bin_contacts(const TwoFieldSystem& system, const Bins& bins) {
  const SparseMatrix& contacts = system.contacts().matrix();
  SparseMatrix result;
  result.columns = bins.count;
  EntrySum row(bins.count);
  for (std::size_t r = 0; r < contacts.rows(); ++r) {
    for (std::int64_t k = contacts.begin[r]; k < contacts.begin[r + 1]; ++k) {
      row.add(bins.bin_of[contacts.column_of[k]], contacts.values[k]);
    }
    row.append_to(result);
  }
  return result;
}

SparseMatrix add_contacts(const SparseMatrix& matrix, const SparseMatrix& contacts, ConstField weights) {
  std::vector<std::vector<std::pair<PointIndex, PointIndex>>> rows_of(matrix.rows());
  for (std::size_t r = 0; r < contacts.rows(); ++r) {
    for (std::int64_t k = contacts.begin[r]; k < contacts.begin[r + 1]; ++k) {
      rows_of[contacts.column_of[k]].push_back({static_cast<PointIndex>(r), static_cast<PointIndex>(k)});
    }
  }
  SparseMatrix result;
  result.columns = matrix.columns;
  EntrySum row(matrix.columns);
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    for (std::int64_t k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k) row.add(matrix.column_of[k], matrix.values[k]);
    for (const auto& [r, own] : rows_of[i]) {
      const double factor = contacts.values[own] * weights[r];
      for (std::int64_t k = contacts.begin[r]; k < contacts.begin[r + 1]; ++k) {
        row.add(contacts.column_of[k], factor * contacts.values[k]);
      }
    }
    row.append_to(result);
  }
  return result;
}

}  // namespace peritherm
