#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "peritherm/simulation/assemble.hpp"
#include "support/tolerance.hpp"

namespace peritherm {

inline constexpr BackendName both_backends[] = {BackendName::stencil, BackendName::bond};

/// A problem made ready to run, with what the tests weigh it by. One entry per free point.
struct MeasuredBody {
  Assembly assembly;
  std::vector<std::size_t> entries;  ///< where the free points stand in a state
  std::vector<double> capacities;    ///< C [J/K]
  std::vector<double> rate_scales;   ///< Σ |terms of the rate| per kelvin [1/s], which rounding is relative to

  HeatSystem& system() const { return *assembly.system; }
  std::size_t terms() const { return 2 * assembly.geometry.stencil.entries.size() + 8; }
  /// What a rate may lose to rounding when all temperatures are at most `largest` in size.
  double rate_rounding(std::size_t k, double largest) const { return rounding(terms(), rate_scales[k] * largest); }
  /// The same for a sum of heat rates over all points [W].
  double heat_rounding(double largest) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < entries.size(); ++k) sum += capacities[k] * rate_scales[k] * largest;
    return rounding(terms() + entries.size(), sum);
  }
};

inline MeasuredBody measure(Problem problem, BackendName backend) {
  problem.numerics.backend = backend;
  MeasuredBody body{assemble(problem), {}, {}, {}};
  const Geometry& geometry = body.assembly.geometry;
  const Grid& grid = geometry.body.grid;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const MaterialIndex material = geometry.body.material_of[n];
    if (material == no_material || geometry.held_by[n] >= 0) continue;
    const GridIndex p = grid.index(n);
    const std::size_t entry = body.assembly.layout.entry(p);
    const MirroredFaces& faces = geometry.body.faces;
    const double share = grid.volume_share(p) * (faces.empty() ? 1.0 : faces.volume(n));
    const double capacity = volumetric_heat_capacity(geometry.body.materials[material]) * grid.cell_volume() * share;
    double sum = 0.0;
    body.system().conduction().visit_bonds(entry, [&sum](std::size_t, double g) { sum += 2.0 * std::abs(g); });
    body.entries.push_back(entry);
    body.capacities.push_back(capacity);
    body.rate_scales.push_back(sum / capacity);
  }
  PrescribedValues values;
  for (const SurfaceExchange& exchange : make_exchanges(problem, geometry, body.assembly.layout, values)) {
    const auto place =
        std::lower_bound(body.entries.begin(), body.entries.end(), static_cast<std::size_t>(exchange.entry));
    body.rate_scales[static_cast<std::size_t>(place - body.entries.begin())] +=
        (exchange.convective ? 2.0 : 1.0) * std::abs(exchange.gain) * exchange.inverse_capacity;
  }
  return body;
}

/// dT/dt of every free point; fills the held and fictitious entries of the state.
inline std::vector<double> rates(const MeasuredBody& body, Field state, double time = 0.0) {
  std::vector<double> result(state.size(), 0.0);
  body.system().combine(time, state, 1.0, {}, result);
  std::vector<double> free;
  for (const std::size_t entry : body.entries) free.push_back(result[entry]);
  return free;
}

/// Σ C dT/dt [W].
inline double heat_rate(const MeasuredBody& body, const std::vector<double>& rates) {
  double sum = 0.0;
  for (std::size_t k = 0; k < rates.size(); ++k) sum += body.capacities[k] * rates[k];
  return sum;
}

inline double largest_size(ConstField values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Conductances between free points with everything folded in [W/K], measured column by column: C_i ∂(dT_i/dt)/∂T_j.
inline std::vector<std::vector<double>> conductance_matrix(const MeasuredBody& body) {
  std::vector<double> state(body.system().size(), 0.0);
  const std::vector<double> at_zero = rates(body, state);
  std::vector<std::vector<double>> matrix(body.entries.size(), std::vector<double>(body.entries.size()));
  for (std::size_t j = 0; j < body.entries.size(); ++j) {
    std::fill(state.begin(), state.end(), 0.0);
    state[body.entries[j]] = 1.0;
    const std::vector<double> column = rates(body, state);
    for (std::size_t i = 0; i < column.size(); ++i) matrix[i][j] = body.capacities[i] * (column[i] - at_zero[i]);
  }
  return matrix;
}

/// Gives every surrounding the same temperature, lets no heat through by flux and switches sources off.
inline void surround_with(Problem& problem, double temperature) {
  problem.sources.clear();
  for (BoundaryOptions& boundary : problem.boundaries) {
    if (auto* held = std::get_if<HeldTemperature>(&boundary.condition)) held->value = temperature;
    if (auto* convection = std::get_if<Convection>(&boundary.condition)) convection->ambient = temperature;
    if (auto* flux = std::get_if<PrescribedFlux>(&boundary.condition)) flux->value = 0.0;
  }
}

/// Removes every boundary that `unwanted(condition)` names.
template <class Predicate>
void remove_boundaries(Problem& problem, const Predicate& unwanted) {
  std::erase_if(problem.boundaries, [&](const BoundaryOptions& boundary) { return unwanted(boundary.condition); });
}

}  // namespace peritherm
