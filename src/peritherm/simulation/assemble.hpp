#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/system/heat_system.hpp"

namespace peritherm {

/// The body of a problem, ready to be given bonds.
struct Geometry {
  Body body;
  StencilOptions stencil_options;
  Stencil stencil;
  std::vector<std::int16_t> held_by;        ///< per point: index of the boundary that holds it, −1 for free ones
  std::vector<std::string> material_names;  ///< in the order of Body::materials
  std::vector<std::string> boundary_names;  ///< "y_max temperature"
};

/// The problem must have passed `check`.
Geometry make_geometry(const Problem& problem);

/// "stencil" or "bond".
BackendName choose_backend(const Problem& problem);

/// What a run works with.
struct Assembly {
  Geometry geometry;
  PaddedGrid layout;
  BackendName backend;
  std::unique_ptr<HeatSystem> system;
};

Assembly assemble(const Problem& problem);

/// State at time 0: initial temperatures, no heat passed.
std::vector<double> initial_state(const Problem& problem, const Assembly& assembly);

/// Heat exchanges of the flux and convection boundaries; fills `values` with what they prescribe.
std::vector<SurfaceExchange> make_exchanges(const Problem& problem, const Geometry& geometry, const PaddedGrid& layout,
                                            PrescribedValues& values);

/// Heat flux vector at every point [W/m²], NaN where cut away: one-sided in 1-D [bobaru2010, eq. 12], from the hotter
/// neighbours in 2-D and 3-D [bobaru2012, eq. 7]; it points from hot to cold. `state` must be filled.
std::vector<Point> heat_flux(const Assembly& assembly, ConstField state);
/// The same for the points first, first + 1, … only.
void heat_flux(const Assembly& assembly, ConstField state, std::size_t first, std::span<Point> flux);

}  // namespace peritherm
