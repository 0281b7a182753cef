#include "peritherm/two_field/correction_energy.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

/// Adds into one sparse row after another.
class OpenRow {
 public:
  explicit OpenRow(std::size_t columns) : sums_(columns, 0.0), is_open_(columns, 0) {}
  void add(PointIndex column, double value) {
    if (!is_open_[column]) open_.push_back(column);
    is_open_[column] = 1;
    sums_[column] += value;
  }
  void move_to(SparseMatrix& matrix) {
    std::sort(open_.begin(), open_.end());
    for (const PointIndex column : open_) {
      matrix.column_of.push_back(column);
      matrix.values.push_back(sums_[column]);
      sums_[column] = 0.0;
      is_open_[column] = 0;
    }
    matrix.begin.push_back(static_cast<std::int64_t>(matrix.values.size()));
    open_.clear();
  }

 private:
  std::vector<double> sums_;
  std::vector<char> is_open_;
  std::vector<PointIndex> open_;
};

}  // namespace

CorrectionEnergy::CorrectionEnergy(int dimension, const SubDomain& part, const Families& families,
                                   std::vector<PointIndex> changing)
    : changing_(std::move(changing)) {
  const std::vector<PointIndex> column_of = number_columns(part.size(), families);
  const double cell = std::pow(part.spacing, dimension);
  for (const PointIndex point : changing_) {
    const auto i = static_cast<std::size_t>(point);
    const auto family = families.of(i);
    Row row{bonds_.size(), column_of[i], part.volumes[i] / cell, 0.0, {}, {}};
    Tensor second{};
    for (std::size_t k = 0; k < family.size(); ++k) {
      Point bond = families.bond(i, k).vector;
      for (double& along : bond) along /= part.spacing;
      const double weight = row.volume * row.volume * part.volumes[family[k]] / cell / dot(bond, bond);
      Point moment{};
      for (int a = 0; a < 3; ++a) {
        moment[a] = weight * bond[a];
        row.moment[a] -= moment[a];
        for (int b = 0; b < 3; ++b) second[a][b] += moment[a] * bond[b];
      }
      row.weight += weight;
      bonds_.push_back({column_of[family[k]], weight, moment});
    }
    row.inverse = invert(second, dimension).inverse;
    rows_.push_back(row);
  }
}

std::vector<PointIndex> CorrectionEnergy::number_columns(std::size_t points, const Families& families) {
  std::vector<PointIndex> column_of(points, -1);
  for (const PointIndex i : changing_) {
    column_of[i] = 0;
    for (const PointIndex j : families.of(static_cast<std::size_t>(i))) column_of[j] = 0;
  }
  for (std::size_t j = 0; j < points; ++j) {
    if (column_of[j] < 0) continue;
    column_of[j] = static_cast<PointIndex>(columns_.size());
    columns_.push_back(static_cast<PointIndex>(j));
  }
  return column_of;
}

Point CorrectionEnergy::slope_of(const Row& row, std::size_t end, ConstField multipliers) const {
  const double here = multipliers[row.column];
  Point sum{};
  for (std::size_t k = row.begin; k < end; ++k) {
    const double difference = multipliers[bonds_[k].column] - here;
    for (int a = 0; a < 3; ++a) sum[a] += bonds_[k].moment[a] * difference;
  }
  return product(row.inverse, sum);
}

void CorrectionEnergy::apply(ConstField multipliers, Field result) const {
  std::fill(result.begin(), result.end(), 0.0);
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    const Row& row = rows_[n];
    const double here = multipliers[row.column];
    const std::size_t end = end_of(n);
    const Point slope = slope_of(row, end, multipliers);
    double sum = 0.0;
    for (std::size_t k = row.begin; k < end; ++k) {
      const Bond& bond = bonds_[k];
      const double change = bond.weight * (multipliers[bond.column] - here) - dot(bond.moment, slope);
      result[bond.column] += change;
      sum += change;
    }
    result[row.column] -= sum;
  }
}

void CorrectionEnergy::add_changes(ConstField multipliers, Field changes) const {
  const auto count = static_cast<std::int64_t>(rows_.size());
  for (std::int64_t n = 0; n < count; ++n) {
    const Row& row = rows_[n];
    const double here = multipliers[row.column];
    const Point slope = slope_of(row, end_of(n), multipliers);
    for (std::size_t k = row.begin; k < end_of(n); ++k) {
      const double difference = multipliers[bonds_[k].column] - here;
      changes[k] += (bonds_[k].weight * difference - dot(bonds_[k].moment, slope)) / row.volume;
    }
  }
}

void CorrectionEnergy::sum_changes(ConstField changes, Field result) const {
  std::fill(result.begin(), result.end(), 0.0);
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    const Row& row = rows_[n];
    double sum = 0.0;
    for (std::size_t k = row.begin; k < end_of(n); ++k) {
      const double change = row.volume * changes[k];
      result[bonds_[k].column] += change;
      sum += change;
    }
    result[row.column] -= sum;
  }
}

std::vector<std::vector<CorrectionEnergy::End>> CorrectionEnergy::find_ends() const {
  std::vector<std::vector<End>> ends(columns_.size());
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    ends[rows_[n].column].push_back({n, -1});
    for (std::size_t k = rows_[n].begin; k < end_of(n); ++k) {
      ends[bonds_[k].column].push_back({n, static_cast<std::ptrdiff_t>(k)});
    }
  }
  return ends;
}

SparseMatrix CorrectionEnergy::matrix() const {
  SparseMatrix result;
  result.columns = columns_.size();
  OpenRow open(columns_.size());
  const std::vector<std::vector<End>> ends = find_ends();
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    for (const auto& [n, end] : ends[j]) {
      const Row& row = rows_[n];
      const bool is_self = end < 0;
      const Point left = product(row.inverse, is_self ? row.moment : bonds_[end].moment);
      open.add(row.column, (is_self ? row.weight : -bonds_[end].weight) - dot(left, row.moment));
      if (!is_self) open.add(static_cast<PointIndex>(j), bonds_[end].weight);
      for (std::size_t k = row.begin; k < end_of(n); ++k) {
        open.add(bonds_[k].column, (is_self ? -bonds_[k].weight : 0.0) - dot(left, bonds_[k].moment));
      }
    }
    open.move_to(result);
  }
  return result;
}

void CorrectionEnergy::fill_diagonal(Field diagonal) const {
  std::fill(diagonal.begin(), diagonal.end(), 0.0);
  const auto own = [](const Row& row, double weight, const Point& moment) {
    return weight - dot(product(row.inverse, moment), moment);
  };
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    const Row& row = rows_[n];
    diagonal[row.column] += own(row, row.weight, row.moment);
    for (std::size_t k = row.begin; k < end_of(n); ++k) {
      diagonal[bonds_[k].column] += own(row, bonds_[k].weight, bonds_[k].moment);
    }
  }
}

}  // namespace peritherm
