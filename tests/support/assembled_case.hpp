#pragma once

#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/reduce.hpp"
#include "peritherm/reduction/sparse_heat.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"

namespace peritherm {

/// A problem whose loads are constant, ready to be reduced; every load has one shape of value 1.
class AssembledCase {
 public:
  explicit AssembledCase(Problem problem, double level = 0.0)
      : problem_((check(problem), resolved(problem))), assembly_(assemble(problem_)) {
    for (std::size_t b = 0; b < problem_.boundaries.size(); ++b) add_boundary(static_cast<int>(b), level);
    for (std::size_t s = 0; s < problem_.sources.size(); ++s)
      add_load({"source", -1, static_cast<int>(s), LoadKind::heat, {}, {}}, problem_.sources[s].value, 0.0);
    std::vector<bool> present;
    for (const MaterialIndex material : assembly_.geometry.body.material_of) present.push_back(material != no_material);
    full_ = std::make_unique<FullSystem>(FullSystem{*assembly_.system,
                                                    assembly_.layout,
                                                    present,
                                                    loads_,
                                                    initial_state(problem_, assembly_),
                                                    level,
                                                    0.01 * problem_.time.end,
                                                    problem_.time.end,
                                                    {problem_.time.end}});
    start_.resize(assembly_.layout.grid().size());
    assembly_.layout.gather(full_->start, start_);
    for (double& value : start_) value -= level;
  }

  FullSystem& full() { return *full_; }
  HeatSystem& system() { return *assembly_.system; }
  const Grid& grid() const { return assembly_.layout.grid(); }
  const std::vector<double>& inputs() const { return inputs_; }
  /// Minus the level, x fastest.
  const std::vector<double>& start() const { return start_; }

  std::vector<double> capacities() {
    std::vector<double> padded(system().field_size()), values(grid().size());
    system().conduction().heat_capacities(padded);
    assembly_.layout.gather(padded, values);
    return values;
  }
  SparseHeat sparse_heat() { return make_sparse_heat(system(), assembly_.layout, capacities()); }

 private:
  void add_boundary(int b, double level) {
    const std::string key = "boundary." + std::to_string(b) + ".value";
    const BoundaryCondition& condition = problem_.boundaries[static_cast<std::size_t>(b)].condition;
    if (const auto* held = std::get_if<HeldTemperature>(&condition))
      add_load({key, b, -1, LoadKind::temperature, {}, {}}, held->value, level);
    if (const auto* flux = std::get_if<PrescribedFlux>(&condition))
      add_load({key, b, -1, LoadKind::heat, {}, {}}, flux->value, 0.0);
    if (const auto* convection = std::get_if<Convection>(&condition))
      add_load({key, b, -1, LoadKind::temperature, {}, {}}, convection->ambient, level);
  }
  void add_load(Load load, const Profile& value, double level) {
    load.shapes = {{Profile(1.0), 0.0}};
    loads_.push_back(std::move(load));
    inputs_.push_back(CompiledProfile(value)(Point{}, 0.0) - level);
  }

  Problem problem_;
  Assembly assembly_;
  std::vector<Load> loads_;
  std::vector<double> inputs_, start_;
  std::unique_ptr<FullSystem> full_;
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
