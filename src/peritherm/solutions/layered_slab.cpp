#include "peritherm/solutions/layered_slab.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

constexpr double full_turn_half = std::numbers::pi;

/// Modes and half-space solutions below this part of the largest one are left out: exp(−37), erfc(5.9).
constexpr double negligible_exponent = 37.0;
constexpr double negligible_depth = 5.9;
constexpr double most_modes = 2e5;

/// What an interface does to a phase: tan θ becomes ratio tan θ + delay √λ.
struct PhaseStep {
  double ratio;  ///< of effusivities, that beyond over that before
  double delay;  ///< contact resistance times the effusivity beyond [√s]
};

PhaseStep step_between(const std::vector<double>& effusivities, const std::vector<SlabLayer>& layers, std::size_t i) {
  return {effusivities[i] / effusivities[i - 1], layers[i].resistance * effusivities[i]};
}

/// The phase beyond an interface; its number of half turns stays. `slope`: its derivative by the root.
double phase_beyond(double phase, const PhaseStep& step, double root, double& slope) {
  const double turns = full_turn_half * std::round(phase / full_turn_half);
  const double cosine = std::cos(phase - turns);
  const double sine = step.ratio * std::sin(phase - turns) + step.delay * root * cosine;
  slope = (step.ratio * slope + step.delay * cosine * cosine) / (cosine * cosine + sine * sine);
  return turns + std::atan2(sine, cosine);
}

/// exp(u²) erfc(u), u ≥ 0; from 25 on by its asymptotic series [abramowitz1964, 7.1.23].
double scaled_complement(double u) {
  if (u < 25.0) return std::exp(u * u) * std::erfc(u);
  const double v = 0.5 / (u * u);
  return (1.0 - v * (1.0 - 3.0 * v * (1.0 - 5.0 * v * (1.0 - 7.0 * v)))) / (u * std::sqrt(full_turn_half));
}

}  // namespace

LayeredSlab::LayeredSlab(std::vector<SlabLayer> layers, double left, double right)
    : layers_(std::move(layers)), right_(right) {
  if (!layers_.empty()) layers_.front().resistance = 0.0;
  places_.push_back(0.0);
  double all = 0.0;
  for (const SlabLayer& layer : layers_) {
    places_.push_back(places_.back() + layer.length);
    times_.push_back(layer.length * std::sqrt(layer.heat_capacity / layer.conductivity));
    effusivities_.push_back(std::sqrt(layer.conductivity * layer.heat_capacity));
    all += layer.resistance + layer.length / layer.conductivity;
  }
  steady_flux_ = (left - right) / all;
  double passed = 0.0;
  for (const SlabLayer& layer : layers_) {
    passed += layer.resistance;
    steady_.push_back(left + (right - left) * std::min(1.0, passed / all));
    passed += layer.length / layer.conductivity;
  }
  const double quickest = *std::min_element(times_.begin(), times_.end());
  early_ = std::pow(0.5 * quickest / negligible_depth, 2);
  find_modes();
}

std::size_t LayeredSlab::layer_at(double x) const {
  const auto beyond = std::upper_bound(places_.begin(), places_.end() - 1, x);
  const auto layer = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, beyond - places_.begin() - 1));
  return std::min(layer, layers_.size() - 1);
}

/// θ at the far end, and its slope over √λ.
double LayeredSlab::last_phase(double root, double& slope) const {
  double phase = 0.0;
  slope = 0.0;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    if (i > 0) phase = phase_beyond(phase, step_between(effusivities_, layers_, i), root, slope);
    phase += root * times_[i];
    slope += times_[i];
  }
  return phase;
}

/// √λ of a mode by Newton steps inside a bracket: an interface moves the phase by less than a quarter turn, and
/// forward by less than a half if it has a resistance.
double LayeredSlab::root_of_rate(int mode) const {
  double all = 0.0;
  for (const double time : times_) all += time;
  const double wanted = mode * full_turn_half;
  const double spread = 0.5 * full_turn_half * static_cast<double>(layers_.size() - 1);
  double low = std::max(0.0, (wanted - 2.0 * spread) / all);
  double high = (wanted + spread) / all;
  double root = wanted / all;
  for (int step = 0; step < 200; ++step) {
    double slope = 0.0;
    const double error = last_phase(root, slope) - wanted;
    (error > 0.0 ? high : low) = root;
    double next = root - error / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - root) <= 1e-15 * root) return next;
    root = next;
  }
  return root;
}

void LayeredSlab::find_modes() {
  const double largest = std::sqrt(negligible_exponent / early_);
  double all = 0.0;
  for (const double time : times_) all += time;
  const double count = std::ceil(largest * all / full_turn_half) + static_cast<double>(layers_.size());
  if (count > most_modes) {
    throw Error("a layer is too thin beside the others for the exact solution of a layered bar",
                "Merge it with its neighbour");
  }
  for (int mode = 1; mode <= static_cast<int>(count); ++mode) add_mode(root_of_rate(mode));
}

/// c_n = ∫ ρc (start − steady) φ dx / ∫ ρc φ² dx; over the steady state from (k φ')' = −λ ρc φ by parts.
void LayeredSlab::add_mode(double root) {
  Wave wave{1.0, 0.0};
  double start = 0.0;
  double norm = 0.0;
  double flux = 0.0;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    if (i > 0) {
      const PhaseStep step = step_between(effusivities_, layers_, i);
      const double cosine = std::cos(wave.phase) / step.ratio;
      double unused = 0.0;
      wave.amplitude *= std::hypot(std::sin(wave.phase) + step.delay * root * cosine, cosine);
      wave.phase = phase_beyond(wave.phase, step, root, unused);
    }
    waves_.push_back(wave);
    const double begin = wave.phase;
    const double end = begin + root * times_[i];
    // ρc l / (√λ l √(ρc/k)), the heat capacity over the wave number.
    const double weight = effusivities_[i] / root;
    start += weight * layers_[i].start * wave.amplitude * (std::cos(begin) - std::cos(end));
    norm += 0.5 * weight * wave.amplitude * wave.amplitude *
            (root * times_[i] - 0.5 * (std::sin(2.0 * end) - std::sin(2.0 * begin)));
    if (i == 0) flux += steady_.front() * effusivities_[i] * wave.amplitude;
    if (i + 1 == layers_.size()) flux -= right_ * effusivities_[i] * wave.amplitude * std::cos(end);
    wave.phase = end;
  }
  rates_.push_back(root * root);
  coefficients_.push_back((start - flux / root) / norm);
}

double LayeredSlab::steady_temperature_in(std::size_t layer, double x) const {
  return steady_[layer] - steady_flux_ * (x - places_[layer]) / layers_[layer].conductivity;
}

double LayeredSlab::steady_temperature(double x) const { return steady_temperature_in(layer_at(x), x); }

/// The temperature that an end or interface takes in the end, as long as the layers seem half-spaces.
double LayeredSlab::held_at_interface(std::size_t interface) const {
  if (interface == 0) return steady_.front();
  if (interface == layers_.size()) return right_;
  const double below = effusivities_[interface - 1];
  const double above = effusivities_[interface];
  return (below * layers_[interface - 1].start + above * layers_[interface].start) / (below + above);
}

/// The part of the way to that temperature which a half-space has gone: erfc u, and with a contact resistance
/// erfc u − exp(βa + β²t) erfc(u + β√t), a = distance √(ρc/k), u = a/√(4t), β = (1/e₁ + 1/e₂)/R
/// [carslaw1959, section 2.7].
double LayeredSlab::early_share(std::size_t interface, std::size_t layer, double distance, double t) const {
  const double u =
      std::max(0.0, distance) / (2.0 * std::sqrt(layers_[layer].conductivity / layers_[layer].heat_capacity * t));
  if (interface == 0 || interface == layers_.size() || layers_[interface].resistance == 0.0) return std::erfc(u);
  const double rate =
      (1.0 / effusivities_[interface - 1] + 1.0 / effusivities_[interface]) / layers_[interface].resistance;
  return std::erfc(u) - std::exp(-u * u) * scaled_complement(u + rate * std::sqrt(t));
}

double LayeredSlab::early_temperature(std::size_t layer, double x, double t) const {
  const double start = layers_[layer].start;
  if (t <= 0.0) return start;
  return start + (held_at_interface(layer) - start) * early_share(layer, layer, x - places_[layer], t) +
         (held_at_interface(layer + 1) - start) * early_share(layer + 1, layer, places_[layer + 1] - x, t);
}

double LayeredSlab::temperature(double x, double t) const { return temperature_in(layer_at(x), x, t); }

double LayeredSlab::temperature_in(std::size_t layer, double x, double t) const {
  if (t < early_) return early_temperature(layer, x, t);
  const double slowness = std::sqrt(layers_[layer].heat_capacity / layers_[layer].conductivity);
  double sum = 0.0;
  for (std::size_t n = 0; n < rates_.size() && rates_[n] * t < negligible_exponent + rates_.front() * t; ++n) {
    const Wave& wave = waves_[n * layers_.size() + layer];
    const double phase = wave.phase + std::sqrt(rates_[n]) * slowness * (x - places_[layer]);
    sum += coefficients_[n] * wave.amplitude * std::sin(phase) * std::exp(-rates_[n] * t);
  }
  return steady_temperature_in(layer, x) + sum;
}

}  // namespace peritherm
