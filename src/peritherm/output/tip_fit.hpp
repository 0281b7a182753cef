#pragma once

#include <cstddef>

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/discretisation/point_values.hpp"
#include "peritherm/output/observer.hpp"

namespace peritherm {

/// The singularity of the heat flux at the tip of an insulated crack. With r and θ about the tip, θ = 0 ahead of it,
///
///     T = T₀ − (2 K / k) √(r / 2π) sin(θ/2) + b r cos θ + c r^(3/2) sin(3θ/2) + …,
///
/// so that ahead of it the flux along the left normal of the direction of growth is K / √(2π r). Ahead of a tip that
/// grows with speed v it lags behind: all but T₀ has the factor exp(−v r cos θ / 2α) besides.
struct TipFit {
  double intensity = 0.0;    ///< K [W/m^(3/2)]; NaN where points are too few
  double uncertainty = 0.0;  ///< of K, by how it changes when points farther away are left out
  std::size_t points = 0;    ///< that K is from
};

/// By least squares over the points in a ring around the tip.
TipFit fit_tip(const Grid& grid, const PointValues& temperature, const TipSite& site);

}  // namespace peritherm
