#include "peritherm/reduction/sparse_heat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/base/error.hpp"
#include "peritherm/base/field_storage.hpp"

namespace peritherm {
namespace {

/// Points that may exchange heat lie within `reach` of each other along each axis, mirrored ones included. So a point
/// of the grid meets one point of each colour at most.
class ColouredProbe {
 public:
  ColouredProbe(ThermalSystem& system, const PaddedGrid& layout, const SparseHeat& heat)
      : system_(system), layout_(layout), heat_(heat), state_(system.size()), rates_(system.size()) {
    for (int axis = 0; axis < 3; ++axis) {
      reach_[axis] = layout.padding(axis);
      period_[axis] = std::min(2 * reach_[axis] + 1, layout.grid().count(axis));
    }
    number_of_.assign(layout.grid().size(), -1);
    for (std::size_t k = 0; k < heat.size(); ++k)
      number_of_[static_cast<std::size_t>(heat.points[k])] = static_cast<std::int32_t>(k);
  }

  /// Calls visit(i, j, K_ij) for all that may differ from 0.
  template <class Visit>
  void operator()(const Visit& visit) {
    for (int z = 0; z < period_[2]; ++z) {
      for (int y = 0; y < period_[1]; ++y) {
        for (int x = 0; x < period_[0]; ++x) probe({x, y, z}, visit);
      }
    }
  }

 private:
  template <class Visit>
  void probe(const GridIndex& colour, const Visit& visit) {
    std::fill(state_.begin(), state_.end(), 0.0);
    for (const std::int64_t point : heat_.points) {
      const GridIndex p = layout_.grid().index(static_cast<std::size_t>(point));
      if (p[0] % period_[0] != colour[0] || p[1] % period_[1] != colour[1] || p[2] % period_[2] != colour[2]) continue;
      state_[layout_.entry(p)] = 1.0;
    }
    system_.combine_linear(-1, state_, -1.0, {}, rates_);
    for (std::size_t i = 0; i < heat_.size(); ++i) {
      const GridIndex p = layout_.grid().index(static_cast<std::size_t>(heat_.points[i]));
      const double rate = rates_[layout_.entry(p)];
      if (rate == 0.0) continue;
      const GridIndex q = nearest(p, colour);
      if (!layout_.grid().contains(q)) continue;
      const std::int32_t j = number_of_[layout_.grid().number(q)];
      if (j >= 0) visit(i, static_cast<std::size_t>(j), heat_.capacities[i] * rate);
    }
  }

  /// The one place of a colour within reach.
  GridIndex nearest(const GridIndex& p, const GridIndex& colour) const {
    GridIndex q{};
    for (int axis = 0; axis < 3; ++axis) {
      const int period = period_[axis];
      const int low = p[axis] - reach_[axis];
      // Short axes have a colour for each of their points.
      if (period == layout_.grid().count(axis)) {
        q[axis] = colour[axis];
        continue;
      }
      q[axis] = low + ((colour[axis] - low) % period + period) % period;
    }
    return q;
  }

  ThermalSystem& system_;
  const PaddedGrid& layout_;
  const SparseHeat& heat_;
  FieldStorage state_, rates_;
  std::vector<std::int32_t> number_of_;
  GridIndex reach_{}, period_{};
};

/// Sums that cancel, and transforms, leave rounding where there is no bond; relative to the fastest point's loss.
class RoundingLevel {
 public:
  RoundingLevel(const SparseHeat& heat, const std::vector<double>& diagonal) : capacities_(heat.capacities) {
    for (std::size_t i = 0; i < diagonal.size(); ++i) rate_ = std::max(rate_, share * diagonal[i] / capacities_[i]);
  }
  bool covers(std::size_t i, std::size_t j, double value) const {
    return std::abs(value) <= rate_ * std::sqrt(capacities_[i] * capacities_[j]);
  }
  /// What is left of a row whose bonds cancel: their rounding adds up.
  bool covers_sum(std::size_t i, double value) const { return std::abs(value) <= 100.0 * rate_ * capacities_[i]; }

 private:
  static constexpr double share = 1e-14;
  const std::vector<double>& capacities_;
  double rate_ = 0.0;
};

void sort_rows(SparseMatrix& matrix) {
  std::vector<std::pair<std::int32_t, double>> row;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    row.clear();
    for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n)
      row.emplace_back(matrix.column_of[n], matrix.values[n]);
    std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    auto n = static_cast<std::size_t>(matrix.begin[i]);
    for (const auto& [column, value] : row) {
      matrix.column_of[n] = column;
      matrix.values[n++] = value;
    }
  }
}

std::size_t find_entry(const SparseMatrix& matrix, std::size_t row, std::size_t column) {
  const auto first = matrix.column_of.begin() + matrix.begin[row];
  const auto last = matrix.column_of.begin() + matrix.begin[row + 1];
  const auto found = std::lower_bound(first, last, static_cast<std::int32_t>(column));
  return found != last && *found == static_cast<std::int32_t>(column)
             ? static_cast<std::size_t>(found - matrix.column_of.begin())
             : std::numeric_limits<std::size_t>::max();
}

/// Both entries of a pair become their mean, and the diagonal what makes the sum of the row the loss, so that constants
/// stay what they are.
void balance(SparseHeat& heat) {
  SparseMatrix& matrix = heat.conductances;
  std::vector<std::size_t> diagonals(heat.size());
  std::vector<double> sums(heat.size(), 0.0);
  for (std::size_t i = 0; i < heat.size(); ++i) {
    for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n) {
      const auto j = static_cast<std::size_t>(matrix.column_of[n]);
      if (j == i) diagonals[i] = n;
      if (j == i) continue;
      const std::size_t other = find_entry(matrix, j, i);
      if (other == std::numeric_limits<std::size_t>::max()) matrix.values[n] = 0.0;
      if (j > i || matrix.values[n] == 0.0) continue;
      matrix.values[n] = matrix.values[other] = 0.5 * (matrix.values[n] + matrix.values[other]);
      sums[i] += matrix.values[n];
      sums[j] += matrix.values[n];
    }
  }
  for (std::size_t i = 0; i < heat.size(); ++i) matrix.values[diagonals[i]] = heat.losses[i] - sums[i];
}

std::vector<double> find_losses(ThermalSystem& system, const PaddedGrid& layout, const SparseHeat& heat) {
  FieldStorage ones(system.size()), rates(system.size());
  std::fill_n(ones.begin(), system.field_size(), 1.0);
  system.combine_linear(-1, ones, -1.0, {}, rates);
  std::vector<double> losses(heat.size());
  for (std::size_t i = 0; i < heat.size(); ++i) {
    const std::size_t entry = layout.entry(layout.grid().index(static_cast<std::size_t>(heat.points[i])));
    losses[i] = heat.capacities[i] * rates[entry];
  }
  return losses;
}

void require_symmetry(const ThermalSystem& system) {
  if (system.is_symmetric()) return;
  throw Error(
      "this reduction needs bonds that conduct alike both ways, and some of this body do not",
      "Points that follow others (slaved faces, flux formulas) and self terms on open faces make them so; choose "
      "another scheme there, or the method proper_orthogonal");
}

}  // namespace

SparseHeat make_sparse_heat(ThermalSystem& system, const PaddedGrid& layout, ConstField point_capacities) {
  require_symmetry(system);
  SparseHeat heat;
  for (std::size_t n = 0; n < point_capacities.size(); ++n) {
    if (point_capacities[n] <= 0.0) continue;
    heat.points.push_back(static_cast<std::int64_t>(n));
    heat.capacities.push_back(point_capacities[n]);
  }
  ColouredProbe probe(system, layout, heat);
  std::vector<double> diagonal(heat.size(), 0.0);
  std::vector<std::int64_t> fill(heat.size() + 1, 0);
  // Points that lost every bond keep their place.
  probe([&](std::size_t i, std::size_t j, double value) {
    if (i == j) diagonal[i] = value;
  });
  const RoundingLevel level(heat, diagonal);
  probe([&](std::size_t i, std::size_t j, double value) {
    if (i != j && !level.covers(i, j, value)) ++fill[i + 1];
  });
  for (std::size_t i = 0; i < heat.size(); ++i) fill[i + 1] += fill[i] + 1;
  SparseMatrix& matrix = heat.conductances;
  matrix.columns = heat.size();
  matrix.begin = fill;
  matrix.column_of.resize(static_cast<std::size_t>(fill.back()));
  matrix.values.resize(matrix.column_of.size());
  const auto put = [&](std::size_t i, std::size_t j, double value) {
    const auto place = static_cast<std::size_t>(fill[i]++);
    matrix.column_of[place] = static_cast<std::int32_t>(j);
    matrix.values[place] = value;
  };
  for (std::size_t i = 0; i < heat.size(); ++i) put(i, i, diagonal[i]);
  probe([&](std::size_t i, std::size_t j, double value) {
    if (i != j && !level.covers(i, j, value)) put(i, j, value);
  });
  sort_rows(matrix);
  heat.losses = find_losses(system, layout, heat);
  for (std::size_t i = 0; i < heat.size(); ++i) {
    if (level.covers_sum(i, heat.losses[i])) heat.losses[i] = 0.0;
  }
  balance(heat);
  return heat;
}

void add_product(const SparseMatrix& matrix, ConstField vector, Field result) {
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    double sum = 0.0;
    for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n)
      sum += matrix.values[n] * vector[static_cast<std::size_t>(matrix.column_of[n])];
    result[i] += sum;
  }
}

void add_transposed_product(const SparseMatrix& matrix, ConstField vector, Field result) {
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n)
      result[static_cast<std::size_t>(matrix.column_of[n])] += matrix.values[n] * vector[i];
  }
}

SparseMatrix part_of(const SparseMatrix& matrix, const std::vector<std::int32_t>& rows,
                     const std::vector<std::int32_t>& columns) {
  std::vector<std::int32_t> number_of(matrix.columns, -1);
  for (std::size_t k = 0; k < columns.size(); ++k)
    number_of[static_cast<std::size_t>(columns[k])] = static_cast<std::int32_t>(k);
  SparseMatrix part;
  part.columns = columns.size();
  for (const std::int32_t row : rows) {
    const auto i = static_cast<std::size_t>(row);
    for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n) {
      const std::int32_t column = number_of[static_cast<std::size_t>(matrix.column_of[n])];
      if (column < 0) continue;
      part.column_of.push_back(column);
      part.values.push_back(matrix.values[n]);
    }
    part.begin.push_back(static_cast<std::int64_t>(part.values.size()));
  }
  return part;
}

}  // namespace peritherm
