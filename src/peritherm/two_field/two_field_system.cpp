#include "peritherm/two_field/two_field_system.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "peritherm/two_field/row_solver.hpp"

namespace peritherm {

TwoFieldSystem::TwoFieldSystem(std::vector<NonlocalOperators> parts, std::vector<PartLaw> laws,
                               std::vector<ContactRow> rows, TwoFieldLoads loads)
    : parts_(std::move(parts)), laws_(std::move(laws)), rows_(std::move(rows)), loads_(std::move(loads)) {
  first_point_.push_back(0);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    for (const double volume : parts_[p].volumes()) {
      capacities_.push_back(laws_[p].volumetric_heat_capacity * volume);
    }
    first_point_.push_back(capacities_.size());
    has_fluxes_ = has_fluxes_ || laws_[p].relaxation_time > 0.0;
    const double stabilisation = laws_[p].stabilisation * trace(laws_[p].conductivity) / dimension();
    at_once_.push_back(
        parts_[p].conduction(laws_[p].relaxation_time > 0.0 ? Tensor{} : laws_[p].conductivity, stabilisation));
  }
  contacts_ = ContactMatrix(rows_, first_point_);
  refuse_dependent_rows();
}

/// Rows with R = 0 must not say the same twice.
void TwoFieldSystem::refuse_dependent_rows() const {
  std::vector<double> inverse(capacities_.size());
  for (std::size_t n = 0; n < inverse.size(); ++n) inverse[n] = 1.0 / capacities_[n];
  const std::vector<double> resistance = resistances(0.0);
  std::vector<std::size_t> perfect;
  for (std::size_t row = 0; row < resistance.size(); ++row) {
    if (resistance[row] == 0.0) perfect.push_back(row);
  }
  if (!perfect.empty()) RowSolver(contacts_.gram(inverse, perfect), perfect, rows_);
}

std::size_t TwoFieldSystem::size() const { return capacities_.size(); }
int TwoFieldSystem::dimension() const { return parts_.empty() ? 1 : parts_.front().dimension(); }

int TwoFieldSystem::index(double time) const {
  const std::vector<double> resistance = resistances(time);
  if (std::any_of(resistance.begin(), resistance.end(), [](double value) { return value == 0.0; })) return 2;
  const bool relaxes =
      std::all_of(laws_.begin(), laws_.end(), [](const auto& law) { return law.relaxation_time > 0.0; });
  return rows_.empty() && relaxes ? 0 : 1;
}

ConstField TwoFieldSystem::of_part(ConstField all, std::size_t part) const {
  return all.subspan(first_point_[part], parts_[part].size());
}

Field TwoFieldSystem::of_part(Field all, std::size_t part) const {
  return all.subspan(first_point_[part], parts_[part].size());
}

TwoFieldState TwoFieldSystem::make_state() const {
  TwoFieldState state;
  state.temperature.assign(size(), 0.0);
  state.temperature_rate = state.temperature;
  if (has_fluxes_) {
    state.flux.assign(static_cast<std::size_t>(dimension()), state.temperature);
    state.flux_rate = state.flux;
  }
  state.multipliers.assign(multipliers(), 0.0);
  state.account_heats.assign(loads_.accounts, 0.0);
  state.account_rates = state.account_heats;
  return state;
}

void TwoFieldSystem::heat_flux(const TwoFieldState& state, const std::array<Field, 3>& flux) const {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    std::array<Field, 3> own;
    const auto axes = static_cast<std::size_t>(dimension());
    for (std::size_t axis = 0; axis < axes; ++axis) own[axis] = of_part(flux[axis], p);
    if (laws_[p].relaxation_time > 0.0) {
      for (std::size_t axis = 0; axis < axes; ++axis) {
        const ConstField known = of_part(ConstField(state.flux[axis]), p);
        std::copy(known.begin(), known.end(), own[axis].begin());
      }
      continue;
    }
    parts_[p].gradient(of_part(ConstField(state.temperature), p), own);
    for (std::size_t n = 0; n < parts_[p].size(); ++n) {
      Point gradient{};
      for (std::size_t axis = 0; axis < axes; ++axis) gradient[axis] = own[axis][n];
      const Point conducted = product(laws_[p].conductivity, gradient);
      for (std::size_t axis = 0; axis < axes; ++axis) own[axis][n] = -conducted[axis];
    }
  }
}

double TwoFieldSystem::stored_heat(ConstField temperature) const {
  return std::inner_product(capacities_.begin(), capacities_.end(), temperature.begin(), 0.0);
}

double TwoFieldSystem::constraint_residual(double time, const TwoFieldState& state) const {
  const std::vector<double> resistance = resistances(time), outside = surroundings(time);
  std::vector<double> product(rows_.size());
  contacts_.product(state.temperature, product);
  double largest = 0.0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const double area = rows_[r].area;
    const double residual = (product[r] - outside[r]) / area - resistance[r] * state.multipliers[r];
    largest = std::max(largest, std::abs(residual));
  }
  return largest;
}

std::vector<double> TwoFieldSystem::resistances(double time) const {
  std::vector<double> result(rows_.size(), 0.0);
  if (loads_.resistance) loads_.resistance(time, result);
  return result;
}

std::vector<double> TwoFieldSystem::surroundings(double time) const {
  std::vector<double> result(rows_.size(), 0.0);
  if (loads_.surroundings) loads_.surroundings(time, result);
  for (std::size_t r = 0; r < rows_.size(); ++r) result[r] *= rows_[r].area;
  return result;
}

void TwoFieldSystem::add_heating(double time, double factor, Field heat) const {
  if (!loads_.heating) return;
  std::vector<double> heating(size(), 0.0);
  loads_.heating(time, heating);
  for (std::size_t n = 0; n < heating.size(); ++n) heat[n] += factor * heating[n];
}

void TwoFieldSystem::add_conduction(double factor, ConstField temperature, Field heat) const {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    at_once_[p].add_product(factor, of_part(temperature, p), of_part(heat, p));
  }
}

void TwoFieldSystem::add_divergence(double factor, const std::vector<std::vector<double>>& flux, Field heat) const {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (laws_[p].relaxation_time == 0.0) continue;
    const ConstField volumes = parts_[p].volumes();
    std::array<std::vector<double>, 3> weighted;
    std::array<ConstField, 3> fields;
    for (std::size_t axis = 0; axis < flux.size(); ++axis) {
      const ConstField own = of_part(ConstField(flux[axis]), p);
      weighted[axis].resize(own.size());
      for (std::size_t n = 0; n < own.size(); ++n) weighted[axis][n] = factor * volumes[n] * own[n];
      fields[axis] = weighted[axis];
    }
    parts_[p].add_adjoint_gradient(fields, of_part(heat, p));
  }
}

void TwoFieldSystem::conductive_flux(ConstField temperature, std::vector<std::vector<double>>& flux) const {
  const std::size_t axes = flux.size();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    std::array<Field, 3> own;
    for (std::size_t axis = 0; axis < axes; ++axis) own[axis] = of_part(Field(flux[axis]), p);
    if (laws_[p].relaxation_time == 0.0) {
      for (std::size_t axis = 0; axis < axes; ++axis) std::fill(own[axis].begin(), own[axis].end(), 0.0);
      continue;
    }
    parts_[p].gradient(of_part(temperature, p), own);
    for (std::size_t n = 0; n < parts_[p].size(); ++n) {
      Point gradient{};
      for (std::size_t axis = 0; axis < axes; ++axis) gradient[axis] = own[axis][n];
      const Point conducted = product(laws_[p].conductivity, gradient);
      for (std::size_t axis = 0; axis < axes; ++axis) own[axis][n] = conducted[axis];
    }
  }
}

PatternRows TwoFieldSystem::stage_conduction(std::size_t part, double shift) const {
  const PartLaw& law = laws_[part];
  if (law.relaxation_time == 0.0) return at_once_[part];
  const double decay = law.relaxation_time * shift;
  const double share = (1.0 + decay * law.fourier_share) / (1.0 + decay);
  Tensor tensor = law.conductivity;
  for (Point& row : tensor) {
    for (double& value : row) value *= share;
  }
  return parts_[part].conduction(tensor, law.stabilisation * trace(law.conductivity) / dimension());
}

}  // namespace peritherm
