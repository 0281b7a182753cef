#pragma once

#include <span>

#include "peritherm/two_field/families.hpp"
#include "peritherm/two_field/gradient_classes.hpp"
#include "peritherm/two_field/traces.hpp"

namespace peritherm {

/// The least change of the gradient, Σ dG² / W with W = V_j / |ξ|², that keeps linear temperatures exact and gives
/// Green's identity on the traces, as operators with summation by parts have it [fernandez2014]:
///   Σ_j dG_ij = 0,   Σ_j dG_ij ξ_ij = 0,   Vᵀ (G + dG)_a = Σ_p A_p n_pa P_p.
/// dG = W z belongs to multipliers μ that minimise the energy of what is not linear along bonds (z), a sparse symmetric
/// system; one factor serves all axes. Only points below the surface change, as far as Vᵀ G or a trace reaches, so that
/// the inside of a lattice keeps its one row. Corners alone would not do: bonds cut by a face carry a moment along it
/// that must go on around the corner. Throws Error (Fault::numerics) if the surface does not close, Σ A n = 0 and
/// Σ A n xᵀ = (Σ V) 1.
std::vector<GradientChange> find_green_correction(const SubDomain& part, std::span<const SurfacePoint> surface,
                                                  std::span<const Trace> traces, const Families& families,
                                                  const GradientClasses& gradient);

}  // namespace peritherm
