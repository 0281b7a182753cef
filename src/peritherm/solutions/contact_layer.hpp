#pragma once

#include <complex>

#include "peritherm/physics/flux_law.hpp"

namespace peritherm {

/// One of several layers in contact, along x.
struct ContactLayer {
  double length = 0.0;         ///< [m]
  double conductivity = 0.0;   ///< k [W/(m K)]
  double heat_capacity = 0.0;  ///< ρ c [J/(m³ K)]
  FluxLaw law;
  double resistance = 0.0;  ///< R of the contact with the layer before [m² K/W]; not read for the first
};

/// k_e(s) = k (1 + τ F s)/(1 + τ s): what q ~ exp(s t) takes for a conductivity [W/(m K)].
inline std::complex<double> effective_conductivity(const ContactLayer& layer, std::complex<double> s) {
  const double tau = relaxation_time(layer.law);
  return layer.conductivity * (1.0 + tau * fourier_share(layer.law) * s) / (1.0 + tau * s);
}

}  // namespace peritherm
