#include "peritherm/reduction/model_products.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

constexpr std::size_t lifted_rows = 1024;  ///< at once: they stay in the cache while columns are added

/// Calls visit(first row, last row) for blocks of rows, by threads.
template <class Visit>
void for_row_blocks(std::size_t rows, const Visit& visit) {
  const auto blocks = static_cast<std::int64_t>((rows + lifted_rows - 1) / lifted_rows);
#pragma omp parallel for schedule(static) if (blocks > 64)
  for (std::int64_t block = 0; block < blocks; ++block) {
    const std::size_t first = static_cast<std::size_t>(block) * lifted_rows;
    visit(first, std::min(first + lifted_rows, rows));
  }
}

void add_dense_rows(const Matrix& a, ConstField x, std::size_t first, std::size_t last, Field result) {
  for (std::size_t k = 0; k < a.columns; ++k) {
    const double factor = x[k];
    if (factor == 0.0) continue;
    const double* const column = a.values.data() + k * a.rows;
    for (std::size_t n = first; n < last; ++n) result[n] += factor * column[n];
  }
}

double dot(ConstField a, ConstField b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[n];
  return sum;
}

/// shapesᵀ · values.
std::vector<double> shape_product(const SparseMatrix& shapes, ConstField values) {
  std::vector<double> result(shapes.columns, 0.0);
  for (std::size_t n = 0; n < shapes.rows(); ++n) {
    for (std::int64_t k = shapes.begin[n]; k < shapes.begin[n + 1]; ++k) {
      result[static_cast<std::size_t>(shapes.column_of[static_cast<std::size_t>(k)])] +=
          shapes.values[static_cast<std::size_t>(k)] * values[n];
    }
  }
  return result;
}

std::vector<double> shape_values(const SparseMatrix& shapes, ConstField unknowns) {
  std::vector<double> result(shapes.rows(), 0.0);
  for_row_blocks(shapes.rows(), [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      for (std::int64_t k = shapes.begin[n]; k < shapes.begin[n + 1]; ++k) {
        const auto at = static_cast<std::size_t>(k);
        result[n] += shapes.values[at] * unknowns[static_cast<std::size_t>(shapes.column_of[at])];
      }
    }
  });
  return result;
}

std::vector<double> times_capacity(const ReducedModel& model, ConstField values) {
  std::vector<double> result(values.size());
  for (std::size_t n = 0; n < values.size(); ++n) result[n] = model.capacities[n] * values[n];
  return result;
}

/// y = modesᵀ M z0 for the start z0 of the shapes' unknowns; M: lumped, or Σ C shape shape.
std::vector<double> project_shapes(const ReducedModel& model, const std::vector<double>& shape_start) {
  if (!model.lumped_capacities.empty()) {
    std::vector<double> weighted(shape_start);
    for (std::size_t k = 0; k < weighted.size(); ++k) weighted[k] *= model.lumped_capacities[k];
    return transposed_product(model.basis.modes, weighted);
  }
  const std::vector<double> lifted = times_capacity(model, shape_values(model.basis.shapes, shape_start));
  return transposed_product(model.basis.modes, shape_product(model.basis.shapes, lifted));
}

std::vector<double> project_unknowns(const ReducedModel& model, ConstField start) {
  if (model.start == ModelStart::sampled && !model.basis.is_dense() && !model.retained.empty()) {
    // The unknowns of fixed modes stand behind those of the retained points and start at rest.
    std::vector<double> shape_start(model.basis.shapes.columns, 0.0);
    for (std::size_t k = 0; k < model.retained.size(); ++k) {
      shape_start[k] = start[static_cast<std::size_t>(model.retained[k])];
    }
    return project_shapes(model, shape_start);
  }
  return basis_product(model.basis, times_capacity(model, start));
}

}  // namespace

void add_product(double weight, const Matrix& a, ConstField x, std::span<double> result) {
  for (std::size_t k = 0; k < a.columns; ++k) {
    const double factor = weight * x[k];
    const double* const column = a.values.data() + k * a.rows;
    for (std::size_t n = 0; n < a.rows; ++n) result[n] += factor * column[n];
  }
}

std::vector<double> transposed_product(const Matrix& a, ConstField x) {
  std::vector<double> result(a.columns);
  for (std::size_t k = 0; k < a.columns; ++k) result[k] = dot(a.column(k), x);
  return result;
}

void add_lifted(const ModelBasis& basis, ConstField unknowns, Field result) {
  if (basis.is_dense()) {
    for_row_blocks(basis.dense.rows, [&](std::size_t first, std::size_t last) {
      add_dense_rows(basis.dense, unknowns, first, last, result);
    });
    return;
  }
  std::vector<double> shares(basis.modes.rows, 0.0);
  add_product(1.0, basis.modes, unknowns, shares);
  const std::vector<double> lifted = shape_values(basis.shapes, shares);
  for (std::size_t n = 0; n < result.size(); ++n) result[n] += lifted[n];
}

std::vector<double> basis_product(const ModelBasis& basis, ConstField values) {
  if (basis.is_dense()) return transposed_product(basis.dense, values);
  return transposed_product(basis.modes, shape_product(basis.shapes, values));
}

std::vector<double> basis_row(const ModelBasis& basis, std::size_t point) {
  std::vector<double> row(basis.size(), 0.0);
  if (basis.is_dense()) {
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = basis.dense(point, k);
    return row;
  }
  for (std::int64_t at = basis.shapes.begin[point]; at < basis.shapes.begin[point + 1]; ++at) {
    const auto n = static_cast<std::size_t>(at);
    const auto shape = static_cast<std::size_t>(basis.shapes.column_of[n]);
    for (std::size_t k = 0; k < row.size(); ++k) row[k] += basis.shapes.values[n] * basis.modes(shape, k);
  }
  return row;
}

ProjectedStart project_start(const ReducedModel& model, ConstField start) {
  const std::size_t judges = model.judge.equations.size();
  ProjectedStart result{std::vector<double>(model.unknowns(), 0.0), std::vector<double>(judges, 0.0), 0.0};
  if (start.empty()) return result;
  result.unknowns = project_unknowns(model, start);
  std::vector<double> rest(start.size(), 0.0);
  if (judges > 0 && !judge_is_within(model)) {
    result.judge = transposed_product(model.judge.start, times_capacity(model, start));
    add_product(-1.0, model.judge.start, result.judge, rest);
  } else {
    std::vector<double> negative(result.unknowns);
    for (double& value : negative) value = -value;
    add_lifted(model.basis, negative, rest);
    if (judges > 0) {
      for (std::size_t n = 0; n < judges; ++n) {
        for (std::size_t k = 0; k < result.unknowns.size(); ++k) {
          result.judge[n] += model.judge.cross(n, k) * result.unknowns[k];
        }
      }
    }
  }
  double sum = 0.0;
  for (std::size_t n = 0; n < rest.size(); ++n) {
    rest[n] += start[n];
    sum += model.capacities[n] * rest[n] * rest[n];
  }
  result.left_out = std::sqrt(sum);
  return result;
}

void add_heat_rates(const ReducedModel& model, std::size_t stage, ConstField unknowns, ConstField inputs,
                    std::span<double> rates) {
  const Matrix& own = model.stages[stage].heats;
  if (own.empty()) {
    add_product(1.0, model.heat.modes, unknowns, rates);
    add_product(1.0, model.heat.inputs, inputs, rates);
    return;
  }
  for (std::size_t k = 0; k < own.columns; ++k) {
    const double factor = k < unknowns.size() ? unknowns[k] : inputs[k - unknowns.size()];
    for (std::size_t a = 0; a < own.rows; ++a) rates[a] += factor * own(a, k);
  }
}

}  // namespace peritherm
