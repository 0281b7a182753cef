#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <memory>
#include <variant>
#include <vector>

#include "peritherm/solutions/contact_layer.hpp"

namespace peritherm {

/// T(0, t) = value (1 − (1 + z + z²/2) e^{−z}), z = t / time: begins with slope and curvature 0. `time` 0: a step.
struct TemperatureRamp {
  double value = 1.0;  ///< [K]
  double time = 0.0;   ///< [s]
};

/// q(0, t) = energy z²/2 e^{−z} / time, z = t / time: a pulse that is largest at 2 `time` and 3.4 `time` wide at half
/// its height.
struct FluxPulse {
  double energy = 1.0;  ///< ∫ q dt [J/m²]
  double time = 0.0;    ///< [s]
};

using SurfaceDrive = std::variant<TemperatureRamp, FluxPulse>;

enum class FarEnd { held, insulated, unbounded };

/// Layers in contact, at rest and at 0 at the start, driven at x = 0; each with its own law of flux. `wave_number` κ:
/// the factor of cos κy of a plate driven like cos κy along y. In the Laplace domain each layer carries waves
/// e^{∓bx}, b = √(ρc s/k_e + κ²); they are reflected by the impedance T/q of what is behind, which is R + that of the
/// next layer. Inverted by invert_laplace_series; error below 1e-12 of the largest temperature for smooth ramps and
/// pulses.
class DrivenLayers {
 public:
  /// Throws Error for more than 16 layers.
  DrivenLayers(std::vector<ContactLayer> layers, FarEnd far, const SurfaceDrive& drive, double wave_number = 0.0);

  double temperature_in(std::size_t layer, double x, double time) const;
  double temperature(double x, double time) const;                 ///< on a contact that of the layer beyond
  double flux_in(std::size_t layer, double x, double time) const;  ///< along x [W/m²]
  /// Summed as far as terms of 1e-10 of the drive and at most 4000 of them: good to 1e-7 where the drive takes longer
  /// than t/100, and much quicker where waves run.
  DrivenLayers quick() const;

 private:
  struct Wave;
  struct Waves;
  static constexpr std::size_t most_layers = 16;
  Wave wave_in(std::size_t layer, std::complex<double> s) const;
  std::complex<double> drive(std::complex<double> s) const;
  double value_of_drive() const;
  double invert(std::size_t layer, double time, double scale,
                const std::function<std::complex<double>(const Wave&)>& transform) const;

  std::vector<ContactLayer> layers_;
  std::vector<double> begins_;
  FarEnd far_;
  SurfaceDrive drive_;
  double wave_number_;
  double tolerance_ = 1e-14;
  int terms_ = 40000;
  std::shared_ptr<Waves> waves_;  ///< of the times last asked for
};

}  // namespace peritherm
