#pragma once

#include <cmath>
#include <vector>

#include "peritherm/reduction/sparse_heat.hpp"
#include "support/full_case.hpp"

namespace peritherm {

/// A problem whose loads are constant; every load has one shape of value 1. Times from a hundredth of the end on.
class AssembledCase : public FullCase {
 public:
  explicit AssembledCase(const Problem& problem, double level = 0.0)
      : FullCase(problem, {0.01 * problem.time.end, problem.time.end}, level), start_(grid().size()) {
    FullSystem& all = full();
    for (std::size_t m = 0; m < all.loads.size(); ++m) {
      const double value = CompiledProfile(all.profiles[m])(Point{}, 0.0);
      inputs_.push_back(all.loads[m].kind == LoadKind::temperature ? value - level : value);
    }
    all.layout.gather(all.start, start_);
    for (double& value : start_) value -= level;
  }

  HeatSystem& system() { return full().system; }
  const std::vector<double>& inputs() const { return inputs_; }
  /// Minus the level, x fastest.
  const std::vector<double>& start() const { return start_; }

  std::vector<double> capacities() {
    std::vector<double> padded(system().field_size()), values(grid().size());
    system().conduction().heat_capacities(padded);
    full().layout.gather(padded, values);
    return values;
  }
  SparseHeat sparse_heat() { return make_sparse_heat(system(), full().layout, capacities()); }

 private:
  std::vector<double> inputs_, start_;
};

/// ∫ exp(−rate (t − s)) ds over [0, t].
inline double growth(double rate, double time) { return rate * time < 1e-12 ? time : -std::expm1(-rate * time) / rate; }

inline std::vector<double> product(const SparseMatrix& matrix, const std::vector<double>& vector) {
  std::vector<double> result(matrix.rows(), 0.0);
  add_product(matrix, vector, result);
  return result;
}

/// Temperatures minus the level at every point, for constant inputs; `start`: minus the level.
inline std::vector<double> model_temperatures(const ReducedModel& model, const std::vector<double>& inputs,
                                              const std::vector<double>& start, double time) {
  const ModalEquations& equations = model.stages.front().equations;
  const SparseMatrix& shapes = model.basis.shapes;
  std::vector<double> moments(shapes.columns, 0.0);
  if (model.start == ModelStart::projected) {
    std::vector<double> heat = start;
    for (std::size_t n = 0; n < heat.size(); ++n) heat[n] *= model.capacities[n];
    add_transposed_product(shapes, heat, moments);
  } else {
    std::vector<double> retained(shapes.columns, 0.0);
    for (std::size_t r = 0; r < model.retained.size(); ++r)
      retained[r] = start[static_cast<std::size_t>(model.retained[r])];
    if (model.lumped_capacities.empty()) {
      std::vector<double> heat = product(shapes, retained);
      for (std::size_t n = 0; n < heat.size(); ++n) heat[n] *= model.capacities[n];
      add_transposed_product(shapes, heat, moments);
    } else {
      for (std::size_t r = 0; r < retained.size(); ++r) moments[r] = model.lumped_capacities[r] * retained[r];
    }
  }
  std::vector<double> unknowns(shapes.columns, 0.0);
  for (std::size_t k = 0; k < equations.size(); ++k) {
    double y = 0.0, gain = 0.0;
    for (std::size_t q = 0; q < moments.size(); ++q) y += model.basis.modes(q, k) * moments[q];
    for (std::size_t m = 0; m < inputs.size(); ++m) {
      gain += equations.gains(k, m) * inputs[m];
      if (!equations.start_gains.empty()) y -= equations.start_gains(k, m) * inputs[m];
    }
    y = y * std::exp(-equations.rates[k] * time) + gain * growth(equations.rates[k], time);
    for (std::size_t q = 0; q < unknowns.size(); ++q) unknowns[q] += model.basis.modes(q, k) * y;
  }
  std::vector<double> temperatures = product(shapes, unknowns);
  for (std::size_t m = 0; m < inputs.size(); ++m) {
    for (std::size_t n = 0; n < temperatures.size(); ++n) temperatures[n] += model.direct(n, m) * inputs[m];
  }
  return temperatures;
}

}  // namespace peritherm
