#pragma once

#include <vector>

namespace peritherm {

/// Sine integral Si(z) = ∫₀^z sin(s)/s ds, of any z, to a few roundings.
double sine_integral(double z);

/// Rate of decay of a wave in an unbounded peridynamic body of constant micro-conductivity α/δ over the classical one,
/// z = wave number · δ [mei2021, eq. 7]; of any z:
///   A(z) = (2/z) ∫₀^z (1 − cos s)/s² ds = 2 (Si(z) + (cos z − 1)/z) / z
double nonlocal_factor(double z);

/// dA/dz [mei2021, eq. 9].
double nonlocal_factor_slope(double z);

struct NonlocalSlab {
  double length;       ///< L [m]
  double diffusivity;  ///< α [m²/s]
  double horizon;      ///< δ [m]
};

/// Held at 0 at both ends, which mirror the temperature with the opposite sign; start 1 [mei2021, eq. 6]:
///   Σ_{n odd} 4/(nπ) sin(k x) exp(−α A(kδ) k² t),  k = nπ/L
/// The rates grow like n only, so that the sum is long at early times: what is summed is the difference to two series
/// with the same tail, which have closed forms. Error below 1e-10 for all times.
double nonlocal_slab_with_held_ends(const NonlocalSlab& slab, double x, double t);

/// Its slope over the horizon ∂T/∂δ [mei2021, eq. 8], for times t > 1e-4 δ L/α.
double nonlocal_slab_slope_over_horizon(const NonlocalSlab& slab, double x, double t);

}  // namespace peritherm
