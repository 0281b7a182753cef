#pragma once

#include <vector>

#include "peritherm/base/describe.hpp"
#include "peritherm/discretisation/grid.hpp"
#include "peritherm/physics/kernel.hpp"
#include "peritherm/physics/partial_volume.hpp"
#include "peritherm/physics/self_term.hpp"

namespace peritherm {

/// What makes the bonds conduct like Fourier's law.
enum class Calibration {
  discrete,  ///< the second moment of the grid's bonds is exact: second order
  continuum  ///< the integral over the horizon is exact: as in the papers; stalls at a fixed horizon ratio
};

template <>
struct EnumNames<Calibration> {
  static constexpr std::array<std::pair<Calibration, std::string_view>, 2> values{
      {{Calibration::discrete, "discrete"}, {Calibration::continuum, "continuum"}}};
};

/// One neighbour offset of a uniform grid and the conductance of that bond between whole cells of unit
/// conductivity, κ(ξ) V² [m] in 3-D.
struct StencilEntry {
  GridIndex offset;
  double conductance;
};

/// All neighbours of a point deep inside a grid, in the order of their numbers; symmetric under reflection.
struct Stencil {
  int radius = 0;  ///< largest offset along any axis
  std::vector<StencilEntry> entries;
  std::vector<double> self;  ///< what of each entry's conductance stands for the point's own cell; empty if nothing
};

struct StencilOptions {
  Kernel kernel;
  double horizon = 0.0;  ///< [m]
  PartialVolumes partial_volumes = PartialVolumes::partial_area;
  Calibration calibration = Calibration::discrete;
  SelfTerm self_term = SelfTerm::none;
};

/// Throws Error if the horizon reaches no neighbour.
Stencil make_stencil(const StencilOptions& options, double spacing, int dimension);

/// (1/2) Σ G ξ_x² over the stencil and the cell volume: the conductivity that a linear field feels; 1 if exact.
double effective_conductivity(const Stencil& stencil, double spacing, int dimension);

/// Upper bound of max over wave vectors of Σ G (1 − cos k·ξ), sharp to 0.2 % [m in 3-D]. Bodies of this
/// stencil with mirrored or open surfaces have no faster mode.
double largest_symbol(const Stencil& stencil, int dimension);

}  // namespace peritherm
