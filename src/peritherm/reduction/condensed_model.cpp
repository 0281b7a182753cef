#include <algorithm>
#include <cmath>

#include "peritherm/reduction/condensation.hpp"
#include "peritherm/reduction/symmetric_modes.hpp"

namespace peritherm {
namespace {

/// One row of a sparse matrix, spread out.
class SpreadRow {
 public:
  explicit SpreadRow(std::size_t columns) : values_(columns, 0.0), used_(columns, false) {}

  void add(const SparseMatrix& matrix, std::size_t row, double factor) {
    for (auto n = static_cast<std::size_t>(matrix.begin[row]); n < static_cast<std::size_t>(matrix.begin[row + 1]);
         ++n) {
      const auto column = static_cast<std::size_t>(matrix.column_of[n]);
      if (!used_[column]) {
        used_[column] = true;
        columns_.push_back(column);
      }
      values_[column] += factor * matrix.values[n];
    }
  }
  void sort() { std::sort(columns_.begin(), columns_.end()); }
  void clear() {
    for (const std::size_t column : columns_) {
      values_[column] = 0.0;
      used_[column] = false;
    }
    columns_.clear();
  }
  const std::vector<std::size_t>& columns() const { return columns_; }
  double operator[](std::size_t column) const { return values_[column]; }

 private:
  std::vector<double> values_;
  std::vector<char> used_;
  std::vector<std::size_t> columns_;
};

/// The lower half of shapesᵀ · matrix · shapes.
Matrix project(const SparseMatrix& shapes, const SparseMatrix& matrix) {
  Matrix result(shapes.columns, shapes.columns);
  SpreadRow row(shapes.columns);
  for (std::size_t i = 0; i < shapes.rows(); ++i) {
    row.clear();
    for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n)
      row.add(shapes, static_cast<std::size_t>(matrix.column_of[n]), matrix.values[n]);
    row.sort();
    for (auto n = static_cast<std::size_t>(shapes.begin[i]); n < static_cast<std::size_t>(shapes.begin[i + 1]); ++n) {
      const auto a = static_cast<std::size_t>(shapes.column_of[n]);
      const Field column = result.column(a);
      const auto first = std::lower_bound(row.columns().begin(), row.columns().end(), a);
      for (auto b = first; b != row.columns().end(); ++b) column[*b] += shapes.values[n] * row[*b];
    }
  }
  return result;
}

SparseMatrix diagonal_matrix(std::span<const double> values) {
  SparseMatrix matrix;
  matrix.columns = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    matrix.column_of.push_back(static_cast<std::int32_t>(i));
    matrix.values.push_back(values[i]);
    matrix.begin.push_back(static_cast<std::int64_t>(i + 1));
  }
  return matrix;
}

Matrix transposed_product(const SparseMatrix& sparse, const Matrix& matrix) {
  Matrix result(sparse.columns, matrix.columns);
  for (std::size_t k = 0; k < matrix.columns; ++k) add_transposed_product(sparse, matrix.column(k), result.column(k));
  return result;
}

Matrix transposed_product(const Matrix& left, const Matrix& right) {
  Matrix result(left.columns, right.columns);
  for (std::size_t k = 0; k < right.columns; ++k) {
    const ConstField column = right.column(k);
    for (std::size_t j = 0; j < left.columns; ++j) {
      const ConstField other = left.column(j);
      double sum = 0.0;
      for (std::size_t i = 0; i < column.size(); ++i) sum += other[i] * column[i];
      result(j, k) = sum;
    }
  }
  return result;
}

/// Rows of the free points among those of the grid.
SparseMatrix over_grid(const SparseMatrix& shapes, const SparseHeat& heat, std::size_t points) {
  SparseMatrix result{shapes.columns, {0}, shapes.column_of, shapes.values};
  std::size_t i = 0;
  for (std::size_t point = 0; point < points; ++point) {
    if (i < heat.size() && heat.points[i] == static_cast<std::int64_t>(point)) ++i;
    result.begin.push_back(shapes.begin[i]);
  }
  return result;
}

class CondensedModelBuilder {
 public:
  CondensedModelBuilder(FullSystem& full, const SplitHeat& split, const UnitLoads& loads, CondensedParts parts)
      : full_(full), heat_(split.heat), split_(split), loads_(loads), parts_(std::move(parts)) {}

  ReducedModel operator()(ReductionCost& cost) {
    Lap lap;
    const Matrix conductances = condensed_conductances(split_, parts_.shapes);
    Matrix capacities = project(parts_.shapes, diagonal_matrix(heat_.capacities));
    find_sums();
    const bool lumped = parts_.capacity == CondensedCapacity::lumped;
    if (lumped) {
      capacities = Matrix(sums_.size(), sums_.size());
      for (std::size_t k = 0; k < sums_.size(); ++k) capacities(k, k) = sums_[k];
      model_.lumped_capacities = sums_;
    }
    cost.peak_bytes = std::max(cost.peak_bytes, split_.factor.bytes() + bytes_of(conductances));
    cost.projection += lap();
    SymmetricModes modes = all_modes(conductances, capacities);
    cost.modes += lap();
    modes_ = std::move(modes.shapes);
    fill_equations(std::move(modes.rates), lumped);
    fill_shapes();
    fill_heat();
    cost.projection += lap();
    return std::move(model_);
  }

 private:
  /// Rows, entries of the dense matrices and what the eigenvalue problem copies of them.
  std::size_t bytes_of(const Matrix& matrix) const {
    return parts_.shapes.values.size() * 12 + matrix.values.size() * sizeof(double) * 6;
  }

  /// Σ C of each shape; where R · 1 = 1 it is the sum of a row of the reduced capacities, held points included.
  void find_sums() {
    sums_.assign(parts_.shapes.columns, 0.0);
    add_transposed_product(parts_.shapes, heat_.capacities, sums_);
  }

  void fill_equations(std::vector<double> rates, bool lumped) {
    // What is singular without rounding must not grow with it.
    for (double& rate : rates) rate = std::max(rate, 0.0);
    const std::size_t inputs = loads_.kinds.size();
    Matrix remaining = loads_.heat;
    Matrix stored = parts_.statics;
    for (std::size_t m = 0; m < inputs; ++m) {
      std::vector<double> conducted(heat_.size(), 0.0);
      add_product(heat_.conductances, parts_.statics.column(m), conducted);
      for (std::size_t i = 0; i < heat_.size(); ++i) {
        remaining(i, m) -= conducted[i];
        stored(i, m) *= heat_.capacities[i];
      }
    }
    ModalEquations equations;
    equations.gains = transposed_product(modes_, transposed_product(parts_.shapes, remaining));
    const Matrix shares = transposed_product(modes_, transposed_product(parts_.shapes, stored));
    derivative_gains_ = Matrix(rates.size(), inputs);
    // Lumped capacities have what the static responses store in the retained points already.
    if (!lumped) {
      for (std::size_t n = 0; n < shares.values.size(); ++n) derivative_gains_.values[n] = -shares.values[n];
      for (std::size_t m = 0; m < inputs; ++m) {
        for (std::size_t k = 0; k < rates.size(); ++k) equations.gains(k, m) += rates[k] * shares(k, m);
      }
      if (parts_.start == ModelStart::sampled) equations.start_gains = derivative_gains_;
    }
    equations.rates = std::move(rates);
    model_.stages.push_back({std::numeric_limits<double>::infinity(), std::move(equations), {}, {}});
  }

  /// direct = held + statics + shapes · modes · (gains of the derivatives).
  void fill_shapes() {
    const std::size_t points = full_.layout.grid().size();
    model_.direct = loads_.held;
    model_.capacities.assign(points, 0.0);
    for (std::size_t m = 0; m < model_.direct.columns; ++m) {
      std::vector<double> unknowns(modes_.rows, 0.0), follows(heat_.size(), 0.0);
      for (std::size_t k = 0; k < modes_.columns; ++k) {
        for (std::size_t q = 0; q < unknowns.size(); ++q) unknowns[q] += modes_(q, k) * derivative_gains_(k, m);
      }
      add_product(parts_.shapes, unknowns, follows);
      for (std::size_t i = 0; i < heat_.size(); ++i) {
        model_.direct(static_cast<std::size_t>(heat_.points[i]), m) = parts_.statics(i, m) + follows[i];
      }
    }
    for (std::size_t i = 0; i < heat_.size(); ++i)
      model_.capacities[static_cast<std::size_t>(heat_.points[i])] = heat_.capacities[i];
    model_.basis.shapes = over_grid(parts_.shapes, heat_, points);
    model_.basis.modes = modes_;
    for (const std::int32_t r : split_.retained) model_.retained.push_back(heat_.points[static_cast<std::size_t>(r)]);
    model_.start = parts_.start;
    model_.loads = full_.loads;
    model_.shortest_time = full_.shortest_time;
    model_.longest_time = full_.longest_time;
  }

  /// Adds what the temperatures of free points bring through each account.
  void account_for(ConstField temperatures, Field heat_rates) {
    HeatSystem& system = full_.system;
    std::fill(state_.begin(), state_.end(), 0.0);
    for (std::size_t i = 0; i < heat_.size(); ++i) {
      if (temperatures[i] == 0.0) continue;
      state_[full_.layout.entry(full_.layout.grid().index(static_cast<std::size_t>(heat_.points[i])))] =
          temperatures[i];
    }
    system.combine_linear(-1, state_, 1.0, {}, rates_);
    for (std::size_t a = 0; a < heat_rates.size(); ++a) heat_rates[a] += rates_[system.field_size() + a];
  }

  void fill_heat() {
    HeatOutputs& heat = model_.heat;
    heat.names = full_.system.account_names();
    state_ = FieldStorage(full_.system.size());
    rates_ = FieldStorage(full_.system.size());
    // Columns of the shapes stand behind one another in the rows of the transpose.
    std::vector<std::vector<std::pair<std::size_t, double>>> columns(parts_.shapes.columns);
    for (std::size_t i = 0; i < heat_.size(); ++i) {
      for (auto n = static_cast<std::size_t>(parts_.shapes.begin[i]);
           n < static_cast<std::size_t>(parts_.shapes.begin[i + 1]); ++n)
        columns[static_cast<std::size_t>(parts_.shapes.column_of[n])].emplace_back(i, parts_.shapes.values[n]);
    }
    Matrix of_shapes(heat.names.size(), parts_.shapes.columns);
    std::vector<double> temperatures(heat_.size());
    for (std::size_t k = 0; k < columns.size() && !heat.names.empty(); ++k) {
      std::fill(temperatures.begin(), temperatures.end(), 0.0);
      for (const auto& [i, value] : columns[k]) temperatures[i] = value;
      account_for(temperatures, of_shapes.column(k));
    }
    heat.modes = Matrix(heat.names.size(), modes_.columns);
    for (std::size_t k = 0; k < modes_.columns; ++k) {
      for (std::size_t q = 0; q < modes_.rows; ++q) {
        for (std::size_t a = 0; a < heat.names.size(); ++a) heat.modes(a, k) += of_shapes(a, q) * modes_(q, k);
      }
    }
    heat.inputs = loads_.accounts;
    for (std::size_t m = 0; m < loads_.kinds.size(); ++m) {
      for (std::size_t i = 0; i < heat_.size(); ++i)
        temperatures[i] = model_.direct(static_cast<std::size_t>(heat_.points[i]), m);
      account_for(temperatures, heat.inputs.column(m));
      double sum = 0.0;
      for (std::size_t i = 0; i < heat_.size(); ++i) sum += heat_.capacities[i] * temperatures[i];
      heat.stored_inputs.push_back(sum);
    }
    heat.stored_modes.assign(modes_.columns, 0.0);
    for (std::size_t k = 0; k < modes_.columns; ++k) {
      for (std::size_t q = 0; q < modes_.rows; ++q) heat.stored_modes[k] += sums_[q] * modes_(q, k);
    }
    for (const double capacity : heat_.capacities) heat.heat_capacity += capacity;
  }

  FullSystem& full_;
  const SparseHeat& heat_;
  const SplitHeat& split_;
  const UnitLoads& loads_;
  CondensedParts parts_;
  std::vector<double> sums_;
  Matrix modes_;             ///< q × r
  Matrix derivative_gains_;  ///< r × m: what an input's change leaves in the unknowns
  FieldStorage state_, rates_;
  ReducedModel model_;
};

}  // namespace

Matrix condensed_conductances(const SplitHeat& split, const SparseMatrix& shapes) {
  return project(shapes, split.heat.conductances);
}

ReducedModel make_condensed_model(FullSystem& full, const SplitHeat& split, const UnitLoads& loads,
                                  CondensedParts parts, ReductionCost& cost) {
  return CondensedModelBuilder(full, split, loads, std::move(parts))(cost);
}

}  // namespace peritherm
