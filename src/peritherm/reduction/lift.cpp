#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/reduction/answer.hpp"
#include "peritherm/reduction/model_products.hpp"

namespace peritherm {
namespace {

/// The stage that holds at a time; at the end of one, that one.
std::size_t stage_at(const ReducedModel& model, double time) {
  std::size_t stage = 0;
  while (stage + 1 < model.stages.size() && time > model.stages[stage].end) ++stage;
  return stage;
}

double sum_of_squares(ConstField values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// |basis z − basis crossᵀ y'|², without cancellation.
double squared_distance_within(const ReducedModel& model, const ModelState& state) {
  double sum = 0.0;
  for (std::size_t k = 0; k < state.unknowns.size(); ++k) {
    double difference = state.unknowns[k];
    for (std::size_t n = 0; n < state.judge.size(); ++n) difference -= model.judge.cross(n, k) * state.judge[n];
    sum += difference * difference;
  }
  return sum;
}

/// |y' − cross x|², and what the judge's space does not reach, xᵀ products x − |cross x|².
double squared_distance(const ReducedModel& model, const ModelState& state) {
  const ErrorJudge& judge = model.judge;
  std::vector<double> x(state.unknowns);
  x.insert(x.end(), state.inputs.begin(), state.inputs.end());
  std::vector<double> seen(state.judge.size(), 0.0);
  add_product(1.0, judge.cross, x, seen);
  double own = sum_of_squares(state.unknowns);
  if (!judge.products.empty()) {
    own = 0.0;
    for (std::size_t j = 0; j < x.size(); ++j) {
      for (std::size_t i = 0; i < x.size(); ++i) own += x[i] * judge.products(i, j) * x[j];
    }
  }
  const double beyond = std::max(own - sum_of_squares(seen), 0.0);
  for (std::size_t n = 0; n < seen.size(); ++n) seen[n] -= state.judge[n];
  return sum_of_squares(seen) + beyond;
}

double weighted_sum(const std::vector<double>& weights, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * values[k];
  return sum;
}

void add_scaled(double factor, const std::vector<double>& row, std::vector<double>& sum) {
  for (std::size_t k = 0; k < row.size(); ++k) sum[k] += factor * row[k];
}

std::vector<double> matrix_row(const Matrix& matrix, std::size_t row) {
  std::vector<double> values(matrix.columns);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = matrix(row, k);
  return values;
}

}  // namespace

double ModelProbe::temperature(const ModelState& state, double level) const {
  return level + weighted_sum(unknowns, state.unknowns) + weighted_sum(inputs, state.inputs);
}

double ModelProbe::estimated_error(const ModelState& state) const {
  if (judge.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(weighted_sum(unknowns, state.unknowns) + weighted_sum(judged_inputs, state.inputs) -
                  weighted_sum(judge, state.judge));
}

ModelProbe make_probe(const ReducedModel& model, std::span<const PointWeight> weights) {
  const std::size_t unknowns = model.unknowns(), inputs = model.inputs(), judges = model.judge.equations.size();
  ModelProbe probe{std::vector<double>(unknowns, 0.0), std::vector<double>(inputs, 0.0),
                   std::vector<double>(judges, 0.0), std::vector<double>(inputs, 0.0)};
  for (const auto& [number, weight] : weights) {
    const auto point = static_cast<std::size_t>(number);
    add_scaled(weight, basis_row(model.basis, point), probe.unknowns);
    const std::vector<double> direct = matrix_row(model.direct, point);
    add_scaled(weight, direct, probe.inputs);
    if (judges == 0 || judge_is_within(model) || model.capacities[point] == 0.0) continue;
    add_scaled(weight, direct, probe.judged_inputs);
    add_scaled(weight, matrix_row(model.judge.start, point), probe.judge);
  }
  if (judges > 0 && judge_is_within(model)) {
    for (std::size_t n = 0; n < judges; ++n) {
      for (std::size_t k = 0; k < unknowns; ++k) probe.judge[n] += model.judge.cross(n, k) * probe.unknowns[k];
    }
  }
  return probe;
}

void lift(const ReducedModel& model, const ModelState& state, double level, Field temperatures) {
  std::fill(temperatures.begin(), temperatures.end(), level);
  add_lifted(model.basis, state.unknowns, temperatures);
  std::vector<bool> reached(model.capacities.size(), false);
  for (std::size_t m = 0; m < model.direct.columns; ++m) {
    const ConstField column = model.direct.column(m);
    for (std::size_t n = 0; n < column.size(); ++n) {
      if (column[n] == 0.0) continue;
      temperatures[n] += state.inputs[m] * column[n];
      reached[n] = true;
    }
  }
  // Neither heat nor a load sets the temperature of a point that is cut away.
  for (std::size_t n = 0; n < reached.size(); ++n) {
    if (model.capacities[n] == 0.0 && !reached[n]) temperatures[n] = 0.0;
  }
}

double estimated_error(const ReducedModel& model, const ModelState& state) {
  if (state.judge.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double squared =
      judge_is_within(model) ? squared_distance_within(model, state) : squared_distance(model, state);
  return (std::sqrt(squared) + state.left_out) / std::sqrt(model.heat.heat_capacity);
}

std::vector<double> heat_rates(const ReducedModel& model, const ModelState& state) {
  std::vector<double> rates(model.heat.names.size(), 0.0);
  add_heat_rates(model, stage_at(model, state.time), state.unknowns, state.inputs, rates);
  return rates;
}

double stored_heat(const ReducedModel& model, const ModelState& state, double level) {
  return model.heat.heat_capacity * level + weighted_sum(model.heat.stored_modes, state.unknowns) +
         weighted_sum(model.heat.stored_inputs, state.inputs);
}

}  // namespace peritherm
