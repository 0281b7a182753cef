#include "peritherm/solutions/driven_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/solutions/laplace_series.hpp"

namespace peritherm {

/// In one layer: T = start (e^{−by} + reflected e^{by}) / (1 + reflected), y from where the layer begins.
struct DrivenLayers::Wave {
  std::complex<double> root;       ///< b [1/m]
  std::complex<double> impedance;  ///< 1/(k_e b) [m² K/W]
  std::complex<double> reflected;  ///< of the wave that returns to where the layer begins
  std::complex<double> far;        ///< the same where it ends
  std::complex<double> start;      ///< T where the layer begins [K s]

  std::complex<double> temperature(double y, double length) const { return start * sum(y, length, 1.0); }
  std::complex<double> flux(double y, double length) const { return start / impedance * sum(y, length, -1.0); }

 private:
  std::complex<double> sum(double y, double length, double sign) const {
    return (std::exp(-root * y) + sign * far * std::exp(-root * (2.0 * length - y))) / (1.0 + reflected);
  }
};

/// Waves depend on time and layer, not on the place: those of a whole profile are worked out once.
struct DrivenLayers::Waves {
  struct OfLayer {
    double time = 0.0;
    std::vector<Wave> terms;  ///< in the order in which the series asks for them
  };
  std::array<OfLayer, most_layers> layers;
  std::mutex mutex;
};

DrivenLayers::DrivenLayers(std::vector<ContactLayer> layers, FarEnd far, const SurfaceDrive& drive, double wave_number)
    : layers_(std::move(layers)),
      far_(far),
      drive_(drive),
      wave_number_(wave_number),
      waves_(std::make_shared<Waves>()) {
  if (layers_.size() > most_layers) {
    throw Error("the exact solution of driven layers is for at most " + std::to_string(most_layers) + " layers",
                "Leave layers out, or join some");
  }
  double begin = 0.0;
  for (const ContactLayer& layer : layers_) {
    begins_.push_back(begin);
    begin += layer.length;
  }
}

DrivenLayers DrivenLayers::quick() const {
  DrivenLayers copy = *this;
  copy.tolerance_ = 1e-10;
  copy.terms_ = 4000;
  copy.waves_ = std::make_shared<Waves>();
  return copy;
}

double DrivenLayers::value_of_drive() const {
  if (const auto* ramp = std::get_if<TemperatureRamp>(&drive_)) return std::abs(ramp->value);
  const auto& pulse = std::get<FluxPulse>(drive_);
  // What the pulse leaves as far as it comes while it lasts.
  return std::abs(pulse.energy) / std::sqrt(layers_.front().conductivity * layers_.front().heat_capacity * pulse.time);
}

std::complex<double> DrivenLayers::drive(std::complex<double> s) const {
  if (const auto* ramp = std::get_if<TemperatureRamp>(&drive_)) {
    return ramp->value / (s * std::pow(1.0 + s * ramp->time, 3));
  }
  const auto& pulse = std::get<FluxPulse>(drive_);
  return pulse.energy / std::pow(1.0 + s * pulse.time, 3);
}

DrivenLayers::Wave DrivenLayers::wave_in(std::size_t layer, std::complex<double> s) const {
  std::array<Wave, most_layers> waves;
  std::complex<double> reflected = far_ == FarEnd::held ? -1.0 : (far_ == FarEnd::insulated ? 1.0 : 0.0);
  for (std::size_t i = layers_.size(); i-- > 0;) {
    Wave& wave = waves[i];
    const std::complex<double> conductivity = effective_conductivity(layers_[i], s);
    wave.root = std::sqrt(layers_[i].heat_capacity * s / conductivity + wave_number_ * wave_number_);
    wave.impedance = 1.0 / (conductivity * wave.root);
    if (i + 1 < layers_.size()) {
      const Wave& next = waves[i + 1];
      // The impedance behind is above/below; as a fraction it may become infinite.
      const std::complex<double> below = 1.0 - next.reflected;
      const std::complex<double> above = layers_[i + 1].resistance * below + next.impedance * (1.0 + next.reflected);
      reflected = (above - wave.impedance * below) / (above + wave.impedance * below);
    }
    wave.far = reflected;
    wave.reflected = reflected * std::exp(-2.0 * wave.root * layers_[i].length);
  }
  const bool held = std::holds_alternative<TemperatureRamp>(drive_);
  waves[0].start =
      drive(s) * (held ? 1.0 : waves[0].impedance * (1.0 + waves[0].reflected) / (1.0 - waves[0].reflected));
  for (std::size_t i = 1; i <= layer; ++i) {
    const double length = layers_[i - 1].length;
    waves[i].start =
        waves[i - 1].temperature(length, length) - layers_[i].resistance * waves[i - 1].flux(length, length);
  }
  return waves[layer];
}

double DrivenLayers::invert(std::size_t layer, double time, double scale,
                            const std::function<std::complex<double>(const Wave&)>& transform) const {
  if (time <= 0.0) return 0.0;
  const std::lock_guard lock(waves_->mutex);
  Waves::OfLayer& known = waves_->layers[layer];
  if (known.time != time) known = {time, {}};
  std::size_t term = 0;
  const auto next = [&](std::complex<double> s) {
    if (term == known.terms.size()) known.terms.push_back(wave_in(layer, s));
    return transform(known.terms[term++]);
  };
  return invert_laplace_series(next, time, tolerance_ * scale, terms_);
}

double DrivenLayers::temperature_in(std::size_t layer, double x, double time) const {
  const double y = x - begins_[layer];
  const double length = layers_[layer].length;
  return invert(layer, time, value_of_drive(), [=](const Wave& wave) { return wave.temperature(y, length); });
}

double DrivenLayers::flux_in(std::size_t layer, double x, double time) const {
  const double y = x - begins_[layer];
  const double length = layers_[layer].length;
  return invert(layer, time, value_of_drive() * layers_[layer].conductivity / length,
                [=](const Wave& wave) { return wave.flux(y, length); });
}

double DrivenLayers::temperature(double x, double time) const {
  const auto beyond = std::upper_bound(begins_.begin(), begins_.end(), x);
  const auto layer = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, beyond - begins_.begin() - 1));
  return temperature_in(layer, x, time);
}

}  // namespace peritherm
