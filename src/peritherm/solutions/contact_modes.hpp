#pragma once

#include <array>
#include <complex>
#include <cstddef>

#include "peritherm/solutions/contact_layer.hpp"

namespace peritherm {

/// One decaying, perhaps swinging, mode of two layers in contact whose outer ends are held at 0, along y like cos κy:
///   T₁ = Re A sin(b₁x) e^{σt} cos κy,  T₂ = Re B sin(b₂(L − x)) e^{σt} cos κy,  b² = −ρc σ/k_e(σ) − κ²,
///   (sin b₁a + R k₁ b₁ cos b₁a) k₂ b₂ cos b₂b + sin b₂b k₁ b₁ cos b₁a = 0,  q = −k_e ∇T.
/// Exact for every law of flux and every resistance.
class ContactMode {
 public:
  /// Finds the root σ [1/s] near the guess by Newton's method; throws Error if it does not settle.
  ContactMode(const std::array<ContactLayer, 2>& layers, std::complex<double> guess, double wave_number = 0.0);

  std::complex<double> rate() const { return rate_; }  ///< σ
  /// The same mode with a complex amplitude of 1 at a place and t = 0.
  ContactMode with_unit_at(std::size_t layer, double x) const;
  std::complex<double> amplitude(std::size_t layer, double x) const;  ///< of T at y = 0, t = 0

  std::complex<double> factor(std::size_t layer) const { return factors_[layer]; }               ///< A, B
  std::complex<double> root(std::size_t layer) const { return roots_[layer]; }                   ///< b [1/m]
  std::complex<double> conductivity(std::size_t layer) const { return conductivities_[layer]; }  ///< k_e(σ)

  double temperature(std::size_t layer, double x, double time, double y = 0.0) const;
  double temperature_rate(std::size_t layer, double x, double time, double y = 0.0) const;  ///< ∂T/∂t
  double flux_along_x(std::size_t layer, double x, double time, double y = 0.0) const;      ///< [W/m²]
  double flux_along_y(std::size_t layer, double x, double time, double y = 0.0) const;

 private:
  std::array<ContactLayer, 2> layers_;
  double wave_number_;
  std::complex<double> rate_;
  std::array<std::complex<double>, 2> conductivities_;
  std::array<std::complex<double>, 2> roots_;    ///< b [1/m]
  std::array<std::complex<double>, 2> factors_;  ///< A, B
};

/// A disc and the ring about it, held at 0 outside, both Fourier.
struct DiscInRing {
  double radius = 0.0;  ///< of the contact [m]
  double outer_radius = 0.0;
  double conductivity_inside = 0.0;  ///< [W/(m K)]
  double conductivity_outside = 0.0;
  double heat_capacity_inside = 0.0;  ///< ρ c [J/(m³ K)]
  double heat_capacity_outside = 0.0;
  double resistance = 0.0;  ///< [m² K/W]
};

/// Its slowest axisymmetric mode, T = 1 in the centre at t = 0, from Bessel's functions:
///   T = J₀(βr) e^{−μt} inside and ∝ J₀(βr) Y₀(βb) − Y₀(βr) J₀(βb) outside, β² = μ ρc/k.
class DiscMode {
 public:
  explicit DiscMode(const DiscInRing& disc);
  double rate() const { return rate_; }  ///< μ [1/s]
  double temperature_inside(double radius, double time) const;
  double temperature_outside(double radius, double time) const;
  double contact_flux(double time) const;  ///< outwards through the contact [W/m²]

 private:
  double mismatch(double rate) const;

  DiscInRing disc_;
  double rate_ = 0.0;
  double factor_outside_ = 0.0;
};

}  // namespace peritherm
