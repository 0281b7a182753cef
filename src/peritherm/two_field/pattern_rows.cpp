#include "peritherm/two_field/pattern_rows.hpp"

#include <algorithm>

namespace peritherm {
namespace {

/// So many sums are kept in the nearest cache while offset after offset is added.
constexpr PointIndex longest_piece = 512;
/// Shorter runs are summed point by point.
constexpr PointIndex shortest_block = 8;

/// sums[k] += Σ_n values[n] · field[k + distances[n]], four offsets at a time.
void add_offsets(const PointIndex* distances, const double* values, std::int64_t count, const double* field,
                 PointIndex length, double* sums) {
  std::int64_t n = 0;
  for (; n + 4 <= count; n += 4) {
    const double* a = field + distances[n];
    const double* b = field + distances[n + 1];
    const double* c = field + distances[n + 2];
    const double* d = field + distances[n + 3];
    const double of_a = values[n], of_b = values[n + 1], of_c = values[n + 2], of_d = values[n + 3];
    for (PointIndex k = 0; k < length; ++k) {
      sums[k] = sums[k] + of_a * a[k] + of_b * b[k] + of_c * c[k] + of_d * d[k];
    }
  }
  for (; n < count; ++n) {
    const double* a = field + distances[n];
    for (PointIndex k = 0; k < length; ++k) sums[k] += values[n] * a[k];
  }
}

}  // namespace

PatternRows::PatternRows(std::shared_ptr<const PointClasses> classes) : classes_(std::move(classes)) {
  begin_.reserve(classes_->size() + 1);
  for (const PointClasses::Run& run : classes_->runs) {
    for (PointIndex begin = run.begin; begin < run.end; begin += longest_piece) {
      pieces_.push_back({begin, std::min(run.end, begin + longest_piece), run.number});
    }
  }
}

void PatternRows::append(const std::vector<Entry>& row) {
  for (const Entry& entry : row) {
    distances_.push_back(entry.distance);
    values_.push_back(entry.value);
  }
  begin_.push_back(static_cast<std::int64_t>(values_.size()));
}

void PatternRows::add_piece(const Piece& piece, double factor, const double* field, double* result) const {
  const auto first = static_cast<std::size_t>(begin_[piece.number]);
  const std::int64_t count = begin_[piece.number + 1] - begin_[piece.number];
  const PointIndex* distances = distances_.data() + first;
  const double* values = values_.data() + first;
  const PointIndex length = piece.end - piece.begin;
  if (length >= shortest_block) {
    std::array<double, longest_piece> sums;
    std::fill_n(sums.begin(), length, 0.0);
    add_offsets(distances, values, count, field + piece.begin, length, sums.data());
    for (PointIndex k = 0; k < length; ++k) result[piece.begin + k] += factor * sums[k];
    return;
  }
  for (PointIndex i = piece.begin; i < piece.end; ++i) {
    double sum = 0.0;
    for (std::int64_t n = 0; n < count; ++n) sum += values[n] * field[i + distances[n]];
    result[i] += factor * sum;
  }
}

void PatternRows::add_product(double factor, ConstField field, Field result) const {
  const auto count = static_cast<std::int64_t>(pieces_.size());
#pragma omp parallel for schedule(static) if (size() > 4096)
  for (std::int64_t p = 0; p < count; ++p) add_piece(pieces_[p], factor, field.data(), result.data());
}

void PatternRows::row(std::size_t i, std::vector<PointIndex>& columns, std::vector<double>& values) const {
  const PointIndex number = classes_->class_of[i];
  columns.clear();
  values.clear();
  for (std::int64_t n = begin_[number]; n < begin_[number + 1]; ++n) {
    columns.push_back(static_cast<PointIndex>(i) + distances_[n]);
    values.push_back(values_[n]);
  }
}

double PatternRows::diagonal(std::size_t i) const {
  const PointIndex number = classes_->class_of[i];
  const auto first = distances_.begin() + begin_[number];
  const auto last = distances_.begin() + begin_[number + 1];
  const auto found = std::lower_bound(first, last, 0);
  return found != last && *found == 0 ? values_[static_cast<std::size_t>(found - distances_.begin())] : 0.0;
}

SparseMatrix PatternRows::matrix() const {
  SparseMatrix result;
  result.columns = size();
  std::vector<PointIndex> columns;
  std::vector<double> values;
  for (std::size_t i = 0; i < size(); ++i) {
    row(i, columns, values);
    result.column_of.insert(result.column_of.end(), columns.begin(), columns.end());
    result.values.insert(result.values.end(), values.begin(), values.end());
    result.begin.push_back(static_cast<std::int64_t>(result.values.size()));
  }
  return result;
}

std::size_t PatternRows::bytes() const {
  return pieces_.size() * sizeof(Piece) + begin_.size() * sizeof(std::int64_t) +
         values_.size() * (sizeof(double) + sizeof(PointIndex));
}

}  // namespace peritherm
