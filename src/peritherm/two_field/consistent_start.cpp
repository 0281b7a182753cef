#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "peritherm/two_field/row_solver.hpp"
#include "peritherm/two_field/two_field_system.hpp"

namespace peritherm {
namespace {

/// A jump above rounding, where temperatures do not differ near the place.
constexpr double least_jump = 1e-8;

/// Rates of the surroundings over so many of the shortest decays: differences of fourth order.
constexpr std::array<double, 5> forward_weights{-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25};

std::vector<double> rates_of_surroundings(const TwoFieldSystem& system, double time) {
  std::vector<double> rates(system.multipliers(), 0.0);
  if (!system.loads().surroundings) return rates;
  // As long as times keep their digits.
  const double step = std::max(shortest_decay(system), 1e-12 * std::abs(time));
  for (std::size_t k = 0; k < forward_weights.size(); ++k) {
    const std::vector<double> values = system.surroundings(time + static_cast<double>(k) * step);
    for (std::size_t r = 0; r < rates.size(); ++r) rates[r] += forward_weights[k] / step * values[r];
  }
  return rates;
}

/// ρ c V dT/dt but for the rows' part [W].
std::vector<double> heat_rates(const TwoFieldSystem& system, double time, const TwoFieldState& state) {
  std::vector<double> heat(system.size(), 0.0);
  system.add_heating(time, 1.0, heat);
  system.add_conduction(-1.0, state.temperature, heat);
  if (system.has_fluxes()) system.add_divergence(1.0, state.flux, heat);
  return heat;
}

/// dq/dt = −(q + k G T) / τ − F k G dT/dt.
void set_flux_rates(const TwoFieldSystem& system, TwoFieldState& state) {
  if (!system.has_fluxes()) return;
  auto of_temperature = state.flux_rate, of_rate = state.flux_rate;
  system.conductive_flux(state.temperature, of_temperature);
  system.conductive_flux(state.temperature_rate, of_rate);
  for (std::size_t p = 0; p < system.parts().size(); ++p) {
    const PartLaw& law = system.laws()[p];
    if (law.relaxation_time == 0.0) continue;
    for (std::size_t n = system.first_point(p); n < system.first_point(p + 1); ++n) {
      for (std::size_t axis = 0; axis < state.flux.size(); ++axis) {
        state.flux_rate[axis][n] = -(state.flux[axis][n] + of_temperature[axis][n]) / law.relaxation_time -
                                   law.fourier_share * of_rate[axis][n];
      }
    }
  }
}

/// The rows with R = 0 and what solves with Φ (ρ c V)⁻¹ Φᵀ on them.
class PerfectRows {
 public:
  PerfectRows(const TwoFieldSystem& system, const std::vector<double>& resistance)
      : system_(system), inverse_(system.size()), numbers_(numbers_of(resistance)), solver_(make_solver()) {}

  const std::vector<std::size_t>& numbers() const { return numbers_; }

  /// The change in heat over heat capacities that gives Φ change = residual, the least in Σ C change²; returns what of
  /// each row makes it.
  std::vector<double> correct(ConstField residual, Field temperature) const {
    std::vector<double> chosen, all(system_.multipliers(), 0.0), heat(system_.size(), 0.0);
    for (const std::size_t row : numbers_) chosen.push_back(residual[row]);
    solver_.solve(chosen);
    for (std::size_t k = 0; k < numbers_.size(); ++k) all[numbers_[k]] = chosen[k];
    system_.contacts().add_adjoint(1.0, all, heat);
    for (std::size_t n = 0; n < heat.size(); ++n) temperature[n] -= inverse_[n] * heat[n];
    return all;
  }

 private:
  static std::vector<std::size_t> numbers_of(const std::vector<double>& resistance) {
    std::vector<std::size_t> numbers;
    for (std::size_t r = 0; r < resistance.size(); ++r) {
      if (resistance[r] == 0.0) numbers.push_back(r);
    }
    return numbers;
  }

  RowSolver make_solver() {
    for (std::size_t n = 0; n < inverse_.size(); ++n) inverse_[n] = 1.0 / system_.capacities()[n];
    return RowSolver(system_.contacts().gram(inverse_, numbers_), numbers_, system_.rows());
  }

  const TwoFieldSystem& system_;
  std::vector<double> inverse_;  ///< of heat capacities
  std::vector<std::size_t> numbers_;
  RowSolver solver_;
};

}  // namespace

double shortest_decay(const TwoFieldSystem& system) {
  double rate = std::numeric_limits<double>::min();
  for (std::size_t p = 0; p < system.parts().size(); ++p) {
    const PatternRows rows = system.stage_conduction(p, 0.0);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      rate = std::max(rate, rows.diagonal(n) / system.capacities()[system.first_point(p) + n]);
    }
  }
  return 1.0 / rate;
}

std::optional<StartFault> find_start_fault(const TwoFieldSystem& system, double time, ConstField temperature) {
  const std::vector<double> resistance = system.resistances(time), outside = system.surroundings(time);
  std::vector<double> product(system.multipliers());
  system.contacts().product(temperature, product);
  double size = 0.0;
  for (const double value : temperature) size = std::max(size, std::abs(value));
  StartFault worst;
  for (std::size_t r = 0; r < product.size(); ++r) {
    if (resistance[r] != 0.0) continue;
    const double area = system.rows()[r].area;
    const double jump = (product[r] - outside[r]) / area;
    const double largest = std::max(size, std::abs(outside[r]) / area);
    const double explained = system.contacts().variation(r, temperature) + least_jump * largest;
    if (std::abs(jump) > explained && std::abs(jump) > std::abs(worst.jump)) worst = {r, jump};
  }
  if (worst.jump == 0.0) return {};
  return worst;
}

Error inconsistent_start(const TwoFieldSystem& system, const StartFault& fault) {
  const ContactRow& row = system.rows()[fault.row];
  return Error(fmt::format("start temperatures do not fit {} at ({:.6g}, {:.6g}, {:.6g}): they are off by {:.4g} K",
                           row.second < 0 ? "what is held" : "the perfect contact", row.position[0], row.position[1],
                           row.position[2], fault.jump),
               "Let the temperatures at the start agree there, or leave time.integrator.start at \"auto\", which "
               "starts with backward Euler");
}

void make_consistent(const TwoFieldSystem& system, double time, TwoFieldState& state) {
  const std::vector<double> resistance = system.resistances(time), outside = system.surroundings(time);
  const PerfectRows perfect(system, resistance);
  std::vector<double> product(system.multipliers());
  // Twice, so that what rounding leaves of large temperatures goes as well.
  for (int pass = 0; pass < 2; ++pass) {
    system.contacts().product(state.temperature, product);
    for (std::size_t r = 0; r < product.size(); ++r) product[r] -= outside[r];
    perfect.correct(product, state.temperature);
  }
  system.contacts().product(state.temperature, product);
  state.multipliers.assign(system.multipliers(), 0.0);
  for (std::size_t r = 0; r < product.size(); ++r) {
    if (resistance[r] > 0.0) {
      state.multipliers[r] = (product[r] - outside[r]) / (system.rows()[r].area * resistance[r]);
    }
  }
  std::vector<double> heat = heat_rates(system, time, state);
  system.contacts().add_adjoint(-1.0, state.multipliers, heat);
  for (std::size_t n = 0; n < heat.size(); ++n) state.temperature_rate[n] = heat[n] / system.capacities()[n];
  system.contacts().product(state.temperature_rate, product);
  const std::vector<double> rates = rates_of_surroundings(system, time);
  for (std::size_t r = 0; r < product.size(); ++r) product[r] -= rates[r];
  const std::vector<double> held = perfect.correct(product, state.temperature_rate);
  for (const std::size_t row : perfect.numbers()) state.multipliers[row] = held[row];
  set_flux_rates(system, state);
}

}  // namespace peritherm
