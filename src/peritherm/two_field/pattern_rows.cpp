#include "peritherm/two_field/pattern_rows.hpp"

#include <algorithm>

#include "peritherm/operators/kernels.hpp"

namespace peritherm {
namespace {

/// Shares of the work among threads.
constexpr PointIndex longest_piece = 2048;

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

void PatternRows::add_product(double factor, ConstField field, Field result) const {
  const auto add_pattern = available_kernels().front().add_pattern;
  const auto count = static_cast<std::int64_t>(pieces_.size());
#pragma omp parallel for schedule(static) if (size() > 4096)
  for (std::int64_t p = 0; p < count; ++p) {
    const Piece& piece = pieces_[p];
    const std::int64_t first = begin_[piece.number];
    const PatternRow row{distances_.data() + first, values_.data() + first, begin_[piece.number + 1] - first};
    add_pattern(row, factor, field.data() + piece.begin, piece.end - piece.begin, result.data() + piece.begin);
  }
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
