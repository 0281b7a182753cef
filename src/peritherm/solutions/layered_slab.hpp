#pragma once

#include <cstddef>
#include <vector>

namespace peritherm {

struct SlabLayer {
  double length;            ///< [m]
  double conductivity;      ///< k [W/(m K)]
  double heat_capacity;     ///< ρ c [J/(m³ K)]
  double start;             ///< temperature at the start
  double resistance = 0.0;  ///< R of the contact with the layer before [m² K/W]; not read for the first
};

/// Layers in series from x = 0 on, their ends held from t = 0 on; at a contact T falls by R q:
///   T = steady + Σ_n c_n φ_n(x) exp(−λ_n t),  (k φ')' = −λ ρc φ,  φ = 0 at both ends.
/// The phase of a mode, θ = atan(√(kρc λ) φ / (k φ')), grows by l √(λρc/k) in a layer and keeps its quarter at an
/// interface; it ends at nπ for the n-th mode, so that none is missed and all have about full accuracy. While
/// diffusion has not crossed a layer, the solution is the sum of those for half-spaces at ends and interfaces.
/// Error below 1e-12 of the temperature differences; any consistent units.
class LayeredSlab {
 public:
  /// Finds the modes. Throws Error if a layer is so thin beside the others that more than 200 000 are needed.
  LayeredSlab(std::vector<SlabLayer> layers, double left, double right);

  double temperature(double x, double t) const;  ///< on a contact that of the layer beyond
  double temperature_in(std::size_t layer, double x, double t) const;
  double steady_temperature(double x) const;
  double steady_flux() const { return steady_flux_; }                ///< [W/m²]
  const std::vector<double>& decay_rates() const { return rates_; }  ///< λ_n [1/s], ascending

 private:
  /// A mode in one layer: amplitude · sin(phase + wave number · distance from the layer's left end).
  struct Wave {
    double amplitude;
    double phase;
  };
  std::size_t layer_at(double x) const;
  void find_modes();
  double root_of_rate(int mode) const;
  double last_phase(double root, double& slope) const;
  void add_mode(double root);
  double steady_temperature_in(std::size_t layer, double x) const;
  double early_temperature(std::size_t layer, double x, double t) const;
  double early_share(std::size_t interface, std::size_t layer, double distance, double t) const;
  double held_at_interface(std::size_t interface) const;

  std::vector<SlabLayer> layers_;
  std::vector<double> places_;        ///< of the ends and interfaces [m]
  std::vector<double> times_;         ///< l √(ρc/k) of the layers [√s]
  std::vector<double> effusivities_;  ///< √(k ρc)
  std::vector<double> steady_;        ///< of the steady state where each layer begins
  double steady_flux_ = 0.0;
  double right_;
  double early_ = 0.0;  ///< until this time modes are not needed [s]
  std::vector<double> rates_;
  std::vector<double> coefficients_;
  std::vector<Wave> waves_;  ///< mode by mode, layer by layer
};

}  // namespace peritherm
