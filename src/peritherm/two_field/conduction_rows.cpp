#include "peritherm/two_field/conduction_rows.hpp"

#include <algorithm>
#include <limits>

namespace peritherm {
namespace {

using RowEntry = GradientClasses::Entry;

std::size_t neighbour_of(std::size_t point, PointIndex distance) {
  return point + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(distance));
}

/// left · tensor_a · right_a + …, summed into one row of columns counted from a point.
class RowSum {
 public:
  RowSum(const GradientClasses& gradient, const Tensor& tensor, double stabilisation)
      : gradient_(gradient),
        tensor_(tensor),
        stabilisation_(stabilisation),
        sums_(gradient.points()),
        is_open_(gradient.points()) {}

  std::vector<PatternRows::Entry> row(std::size_t i) {
    open_.clear();
    for (const RowEntry& entry : gradient_.row(i)) {
      const std::size_t j = neighbour_of(i, entry.distance);
      const RowEntry& back = gradient_.entry(j, -entry.distance);
      if (j != i) add(j, -stabilisation_ * (entry.bond + back.bond));
      if (gradient_.is_corrected(j)) {
        add_corrected(j, back);
      } else {
        add_plain(j, back);
      }
    }
    return collected(i);
  }

 private:
  void add(std::size_t column, double value) {
    if (!is_open_[column]) {
      is_open_[column] = 1;
      open_.push_back(static_cast<PointIndex>(column));
    }
    sums_[column] += value;
  }
  /// Where G = G₀ the products with k and with s Q are one; nothing where they cancel, as in the bond-based model.
  void add_plain(std::size_t j, const RowEntry& back) {
    const double volume = gradient_.volume(j);
    const Tensor& spread = gradient_.spread(j);
    Tensor rest{};
    double largest = 0.0;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        rest[a][b] = volume * tensor_[a][b] - stabilisation_ * spread[a][b];
        largest = std::max(largest, std::abs(rest[a][b]));
      }
    }
    constexpr double cancelled = 64.0 * std::numeric_limits<double>::epsilon();
    if (largest <= cancelled * volume * std::abs(stabilisation_)) return;
    const Point left = product(rest, back.corrected);
    for (const RowEntry& entry : gradient_.row(j)) add(neighbour_of(j, entry.distance), dot(left, entry.corrected));
  }
  void add_corrected(std::size_t j, const RowEntry& back) {
    const double volume = gradient_.volume(j);
    const Point left = product(tensor_, back.corrected);
    const Point spread = product(gradient_.spread(j), back.uncorrected);
    Point change{};
    for (int a = 0; a < 3; ++a) change[a] = back.corrected[a] - back.uncorrected[a];
    const Point spread_change = product(gradient_.spread(j), change);
    for (const RowEntry& entry : gradient_.row(j)) {
      double value = volume * dot(left, entry.corrected) - stabilisation_ * dot(spread, entry.uncorrected);
      for (int a = 0; a < 3; ++a) {
        value += stabilisation_ * spread_change[a] * (entry.corrected[a] - entry.uncorrected[a]);
      }
      add(neighbour_of(j, entry.distance), value);
    }
  }
  /// The diagonal is minus the sum of the others, so that constants give nothing.
  std::vector<PatternRows::Entry> collected(std::size_t i) {
    add(i, 0.0);
    std::sort(open_.begin(), open_.end());
    std::vector<PatternRows::Entry> result;
    result.reserve(open_.size());
    double others = 0.0;
    std::size_t self = 0;
    for (const PointIndex column : open_) {
      if (static_cast<std::size_t>(column) == i) {
        self = result.size();
      } else {
        others += sums_[column];
      }
      result.push_back({column - static_cast<PointIndex>(i), sums_[column]});
      sums_[column] = 0.0;
      is_open_[column] = 0;
    }
    result[self].value = -others;
    return result;
  }

  const GradientClasses& gradient_;
  Tensor tensor_;
  double stabilisation_;
  std::vector<double> sums_;
  std::vector<char> is_open_;
  std::vector<PointIndex> open_;
};

}  // namespace

PointClasses classify_surroundings(const GradientClasses& gradient) {
  const PointClasses& classes = *gradient.classes();
  const auto hash = [&](std::size_t i) {
    std::uint64_t sum = static_cast<std::uint64_t>(classes.class_of[i]);
    for (const RowEntry& entry : gradient.row(i)) {
      sum = mixed(sum, static_cast<std::uint64_t>(classes.class_of[neighbour_of(i, entry.distance)]));
    }
    return sum;
  };
  const auto same = [&](std::size_t i, std::size_t j) {
    if (classes.class_of[i] != classes.class_of[j]) return false;
    for (const RowEntry& entry : gradient.row(i)) {
      if (classes.class_of[neighbour_of(i, entry.distance)] != classes.class_of[neighbour_of(j, entry.distance)]) {
        return false;
      }
    }
    return true;
  };
  return classify(gradient.points(), hash, same);
}

PatternRows make_adjoint_rows(const GradientClasses& gradient, std::shared_ptr<const PointClasses> surroundings,
                              int axis) {
  PatternRows result(surroundings);
  std::vector<PatternRows::Entry> row;
  for (const PointIndex example : surroundings->example) {
    const auto i = static_cast<std::size_t>(example);
    row.clear();
    for (const RowEntry& entry : gradient.row(i)) {
      const RowEntry& back = gradient.entry(neighbour_of(i, entry.distance), -entry.distance);
      row.push_back({entry.distance, back.corrected[axis]});
    }
    result.append(row);
  }
  return result;
}

PatternRows make_conduction_rows(const GradientClasses& gradient, std::shared_ptr<const PointClasses> surroundings,
                                 const Tensor& tensor, double stabilisation) {
  PatternRows result(surroundings);
  std::vector<std::vector<PatternRows::Entry>> rows(surroundings->size());
  const auto count = static_cast<std::int64_t>(rows.size());
#pragma omp parallel if (count > 256)
  {
    RowSum sum(gradient, tensor, stabilisation);
#pragma omp for schedule(dynamic, 64)
    for (std::int64_t n = 0; n < count; ++n) rows[n] = sum.row(static_cast<std::size_t>(surroundings->example[n]));
  }
  for (auto& row : rows) {
    result.append(row);
    row = {};
  }
  return result;
}

}  // namespace peritherm
