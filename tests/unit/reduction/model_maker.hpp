#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "peritherm/reduction/answer.hpp"

namespace peritherm {

/// A bar of n points with capacities 1, joined by conductances g to their neighbours and to walls on both sides of
/// temperature u(t), and heated evenly by q(t): C = I, K tridiagonal. All its modes, so nothing is left out; the last
/// point of the grid is a wall (held), and one more is cut away.
struct BarModel {
  std::size_t points;
  double conductance;

  double rate(std::size_t k) const {
    const double s = std::sin(0.5 * std::numbers::pi * static_cast<double>(k + 1) / static_cast<double>(points + 1));
    return 4.0 * conductance * s * s;
  }
  double mode(std::size_t n, std::size_t k) const {
    const double share = static_cast<double>((n + 1) * (k + 1)) / static_cast<double>(points + 1);
    return std::sqrt(2.0 / static_cast<double>(points + 1)) * std::sin(std::numbers::pi * share);
  }

  ReducedModel model(std::size_t unknowns) const {
    ReducedModel model;
    model.program = "peritherm test";
    model.case_text = "# a bar\n";
    model.loads = {{"boundary.0.value", 0, -1, LoadKind::temperature, {{Profile(1.0), 0.0}}, {}},
                   {"source.0.value", -1, 0, LoadKind::heat, {{Profile(1.0), 0.0}}, {}}};
    ModalStage stage{std::numeric_limits<double>::infinity(), {}, {}, {}};
    stage.equations.gains = Matrix(unknowns, 2);
    model.basis.dense = Matrix(points + 2, unknowns);
    model.direct = Matrix(points + 2, 2);
    model.direct(points, 0) = 1.0;
    model.capacities.assign(points + 2, 1.0);
    model.capacities[points] = model.capacities[points + 1] = 0.0;
    model.heat.names = {"walls", "sources"};
    model.heat.modes = Matrix(2, unknowns);
    model.heat.inputs = Matrix(2, 2);
    model.heat.inputs(0, 0) = 2.0 * conductance;
    model.heat.inputs(1, 1) = static_cast<double>(points);
    model.heat.stored_modes.assign(unknowns, 0.0);
    model.heat.stored_inputs.assign(2, 0.0);
    model.heat.heat_capacity = static_cast<double>(points);
    for (std::size_t k = 0; k < unknowns; ++k) {
      stage.equations.rates.push_back(rate(k));
      const double ends = mode(0, k) + mode(points - 1, k);
      stage.equations.gains(k, 0) = conductance * ends;
      for (std::size_t n = 0; n < points; ++n) {
        model.basis.dense(n, k) = mode(n, k);
        stage.equations.gains(k, 1) += mode(n, k);
        model.heat.stored_modes[k] += mode(n, k);
      }
      model.heat.modes(0, k) = -conductance * ends;
    }
    model.stages = {stage};
    model.shortest_time = 0.01;
    model.longest_time = 10.0;
    return model;
  }
};

}  // namespace peritherm
