#pragma once

namespace peritherm {

/// Solutions of the local heat equation ∂T/∂t = α ∇²T, to about rounding for every time; any consistent units.
/// Slabs reach from x = 0 to `length`; t ≥ 0. Early times are summed over images, late ones over Fourier modes.
struct Slab {
  double length;       ///< L [m]
  double diffusivity;  ///< α = k / (ρ c) [m²/s]
};

/// Both ends held at 0, start 1 [carslaw1959, sections 3.3 and 3.4]:
///   Σ_{n odd} 4/(nπ) sin(nπx/L) exp(−α (nπ/L)² t)
double slab_with_held_ends(const Slab& slab, double x, double t);

/// Square with all sides, cube with all faces held at 0, start 1: products of the slab's solution.
double square_with_held_sides(const Slab& slab, double x, double y, double t);
double cube_with_held_faces(const Slab& slab, double x, double y, double z, double t);

/// Held at 0 at x = 0, insulated at x = L, start 1: half of a slab of twice the length.
double slab_held_and_insulated(const Slab& slab, double x, double t);

/// Held at 1 at x = 0, insulated at x = L and at all other sides, start 0 [bobaru2012, example 2].
double slab_heated_from_one_end(const Slab& slab, double x, double t);

/// Two temperatures at the start.
struct StepStart {
  double left;   ///< at x < place
  double right;  ///< at x > place
  double place;  ///< [m]
};

/// Insulated at x = 0, held at `held` at x = L [bobaru2010, example 2, with the sign of eq. 38 mended].
double slab_with_step_start(const Slab& slab, const StepStart& start, double held, double x, double t);

/// Start 0, held at `held` at x = 0, slope ∂T/∂x = `gradient` at x = L [bobaru2010, example 3; carslaw1959, section
/// 3.8]: held + gradient x − Σ_{n odd} (4 held/(nπ) + gradient (−1)^((n−1)/2) 8L/(nπ)²) sin(nπx/2L) exp(−α (nπ/2L)² t)
double slab_with_prescribed_gradient(const Slab& slab, double held, double gradient, double x, double t);

/// ∂T/∂x of these; the heat flux is −k times it. At t = 0 it is 0, without what starts at ends and steps.
double slope_of_slab_with_held_ends(const Slab& slab, double x, double t);
double slope_of_slab_held_and_insulated(const Slab& slab, double x, double t);
double slope_of_slab_with_step_start(const Slab& slab, const StepStart& start, double held, double x, double t);
double slope_of_slab_with_prescribed_gradient(const Slab& slab, double held, double gradient, double x, double t);

/// Body without inner resistance that exchanges heat with its surroundings, C dT/dt = h A (T∞ − T):
///   T∞ + (start − T∞) exp(−rate t), rate = h A / C [1/s].
double lumped_convection(double start, double ambient, double rate, double t);

/// Insulated slit |x| < half_length, y = 0, in an unbounded body with the gradient 1 along y far away:
///   Im √(z² − a²), z = x + iy. On the slit y = 0.0 is its upper and y = −0.0 its lower face.
double slit_in_gradient(double half_length, double x, double y);

/// Insulated slit |x| < half_length, y = 0, in the square [−1, 1]², held at ±1 at y = ±1, insulated at x = ±1;
/// steady. A quarter is mapped by sn² to a half-plane and back to a rectangle; 0 < half_length < 1. Faces as above.
double slit_in_square(double half_length, double x, double y);

/// Heat that flows through that square over the heat that flows without slit.
double slit_in_square_conductance(double half_length);

}  // namespace peritherm
