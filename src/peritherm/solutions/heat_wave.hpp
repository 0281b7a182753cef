#pragma once

namespace peritherm {

/// Half-space x > 0 of Cattaneo's law, at rest at 0, held at 1 at x = 0 from t = 0 on [baumeister1969]: a front of
/// speed c = √(k/(ρcτ)), lower by e^{−x/(2cτ)}, and what follows it,
///   T = H(θ − ξ) (e^{−ξ/2} + ξ/2 ∫_ξ^θ e^{−u/2} I₁(√(u² − ξ²)/2) / √(u² − ξ²) du),  ξ = x/(cτ), θ = t/τ.
/// Error below 1e-12 for θ ≤ 600, about the largest for which I₁ is a number.
double heat_wave(double xi, double theta);

/// A disc in an unbounded plate with a gradient of 1 along x far away and a contact resistance around it; steady
/// [hasselman1987]. Linear inside: T = slope x; outside T = x (1 + dipole / r²).
struct DiscInGradient {
  double radius = 0.0;               ///< a [m]
  double conductivity_inside = 0.0;  ///< [W/(m K)]
  double conductivity_outside = 0.0;
  double resistance = 0.0;  ///< R [m² K/W]
  double slope() const;     ///< 2/(1 + k_i/k_o + R k_i/a)
  double dipole() const;    ///< a² (1 − slope k_i/k_o) [m²]
  double temperature(double x, double y) const;
};

/// Two rings about one axis with a contact resistance between them, held inside and outside; steady.
struct RingsInContact {
  double inner_radius = 0.0;    ///< [m]
  double contact_radius = 0.0;  ///< [m]
  double outer_radius = 0.0;    ///< [m]
  double conductivity_inside = 0.0;
  double conductivity_outside = 0.0;
  double resistance = 0.0;  ///< R [m² K/W]
  double inner = 1.0;       ///< temperature at inner_radius
  double outer = 0.0;
  double heat_per_angle() const;  ///< that flows outwards, per radian and depth [W/m]
  double temperature_inside(double radius) const;
  double temperature_outside(double radius) const;
};

}  // namespace peritherm
