#include "peritherm/reduction/galerkin.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

namespace peritherm {
namespace {

Matrix multiply(const Matrix& a, const Matrix& b) {
  Matrix product(a.rows, b.columns);
  const Eigen::Map<const Eigen::MatrixXd> left(a.values.data(), static_cast<Eigen::Index>(a.rows),
                                               static_cast<Eigen::Index>(a.columns));
  const Eigen::Map<const Eigen::MatrixXd> right(b.values.data(), static_cast<Eigen::Index>(b.rows),
                                                static_cast<Eigen::Index>(b.columns));
  Eigen::Map<Eigen::MatrixXd>(product.values.data(), left.rows(), right.cols()).noalias() = left * right;
  return product;
}

Matrix transposed(const Matrix& a) {
  Matrix result(a.columns, a.rows);
  for (std::size_t i = 0; i < a.rows; ++i) {
    for (std::size_t j = 0; j < a.columns; ++j) result(j, i) = a(i, j);
  }
  return result;
}

/// The entries behind the field: one column per state.
Matrix account_columns(const std::vector<ConstField>& states, std::size_t field_size) {
  Matrix accounts(states.empty() ? 0 : states.front().size() - field_size, states.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    std::copy(states[k].begin() + static_cast<std::ptrdiff_t>(field_size), states[k].end(), accounts.column(k).begin());
  }
  return accounts;
}

std::vector<ConstField> views_of(const std::vector<FieldStorage>& states) { return {states.begin(), states.end()}; }

HeatOutputs make_heat_outputs(const HeatBasis& basis, const InputStates& inputs, const Matrix& modes) {
  HeatSystem& system = basis.system();
  HeatOutputs heat;
  heat.names = system.account_names();
  heat.modes = multiply(account_columns(basis.rates(), system.field_size()), modes);
  heat.inputs = account_columns(views_of(inputs.rates), system.field_size());
  heat.inputs.rows = heat.names.size();
  Matrix stored(1, basis.size());
  const FieldStorage ones = [&] {
    FieldStorage field(system.size());
    std::fill(field.begin(), field.end(), 1.0);
    return field;
  }();
  stored.values = basis.coordinates(ones);
  heat.stored_modes = multiply(stored, modes).values;
  heat.stored_inputs.assign(inputs.rates.size(), 0.0);
  heat.heat_capacity = system.heat_capacity();
  return heat;
}

}  // namespace

InputStates make_input_states(const FullSystem& full) {
  InputStates states;
  for (const Load& load : full.loads) {
    for (const LoadShape& shape : load.shapes) {
      states.held.emplace_back(full.system.size());
      states.rates.emplace_back(full.system.size());
      full.system.load_rate({load.boundary, load.source}, shape.profile, shape.time, states.held.back(),
                            states.rates.back());
    }
  }
  return states;
}

Matrix input_gains(const HeatBasis& basis, const InputStates& inputs) {
  return weighted_products(basis.capacities(), basis.states(), views_of(inputs.rates));
}

ProjectedEquations project_equations(const HeatBasis& basis, std::size_t count, const Matrix& gains) {
  const std::size_t conserved = std::min(count, basis.conserved());
  const auto rest = static_cast<Eigen::Index>(count - conserved);
  const Matrix conduction = basis.conduction(count);
  const Eigen::Map<const Eigen::MatrixXd> all(conduction.values.data(), static_cast<Eigen::Index>(count),
                                              static_cast<Eigen::Index>(count));
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  if (rest > 0) solver.compute(all.bottomRightCorner(rest, rest));
  ProjectedEquations projected{{std::vector<double>(count, 0.0), {}, {}}, Matrix(count, count)};
  for (std::size_t k = 0; k < conserved; ++k) projected.modes(k, k) = 1.0;
  for (std::size_t k = conserved; k < count; ++k) {
    const auto mode = static_cast<Eigen::Index>(k - conserved);
    // Conduction dissipates: what is below 0 is rounding.
    projected.equations.rates[k] = std::max(0.0, solver.eigenvalues()[mode]);
    for (std::size_t i = conserved; i < count; ++i) {
      projected.modes(i, k) = solver.eigenvectors()(static_cast<Eigen::Index>(i - conserved), mode);
    }
  }
  Matrix own(count, gains.columns);
  for (std::size_t m = 0; m < gains.columns; ++m) std::copy_n(gains.column(m).begin(), count, own.column(m).begin());
  projected.equations.gains = multiply(transposed(projected.modes), own);
  return projected;
}

Matrix gather_columns(const PaddedGrid& layout, const std::vector<ConstField>& states, const Matrix& modes) {
  const Grid& grid = layout.grid();
  Matrix columns(grid.size(), modes.columns);
  const auto length = static_cast<std::size_t>(grid.count(0));
  const auto rows = static_cast<std::int64_t>(grid.size() / length);
#pragma omp parallel for schedule(static)
  for (std::int64_t row = 0; row < rows; ++row) {
    const int y = static_cast<int>(row % grid.count(1)), z = static_cast<int>(row / grid.count(1));
    const std::size_t entry = layout.entry({0, y, z});
    for (std::size_t column = 0; column < modes.columns; ++column) {
      double* const target = columns.column(column).data() + static_cast<std::size_t>(row) * length;
      for (std::size_t k = 0; k < states.size(); ++k) {
        const double weight = modes(k, column);
        if (weight == 0.0) continue;
        const double* const source = states[k].data() + entry;
#pragma omp simd
        for (std::size_t n = 0; n < length; ++n) target[n] += weight * source[n];
      }
    }
  }
  return columns;
}

void fill_model(const HeatBasis& basis, const InputStates& inputs, const FullSystem& full, std::size_t judged,
                ReducedModel& model) {
  const Matrix gains = input_gains(basis, inputs);
  ProjectedEquations projected = project_equations(basis, basis.size(), gains);
  model.loads = full.loads;
  model.basis.dense = gather_columns(full.layout, basis.states(), projected.modes);
  model.heat = make_heat_outputs(basis, inputs, projected.modes);
  Matrix identity(inputs.held.size(), inputs.held.size());
  for (std::size_t m = 0; m < identity.rows; ++m) identity(m, m) = 1.0;
  model.direct = gather_columns(full.layout, views_of(inputs.held), identity);
  model.capacities.resize(full.layout.grid().size());
  full.layout.gather(basis.capacities(), model.capacities);
  model.shortest_time = full.shortest_time;
  model.longest_time = full.longest_time;
  model.judge = {};
  model.stages.clear();
  if (judged > 0) {
    ProjectedEquations judge = project_equations(basis, judged, gains);
    // The judge's states are among the model's; the modes of both turn them.
    Matrix shared(judged, basis.size());
    for (std::size_t k = 0; k < basis.size(); ++k) {
      std::copy_n(projected.modes.column(k).begin(), judged, shared.column(k).begin());
    }
    const Matrix cross = multiply(transposed(judge.modes), shared);
    model.judge.cross = Matrix(judged, basis.size() + inputs.held.size());
    std::copy(cross.values.begin(), cross.values.end(), model.judge.cross.values.begin());
    model.judge.equations = std::move(judge.equations);
  }
  ModalStage& stage = model.stages.emplace_back();
  stage.end = std::numeric_limits<double>::infinity();
  stage.equations = std::move(projected.equations);
}

}  // namespace peritherm
