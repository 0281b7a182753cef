#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "peritherm/base/field_storage.hpp"
#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/held_points.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/operators/stencil_sum.hpp"
#include "peritherm/simulation/problem.hpp"
#include "peritherm/system/heat_system.hpp"

namespace peritherm {

/// The smallest box of indices around some points.
struct IndexBox {
  GridIndex low{std::numeric_limits<int>::max() / 2, std::numeric_limits<int>::max() / 2,
                std::numeric_limits<int>::max() / 2};
  GridIndex high{-low[0], -low[1], -low[2]};
  void include(const GridIndex& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
};

/// The body of a problem, ready to be given bonds.
struct Geometry {
  Body body;
  StencilOptions stencil_options;
  Stencil stencil;
  HeldPoints held_by;
  std::vector<IndexBox> held_boxes;         ///< per boundary: around the points that it holds
  std::vector<std::string> material_names;  ///< in the order of Body::materials
  std::vector<std::string> boundary_names;  ///< "y_max temperature"
};

/// "y_max temperature", or "region 3 flux" of the third boundary.
std::string name_of_boundary(const BoundaryOptions& boundary, std::size_t number);

/// Nothing stands outside a face that is held as a whole by points inside, or where points inside impose what passes.
bool is_open(const BoundaryOptions& boundary);

/// Does every bond conduct the same both ways? Points that follow others and self terms of parts of cells do not. Of a
/// resolved problem.
bool is_symmetric(const Problem& problem);

/// Are there points on open faces whose bonds are not those of the stencil? Of a resolved problem.
bool needs_bond_backend(const Problem& problem);

/// How many of the outermost points a slaved face ties to the next one: those within a horizon of it, whether the
/// kernel lets all of them conduct or not [bobaru2010, eq. 22].
int slaved_points(const Stencil& stencil, double horizon, double spacing);

/// The problem must have passed `check`.
Geometry make_geometry(const Problem& problem);

/// What a run works with.
struct Assembly {
  Geometry geometry;
  PaddedGrid layout;
  BackendName backend;  ///< never automatic
  std::unique_ptr<HeatSystem> system;
  std::shared_ptr<const StencilSum> uniform;  ///< of the system's conduction; none of the bond backend
};

/// Where the problem leaves the backend open, the cost model decides; see choose_backend for a choice by measurement.
Assembly assemble(const Problem& problem);

/// Conduction of an assembly whose body has been given other faces. The problem must be resolved.
std::unique_ptr<ConductionOperator> make_conduction(const Problem& problem, const Assembly& assembly);

/// State at time 0: initial temperatures, no heat passed.
FieldStorage initial_state(const Problem& problem, const Assembly& assembly);

/// Points that slaved faces and those with a flux formula tie to others; appends their fluxes to `fluxes`. Throws Error
/// if one has nothing to follow.
Followers make_followers(const Problem& problem, const Geometry& geometry, const PaddedGrid& layout,
                         PrescribedValues& fluxes);

/// Heat exchanges of the flux and convection boundaries; fills `values` with what they prescribe.
std::vector<SurfaceExchange> make_exchanges(const Problem& problem, const Geometry& geometry, const PaddedGrid& layout,
                                            PrescribedValues& values);

/// What heats the points of the body from within. Throws Error if a source heats no point.
std::vector<HeatedPart> make_sources(const Problem& problem, const Geometry& geometry, const PaddedGrid& layout);

/// Heat flux vector at every point [W/m²], NaN where cut away: one-sided in 1-D [bobaru2010, eq. 12], from the hotter
/// neighbours in 2-D and 3-D [bobaru2012, eq. 7]; it points from hot to cold. `state` must be filled.
std::vector<Point> heat_flux(const Assembly& assembly, ConstField state);
/// The same for the points first, first + 1, … only.
void heat_flux(const Assembly& assembly, ConstField state, std::size_t first, std::span<Point> flux);

}  // namespace peritherm
