#include "peritherm/simulation/assemble.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "peritherm/base/error.hpp"
#include "peritherm/discretisation/row_intervals.hpp"
#include "peritherm/operators/fourier_sum.hpp"
#include "peritherm/simulation/backend_choice.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/displacement_series.hpp"
#include "peritherm/simulation/material_table.hpp"
#include "peritherm/simulation/mirror_cracks.hpp"

namespace peritherm {
namespace {

constexpr std::size_t kernel_number = 0;  ///< of the stencil's loops: the fastest of this machine

/// In 2-D bonds through a tip stay whole. A tip on a face is moved out of the body, so that those along the face are
/// cut.
Crack reach_out(Crack crack, const Grid& grid) {
  if (grid.dimension != 2 || crack.points.front() == crack.points.back()) return crack;
  // Ten times what moves points off a crack, and far below any spacing.
  const double reach = 1e-5 * grid.spacing;
  const auto extend = [&](Coordinates& end, const Coordinates& inner) {
    bool on_face = false;
    for (int axis = 0; axis < 2; ++axis) {
      const double depth = end[axis] - grid.origin[axis];
      on_face =
          on_face || std::abs(depth) < 1e-9 * grid.spacing || std::abs(depth - grid.length(axis)) < 1e-9 * grid.spacing;
    }
    const double length = std::hypot(end[0] - inner[0], end[1] - inner[1]);
    for (int axis = 0; axis < 2 && on_face; ++axis) end[axis] += (end[axis] - inner[axis]) * reach / length;
    return on_face;
  };
  const std::vector<Coordinates> points = crack.points;
  extend(crack.points.back(), points[points.size() - 2]);
  if (extend(crack.points.front(), points[1]) && crack.tip_speed) {
    crack.start_time = std::max(0.0, crack.start_time - reach / *crack.tip_speed);
  }
  return crack;
}

WallKind wall_kind(const BoundaryCondition& condition) {
  const auto* held = std::get_if<HeldTemperature>(&condition);
  if (held == nullptr || holds_inside(*held)) return WallKind::even;
  return held->imposed == Imposed::mirror ? WallKind::odd : WallKind::constant;
}

/// Calls visit(point) for the layer of points `depth` points below a face.
template <class Visit>
void for_layer(const Grid& grid, Face face, int depth, Visit&& visit) {
  const int axis = axis_of(face);
  GridIndex high{grid.count(0), grid.count(1), grid.count(2)};
  GridIndex low{};
  low[axis] = is_upper(face) ? grid.count(axis) - 1 - depth : depth;
  high[axis] = low[axis] + 1;
  for (int z = low[2]; z < high[2]; ++z) {
    for (int y = low[1]; y < high[1]; ++y) {
      for (int x = low[0]; x < high[0]; ++x) visit(GridIndex{x, y, z});
    }
  }
}

void place_on_face(const BoundaryOptions& boundary, std::size_t number, Body& body) {
  FaceWalls& wall = body.walls[static_cast<int>(*boundary.face)];
  wall.open = wall.open || is_open(boundary);
  if (wall.boundary_of.empty()) wall.boundary_of.assign(body.wall_places(*boundary.face), -1);
  const double slack = 1e-9 * body.grid.spacing;
  for_layer(body.grid, *boundary.face, 0, [&](const GridIndex& p) {
    if (boundary.where && !contains(*boundary.where, body.grid.wall_position(*boundary.face, p), slack)) return;
    wall.boundary_of[body.wall_place(*boundary.face, p)] = static_cast<std::int16_t>(number);
  });
}

/// Does it decide the temperature of points of the body?
bool holds_points(const BoundaryCondition& condition) {
  return std::holds_alternative<HeldTemperature>(condition) || ties_points(condition);
}

/// Number of layers of points that a condition on a face holds: the wall's own for fictitious points outside.
int held_layers(const BoundaryCondition& condition, const Grid& grid, double horizon, const Stencil& stencil) {
  if (ties_points(condition)) {
    return outside_of(condition) == Outside::slaved ? slaved_points(stencil, horizon, grid.spacing) : 1;
  }
  const auto& held = std::get<HeldTemperature>(condition);
  if (held.imposed == Imposed::row) return 1;
  if (held.imposed != Imposed::inner) return grid.placement == PointPlacement::boundary ? 1 : 0;
  const double depth = held.thickness.value_or(horizon) / grid.spacing - grid.first_depth();
  return static_cast<int>(std::floor(depth + 1e-9)) + 1;
}

/// Where two faces meet, the later axis decides; held temperatures go before points that follow others, and selected
/// points before faces.
std::vector<std::size_t> order_of_holding(const Problem& problem) {
  std::vector<std::size_t> order(problem.boundaries.size());
  for (std::size_t b = 0; b < order.size(); ++b) order[b] = b;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto rank = [&](std::size_t k) {
      const auto& face = problem.boundaries[k].face;
      if (ties_points(problem.boundaries[k].condition)) return face ? axis_of(*face) - 3 : 0;
      return face ? axis_of(*face) : 3;
    };
    return rank(a) < rank(b);
  });
  return order;
}

/// Calls visit(point) for what a boundary holds.
template <class Visit>
void for_held(const BoundaryOptions& boundary, std::size_t number, const Geometry& geometry, Visit&& visit) {
  const Body& body = geometry.body;
  const Grid& grid = body.grid;
  if (boundary.face) {
    const int layers =
        std::min(held_layers(boundary.condition, grid, geometry.stencil_options.horizon, geometry.stencil),
                 grid.count(axis_of(*boundary.face)));
    for (int depth = 0; depth < layers; ++depth) {
      for_layer(grid, *boundary.face, depth, [&](const GridIndex& p) {
        if (body.boundary_at(*boundary.face, p) == static_cast<int>(number)) visit(p);
      });
    }
    return;
  }
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const GridIndex p = grid.index(n);
    if (contains(*boundary.where, grid.position(p), 1e-9 * grid.spacing)) visit(p);
  }
}

void hold_points(const Problem& problem, Geometry& geometry) {
  const Body& body = geometry.body;
  geometry.held_boxes.resize(problem.boundaries.size());
  for (const std::size_t b : order_of_holding(problem)) {
    const BoundaryOptions& boundary = problem.boundaries[b];
    if (!holds_points(boundary.condition)) continue;
    std::size_t count = 0;
    for_held(boundary, b, geometry, [&](const GridIndex& p) {
      const std::size_t n = body.grid.number(p);
      if (body.material_of[n] == no_material) return;
      geometry.held_by.hold(n, static_cast<std::int16_t>(b), body.grid.size());
      geometry.held_boxes[b].include(p);
      ++count;
    });
    const auto* held = std::get_if<HeldTemperature>(&boundary.condition);
    if (count == 0 && (!boundary.face || held == nullptr || holds_inside(*held))) {
      throw Error("boundary." + std::to_string(b) + ": holds no point",
                  "Choose a thicker layer, or a part of the body that is not cut away");
    }
  }
}

/// The points that may exchange heat with what a boundary holds.
std::vector<ConductionOperator::Stretch> find_near_held(const Geometry& geometry, const BoundaryOptions& boundary,
                                                        std::size_t number, const PaddedGrid& layout) {
  if (!holds_points(boundary.condition)) return {};
  const Grid& grid = geometry.body.grid;
  const int radius = geometry.stencil.radius;
  IndexBox box = geometry.held_boxes[number];
  if (boundary.face) {
    const int axis = axis_of(*boundary.face);
    GridIndex first{}, last{grid.count(0) - 1, grid.count(1) - 1, grid.count(2) - 1};
    (is_upper(*boundary.face) ? first : last)[axis] = is_upper(*boundary.face) ? grid.count(axis) - 1 : 0;
    box.include(first);
    box.include(last);
  }
  std::vector<RowInterval> rows;
  append_box(grid, {box.low[0] - radius, box.low[1] - radius, box.low[2] - radius},
             {box.high[0] + radius, box.high[1] + radius, box.high[2] + radius}, rows);
  std::vector<ConductionOperator::Stretch> stretches;
  for (const RowInterval& row : rows) {
    stretches.push_back({static_cast<std::int64_t>(layout.entry(first_point(grid, row))), row.end - row.begin});
  }
  return stretches;
}

/// Points that are held at a temperature, without those that follow others.
HeldPoints held_at_temperatures(const Problem& problem, const Geometry& geometry) {
  HeldPoints held;
  const std::size_t count = geometry.held_by.boundaries().size();
  for (std::size_t n = 0; n < count; ++n) {
    const std::int16_t b = geometry.held_by[n];
    if (b >= 0 && !ties_points(problem.boundaries[static_cast<std::size_t>(b)].condition)) held.hold(n, b, count);
  }
  return held;
}

std::unique_ptr<ConductionOperator> make_bond_backend(const Geometry& geometry, const PaddedGrid& layout,
                                                      Precision precision) {
  const Body& body = geometry.body;
  const Points points = make_points(body, layout);
  std::map<std::int64_t, std::size_t> number_of;
  const bool partly_held =
      std::any_of(body.walls.begin(), body.walls.end(), [](const FaceWalls& wall) { return wall.partly_held; });
  if (partly_held) {
    for (std::size_t n = 0; n < points.size(); ++n) number_of[points.entries[n]] = n;
  }
  const auto partner = [&](std::size_t i, std::size_t j) {
    if (!partly_held) return j;
    const GridIndex other = partner_of(body, layout.index(static_cast<std::size_t>(points.entries[i])),
                                       layout.index(static_cast<std::size_t>(points.entries[j])));
    return number_of.at(static_cast<std::int64_t>(layout.entry(other)));
  };
  std::vector<double> inverse_capacities;
  for (std::size_t n = 0; n < points.owned; ++n) {
    const std::size_t point = body.grid.number(layout.index(static_cast<std::size_t>(points.entries[n])));
    const double capacity = volumetric_heat_capacity(body.materials[points.materials[n]]) * points.volumes[n];
    inverse_capacities.push_back(geometry.held_by[point] < 0 ? 1.0 / capacity : 0.0);
  }
  std::vector<std::int64_t> owned(points.entries.begin(),
                                  points.entries.begin() + static_cast<std::ptrdiff_t>(points.owned));
  return make_bond_operator(make_bonds(points, geometry.stencil, BondTracer(body), partner), std::move(owned),
                            std::move(inverse_capacities), layout.size(), precision);
}

std::shared_ptr<const StencilSum> make_uniform_sum(const Geometry& geometry, const PaddedGrid& layout,
                                                   BackendName backend, Precision precision) {
  if (backend == BackendName::bond) return nullptr;
  if (backend == BackendName::fourier) return make_fourier_sum(layout, geometry.stencil, precision);
  return make_direct_sum(layout, geometry.stencil, kernel_number, precision);
}

/// `uniform`: none for the bond backend.
std::unique_ptr<ConductionOperator> make_backend(const Geometry& geometry, const PaddedGrid& layout,
                                                 Precision precision, std::shared_ptr<const StencilSum> uniform) {
  if (!uniform) return make_bond_backend(geometry, layout, precision);
  return make_stencil_operator(geometry.body, layout, geometry.stencil, geometry.held_by, kernel_number,
                               std::move(uniform));
}

/// Every bond conducts at most as the best material does, and every point stores at least as the poorest.
double spectral_bound(const Geometry& geometry) {
  const Body& body = geometry.body;
  // Bonds along mirroring faces conduct better than the stencil's.
  if (!body.faces.empty()) return 0.0;
  // Walls that differ from place to place continue the body to no lattice of this stencil.
  for (const FaceWalls& wall : body.walls) {
    if (wall.partly_held) return 0.0;
  }
  double conductivity = 0.0, capacity = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    if (std::find(body.material_of.begin(), body.material_of.end(), m) == body.material_of.end()) continue;
    conductivity = std::max(conductivity, body.materials[m].conductivity);
    capacity = std::min(capacity, volumetric_heat_capacity(body.materials[m]));
  }
  // What lies along a bond may conduct better than what its ends are of.
  if (body.interface == InterfaceRule::length_weighted_harmonic || body.interface == InterfaceRule::sided_harmonic) {
    conductivity = std::max(conductivity, body.materials[body.background].conductivity);
    for (const MaterialRegion& region : body.regions) {
      if (region.material != no_material) {
        conductivity = std::max(conductivity, body.materials[region.material].conductivity);
      }
    }
  }
  return conductivity * largest_symbol(geometry.stencil, body.grid.dimension) / (capacity * body.grid.cell_volume());
}

/// Do points stand on a face outside which nothing stands?
bool stands_on_open_face(const Problem& problem) {
  return make_grid(problem).placement == PointPlacement::boundary &&
         std::any_of(problem.boundaries.begin(), problem.boundaries.end(), is_open);
}

}  // namespace

std::string name_of_boundary(const BoundaryOptions& boundary, std::size_t number) {
  const std::string type =
      std::visit([](const auto& condition) { return std::string(condition.name); }, boundary.condition);
  const std::string place =
      boundary.face ? std::string(name_of(*boundary.face)) : "region " + std::to_string(number + 1);
  return place + " " + type;
}

bool is_open(const BoundaryOptions& boundary) {
  if (boundary.where) return false;
  const auto* held = std::get_if<HeldTemperature>(&boundary.condition);
  if (held != nullptr) return holds_inside(*held);
  return outside_of(boundary.condition) != Outside::mirror;
}

bool is_symmetric(const Problem& problem) {
  const auto ties = [](const BoundaryOptions& boundary) { return ties_points(boundary.condition); };
  if (std::any_of(problem.boundaries.begin(), problem.boundaries.end(), ties)) return false;
  return *problem.nonlocality.boundary_volumes == BoundaryVolumes::whole || !stands_on_open_face(problem) ||
         *problem.nonlocality.self_term == SelfTerm::none;
}

bool needs_bond_backend(const Problem& problem) {
  if (!stands_on_open_face(problem)) return false;
  return *problem.nonlocality.boundary_volumes == BoundaryVolumes::whole ||
         *problem.nonlocality.self_term != SelfTerm::none;
}

Geometry make_geometry(const Problem& given) {
  const Problem problem = resolved(given);
  Geometry geometry;
  Body& body = geometry.body;
  body.grid = make_grid(problem);
  body.interface = *problem.nonlocality.interface;
  body.boundary_volumes = *problem.nonlocality.boundary_volumes;
  const MaterialTable table = make_material_table(problem);
  body.materials = table.materials;
  geometry.material_names = table.names;
  body.contacts = make_material_contacts(problem, table);
  body.background = table.background;
  for (std::size_t r = 0; r < table.of_region.size(); ++r)
    body.regions.push_back({problem.body.regions[r].shape, table.of_region[r]});
  body.assign_materials();
  refuse_idle_contacts(problem, table, body);
  for (const Crack& crack : problem.cracks)
    body.cracks.emplace_back(reach_out(crack, body.grid), body.grid.dimension, body.grid.spacing);
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    body.wall_kinds.push_back(wall_kind(problem.boundaries[b].condition));
    geometry.boundary_names.push_back(name_of_boundary(problem.boundaries[b], b));
    if (problem.boundaries[b].face) place_on_face(problem.boundaries[b], b, body);
  }
  body.inspect_walls();
  geometry.stencil_options = stencil_options_of(problem);
  geometry.stencil = make_stencil(geometry.stencil_options, body.grid.spacing, body.grid.dimension);
  body.broken = break_bonds(problem, body, geometry.stencil);
  body.faces = mirror_cracks(problem, geometry);
  hold_points(problem, geometry);
  return geometry;
}

Assembly assemble(const Problem& given) {
  const Problem problem = resolved(given);
  Geometry geometry = make_geometry(problem);
  const PaddedGrid layout(geometry.body.grid, geometry.stencil.radius);
  const BackendName backend = expect_backend(problem, geometry.stencil, 1).backend;
  HeatSystemParts parts;
  std::vector<bool> depends_on_place;
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    const auto* held = std::get_if<HeldTemperature>(&problem.boundaries[b].condition);
    depends_on_place.push_back(held != nullptr && CompiledProfile(held->value).depends_on_place());
    parts.near_held.push_back(find_near_held(geometry, problem.boundaries[b], b, layout));
  }
  parts.ghosts =
      std::make_unique<GhostLayer>(geometry.body, layout, held_at_temperatures(problem, geometry), depends_on_place);
  for (const WallSlots& slots : parts.ghosts->slots()) {
    const auto* held =
        std::get_if<HeldTemperature>(&problem.boundaries[static_cast<std::size_t>(slots.boundary)].condition);
    if (held != nullptr && slots.begin.size() > 1)
      parts.wall_temperatures.add(slots.boundary, held->value, slots.places, slots.begin);
  }
  parts.grid = geometry.body.grid;
  parts.ghosts->add_followers(make_followers(problem, geometry, layout, parts.exchange_values));
  parts.exchanges = make_exchanges(problem, geometry, layout, parts.exchange_values);
  parts.sources = make_sources(problem, geometry, layout);
  parts.boundary_names = geometry.boundary_names;
  parts.symmetric = is_symmetric(problem);
  // Bodies that are not are continued by no lattice.
  parts.spectral_bound = parts.symmetric ? spectral_bound(geometry) : 0.0;
  // Bonds in single precision are still summed in double.
  const bool coarse = problem.numerics.precision == Precision::single && backend != BackendName::bond;
  parts.rate_rounding = coarse ? 0x1p-24 : 0x1p-53;
  parts.bound_is_sharp = parts.spectral_bound > 0.0 && geometry.body.regions.empty();
  auto uniform = make_uniform_sum(geometry, layout, backend, problem.numerics.precision);
  parts.conduction = make_backend(geometry, layout, problem.numerics.precision, uniform);
  return {std::move(geometry), layout, backend, std::make_unique<HeatSystem>(std::move(parts)), std::move(uniform)};
}

std::unique_ptr<ConductionOperator> make_conduction(const Problem& problem, const Assembly& assembly) {
  return make_backend(assembly.geometry, assembly.layout, problem.numerics.precision, assembly.uniform);
}

}  // namespace peritherm
