#pragma once

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm {

/// One step of GS4-1 with Δ = T(n+1) − T(n) and rates v [masuri2011, jansen2000]:
///   α_m v(n+1) + (1 − α_m) v(n) = rate(t(n) + α_f h, T(n) + α_f Δ),  Δ = h ((1 − γ) v(n) + γ v(n+1)).
/// v(n) stands for the rate at t(n) + (α_f − α_m) h, which is not t(n) unless γ = 1/2.
struct Gs4Parameters {
  double alpha_m = 1.0;
  double alpha_f = 1.0;
  double gamma = 1.0;

  /// σ of the step's matrix σ C + K: C weighs α_m / (γ h), K weighs α_f [1/s].
  double shift(double step) const { return alpha_m / (alpha_f * gamma * step); }
  /// Time after t(n) at which v(n) is the rate, over the step.
  double lag() const { return alpha_f - alpha_m; }
  /// c of the error c h³ T''' of a step: 1/12 for Crank-Nicolson and midpoint, 1/3 for BDF2.
  double error_constant() const { return (0.5 - gamma) * (0.5 - alpha_m) + gamma * (1.0 - gamma) - 1.0 / 6.0; }
};

/// Of spectral radii at infinity 0 <= rho_rate <= rho <= 1: order 2, and fast decays leave −rho and −rho_rate.
constexpr Gs4Parameters gs4_parameters(double rho, double rho_rate) {
  const double alpha_f = 1.0 / (1.0 + rho), gamma = 1.0 / (1.0 + rho_rate);
  return {gamma + alpha_f - 0.5, alpha_f, gamma};
}

inline constexpr Gs4Parameters backward_euler{};

/// Throws Error if the numbers are missing, too many, or in the wrong order.
Gs4Parameters gs4_parameters(const GeneralisedSingleStep& options);
/// What is wrong with the numbers; an empty problem: nothing.
Issue find_fault(const GeneralisedSingleStep& options);

}  // namespace peritherm
