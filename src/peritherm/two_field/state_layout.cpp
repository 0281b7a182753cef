#include "peritherm/two_field/state_layout.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {

StateLayout::StateLayout(const TwoFieldSystem& system) : system_(system) {
  for (std::size_t p = 0; p < system.parts().size(); ++p) {
    if (system.laws()[p].relaxation_time == 0.0) continue;
    pieces_.push_back({p, system.first_point(p), system.parts()[p].size()});
    fluxes_ += pieces_.back().count;
  }
  multipliers_ = system.size() + axes() * fluxes_;
  accounts_ = multipliers_ + system.multipliers();
  zero_flux_.assign(axes(), std::vector<double>(system.size(), 0.0));
}

void StateLayout::spread_flux(ConstField values, std::vector<std::vector<double>>& flux) const {
  std::size_t entry = system_.size();
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    for (const Piece& piece : pieces_) {
      const ConstField own = values.subspan(entry, piece.count);
      std::copy(own.begin(), own.end(), flux[axis].begin() + static_cast<std::ptrdiff_t>(piece.first));
      entry += piece.count;
    }
  }
}

void StateLayout::gather_flux(const std::vector<std::vector<double>>& flux, Field values) const {
  std::size_t entry = system_.size();
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    for (const Piece& piece : pieces_) {
      const ConstField own = ConstField(flux[axis]).subspan(piece.first, piece.count);
      std::copy(own.begin(), own.end(), values.begin() + static_cast<std::ptrdiff_t>(entry));
      entry += piece.count;
    }
  }
}

void StateLayout::write(const TwoFieldState& state, Field values) const {
  std::copy(state.temperature.begin(), state.temperature.end(), values.begin());
  gather_flux(state.flux, values);
  std::copy(state.multipliers.begin(), state.multipliers.end(), values.subspan(multipliers_).begin());
  std::copy(state.account_heats.begin(), state.account_heats.end(), values.subspan(accounts_).begin());
}

void StateLayout::write_rates(const TwoFieldState& state, Field values) const {
  std::fill(values.begin(), values.end(), 0.0);
  std::copy(state.temperature_rate.begin(), state.temperature_rate.end(), values.begin());
  gather_flux(state.flux_rate, values);
  std::copy(state.account_rates.begin(), state.account_rates.end(), values.subspan(accounts_).begin());
}

void StateLayout::read(ConstField values, TwoFieldState& state) const {
  const auto from = [&values](std::size_t first, std::vector<double>& to) {
    const ConstField own = values.subspan(first, to.size());
    std::copy(own.begin(), own.end(), to.begin());
  };
  from(0, state.temperature);
  spread_flux(values, state.flux);
  from(multipliers_, state.multipliers);
  from(accounts_, state.account_heats);
}

void StateLayout::read_rates(ConstField values, TwoFieldState& state) const {
  std::copy_n(values.begin(), state.temperature_rate.size(), state.temperature_rate.begin());
  spread_flux(values, state.flux_rate);
  std::copy_n(values.subspan(accounts_).begin(), state.account_rates.size(), state.account_rates.begin());
}

void StateLayout::mark_differential(Field values) const {
  std::fill(values.begin(), values.end(), 1.0);
  const Field algebraic = values.subspan(multipliers_, system_.multipliers());
  std::fill(algebraic.begin(), algebraic.end(), 0.0);
}

void StateLayout::set_weights(double allowed, Field weights) const {
  const ConstField capacities = system_.capacities();
  double capacity = 0.0;
  for (const double value : capacities) capacity += value;
  const auto entries = static_cast<double>(size());
  for (std::size_t n = 0; n < capacities.size(); ++n)
    weights[n] = std::sqrt(entries * capacities[n] / capacity) / allowed;
  std::size_t entry = capacities.size();
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    for (const Piece& piece : pieces_) {
      const PartLaw& law = system_.laws()[piece.part];
      const double conductivity = trace(law.conductivity) / system_.dimension();
      const double wave = std::sqrt(law.relaxation_time / (conductivity * law.volumetric_heat_capacity));
      for (std::size_t n = 0; n < piece.count; ++n) weights[entry++] = wave * weights[piece.first + n];
    }
  }
  // Multipliers and accounts follow from the rest, so that no test needs them; the solver leaves next to nothing of
  // their rows. Zero would be refused.
  constexpr double next_to_nothing = 1e-30;
  std::fill(weights.begin() + static_cast<std::ptrdiff_t>(multipliers_), weights.end(), next_to_nothing);
}

void StateLayout::residual(double time, ConstField values, ConstField rates, Field result) const {
  const std::size_t points = system_.size();
  const ConstField temperature = values.first(points), temperature_rate = rates.first(points);
  const Field heat = result.first(points);
  const ConstField capacities = system_.capacities();
  for (std::size_t n = 0; n < points; ++n) heat[n] = capacities[n] * temperature_rate[n];
  system_.add_heating(time, -1.0, heat);
  system_.add_conduction(1.0, temperature, heat);
  system_.contacts().add_adjoint(1.0, multipliers_of(values), heat);
  if (!pieces_.empty()) {
    auto flux = zero_flux_, conducted = zero_flux_, of_rate = zero_flux_, flux_rate = zero_flux_;
    spread_flux(values, flux);
    spread_flux(rates, flux_rate);
    system_.add_divergence(-1.0, flux, heat);
    system_.conductive_flux(temperature, conducted);
    system_.conductive_flux(temperature_rate, of_rate);
    for (const Piece& piece : pieces_) {
      const PartLaw& law = system_.laws()[piece.part];
      for (std::size_t axis = 0; axis < axes(); ++axis) {
        for (std::size_t n = piece.first; n < piece.first + piece.count; ++n) {
          conducted[axis][n] +=
              law.relaxation_time * (flux_rate[axis][n] + law.fourier_share * of_rate[axis][n]) + flux[axis][n];
        }
      }
    }
    gather_flux(conducted, result);
  }
  const Field rows = result.subspan(multipliers_, system_.multipliers());
  const std::vector<double> resistance = system_.resistances(time), outside = system_.surroundings(time);
  system_.contacts().product(temperature, rows);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r] -= outside[r] + system_.contacts().areas()[r] * resistance[r] * values[multipliers_ + r];
  }
  if (!system_.loads().account_rates) return;
  const Field accounts = result.subspan(accounts_);
  system_.loads().account_rates(time, multipliers_of(values), accounts);
  for (std::size_t k = 0; k < accounts.size(); ++k) accounts[k] = rates[accounts_ + k] - accounts[k];
}

/// δq = b_q / (τ σ + 1) − κ k G δT; the rest is a stage.
void StateLayout::solve(StageSolver& stage, double time, double tolerance, ConstField right, Field result) const {
  const std::size_t points = system_.size();
  std::vector<double> heat(right.begin(), right.begin() + static_cast<std::ptrdiff_t>(points));
  auto flux = zero_flux_, conducted = zero_flux_;
  if (!pieces_.empty()) {
    spread_flux(right, flux);
    for (const Piece& piece : pieces_) {
      const double inverse = 1.0 / (system_.laws()[piece.part].relaxation_time * stage.shift() + 1.0);
      for (auto& values : flux) {
        for (std::size_t n = piece.first; n < piece.first + piece.count; ++n) values[n] *= inverse;
      }
    }
    system_.add_divergence(1.0, flux, heat);
  }
  std::fill(result.begin(), result.end(), 0.0);
  const Field multipliers = result.subspan(multipliers_, system_.multipliers());
  stage.solve(heat, right.subspan(multipliers_, system_.multipliers()), tolerance, result.first(points), multipliers);
  if (!pieces_.empty()) {
    system_.conductive_flux(result.first(points), conducted);
    for (const Piece& piece : pieces_) {
      const PartLaw& law = system_.laws()[piece.part];
      const double decay = law.relaxation_time * stage.shift();
      const double share = (1.0 + decay * law.fourier_share) / (1.0 + decay);
      for (std::size_t axis = 0; axis < axes(); ++axis) {
        for (std::size_t n = piece.first; n < piece.first + piece.count; ++n) {
          flux[axis][n] -= share * conducted[axis][n];
        }
      }
    }
    gather_flux(flux, result);
  }
  if (!system_.loads().account_rates) return;
  const Field accounts = result.subspan(accounts_);
  std::vector<double> nothing(accounts.size()), none(multipliers.size(), 0.0);
  system_.loads().account_rates(time, multipliers, accounts);
  system_.loads().account_rates(time, none, nothing);
  for (std::size_t k = 0; k < accounts.size(); ++k) {
    accounts[k] = (right[accounts_ + k] + accounts[k] - nothing[k]) / stage.shift();
  }
}

}  // namespace peritherm
