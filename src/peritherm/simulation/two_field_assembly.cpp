#include "peritherm/simulation/two_field_assembly.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "peritherm/geometry/vector.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/two_field_loads.hpp"

namespace peritherm {
namespace {

/// The tensor of a material [W/(m K)].
Tensor conductivity_of(const Material& material, int dimension) {
  if (!material.conductivity_tensor) return isotropic_tensor(dimension, material.conductivity);
  const std::vector<double>& t = *material.conductivity_tensor;
  if (dimension == 2) return {{{t[0], t[2], 0.0}, {t[2], t[1], 0.0}, {0.0, 0.0, 0.0}}};
  return {{{t[0], t[3], t[5]}, {t[3], t[1], t[4]}, {t[5], t[4], t[2]}}};
}

PartLaw law_of(const Material& material, int dimension) {
  return {volumetric_heat_capacity(material), conductivity_of(material, dimension), relaxation_time(material.flux_law),
          fourier_share(material.flux_law), material.stabilisation.value_or(default_stabilisation(material.flux_law))};
}

/// Where the traces of a surface point stand: its place in the lists of the parts on both sides.
struct SurfaceSides {
  std::size_t first = 0, second = 0;
};

/// Operators of all parts, and for each surface point where its traces are.
struct PartOperators {
  std::vector<NonlocalOperators> operators;
  std::vector<SurfaceSides> sides;
};

PartOperators make_operators(const DividedBody& body, const Kernel& kernel) {
  PartOperators made;
  std::vector<std::vector<SurfacePoint>> surfaces(body.parts.size());
  for (const SurfacePoint& place : body.surface) {
    SurfaceSides sides;
    std::vector<SurfacePoint>& of_first = surfaces[static_cast<std::size_t>(place.first)];
    sides.first = of_first.size();
    of_first.push_back(place);
    if (place.second >= 0) {
      std::vector<SurfacePoint>& of_second = surfaces[static_cast<std::size_t>(place.second)];
      sides.second = of_second.size();
      of_second.push_back(place);
      for (double& component : of_second.back().normal) component = -component;
    }
    made.sides.push_back(sides);
  }
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    made.operators.emplace_back(body.dimension, body.parts[p], surfaces[p], kernel);
  }
  return made;
}

/// Collects the rows of a body, what they mean, and the fluxes through its surface.
/// a first + b second, each point once.
Trace mean_of(const Trace& first, double a, const Trace& second, double b) {
  std::map<PointIndex, double> weights;
  for (std::size_t k = 0; k < first.points.size(); ++k) weights[first.points[k]] += a * first.weights[k];
  for (std::size_t k = 0; k < second.points.size(); ++k) weights[second.points[k]] += b * second.weights[k];
  Trace mean;
  for (const auto& [point, weight] : weights) {
    mean.points.push_back(point);
    mean.weights.push_back(weight);
  }
  return mean;
}

class RowCollector {
 public:
  RowCollector(const Problem& problem, const DividedBody& body, const MaterialTable& table, const PartOperators& parts)
      : problem_(problem), body_(body), table_(table), parts_(parts) {
    std::size_t first = 0;
    for (const SubDomain& part : body.parts) {
      first_.push_back(first);
      first += part.size();
    }
  }

  void collect() {
    for (std::size_t s = 0; s < body_.surface.size(); ++s) {
      if (body_.surface[s].second >= 0) {
        add_interface(s);
      } else {
        add_boundary(s);
      }
    }
  }

  std::vector<ContactRow> rows;
  std::vector<RowMeaning> meanings;
  std::vector<Interface> interfaces;
  std::vector<LoadedEntries> fluxes;

 private:
  /// A name may stand for both: a material's stands for its named regions, too.
  bool is_named_so(const ContactOptions& contact, MaterialIndex a, MaterialIndex b) const {
    const auto means = [this](const std::string& name, MaterialIndex entry) {
      const std::vector<MaterialIndex> entries = table_.find(name);
      return std::find(entries.begin(), entries.end(), entry) != entries.end();
    };
    return means(contact.between[0], a) && means(contact.between[1], b);
  }

  const Trace& trace_of(int part, std::size_t number) const {
    return parts_.operators[static_cast<std::size_t>(part)].traces()[number];
  }

  void add_interface(std::size_t s) {
    const SurfacePoint& place = body_.surface[s];
    const auto material_of = [this](int part) { return body_.parts[static_cast<std::size_t>(part)].material; };
    const MaterialIndex a = material_of(place.first), b = material_of(place.second);
    const int contact = contact_between(problem_, table_, a, b);
    const std::string name = interface_name(problem_, table_, a, b);
    const auto [known, fresh] = number_of_.emplace(name, interfaces.size());
    if (fresh) interfaces.push_back({name, {}, {}});
    // The order of the names decides the sign of the flux.
    const bool along = contact >= 0 ? is_named_so(problem_.contacts[static_cast<std::size_t>(contact)], a, b) : a <= b;
    interfaces[known->second].rows.push_back(rows.size());
    interfaces[known->second].directions.push_back(along ? 1.0 : -1.0);
    rows.push_back({place.first, trace_of(place.first, parts_.sides[s].first), place.second,
                    trace_of(place.second, parts_.sides[s].second), place.area, place.position});
    meanings.push_back({contact, {}});
  }

  void add_boundary(std::size_t s) {
    const SurfacePoint& place = body_.surface[s];
    const int number = boundary_at(problem_, body_, place);
    if (number < 0) return;
    const BoundaryCondition& condition = problem_.boundaries[static_cast<std::size_t>(number)].condition;
    const Trace& trace = trace_of(place.first, parts_.sides[s].first);
    if (const auto* flux = std::get_if<PrescribedFlux>(&condition)) {
      add_flux(number, place, trace, flux->value);
    } else if (!std::holds_alternative<Insulated>(condition)) {
      const bool may_share = body_.dimension > 1 && std::holds_alternative<HeldTemperature>(condition);
      if (!may_share || !joins_row(place, trace, number)) {
        rows.push_back({place.first, trace, -1, {}, place.area, place.position});
        meanings.push_back({-1, {{number, 1.0, place.position}}});
      }
    }
  }

  using Cell = std::array<long, 4>;  ///< part, and the middle in quarters of the spacing

  /// Held faces of one cell, at edges and corners, share a row: each would follow from the others' neighbours. What is
  /// held is their mean. False: the first face of its cell.
  bool joins_row(const SurfacePoint& place, const Trace& trace, int boundary) {
    const double spacing = body_.parts[static_cast<std::size_t>(place.first)].spacing;
    Cell cell{place.first};
    for (int a = 0; a < 3; ++a) {
      cell[a + 1] = std::lround((place.position[a] - 0.5 * spacing * place.normal[a]) / (0.25 * spacing));
    }
    const auto [known, fresh] = held_row_.emplace(cell, rows.size());
    if (fresh) return false;
    ContactRow& row = rows[known->second];
    const double before = row.area / (row.area + place.area), now = 1.0 - before;
    row.first_trace = mean_of(row.first_trace, before, trace, now);
    row.area += place.area;
    row.position = between(row.position, place.position, now);
    for (RowMeaning::Held& held : meanings[known->second].held) held.share *= before;
    meanings[known->second].held.push_back({boundary, now, place.position});
    return true;
  }

  void add_flux(int boundary, const SurfacePoint& place, const Trace& trace, const Profile& profile) {
    if (fluxes.empty() || fluxes.back().account != boundary) fluxes.push_back({CompiledProfile(profile), {}, boundary});
    const std::size_t first = first_[static_cast<std::size_t>(place.first)];
    for (std::size_t k = 0; k < trace.points.size(); ++k) {
      fluxes.back().entries.push_back(
          {first + static_cast<std::size_t>(trace.points[k]), place.area * trace.weights[k], place.position});
    }
  }

  const Problem& problem_;
  const DividedBody& body_;
  const MaterialTable& table_;
  const PartOperators& parts_;
  std::vector<std::size_t> first_;
  std::map<std::string, std::size_t> number_of_;
  std::map<Cell, std::size_t> held_row_;
};

}  // namespace

DividedBody divide(const Problem& problem) {
  const Grid grid = make_grid(problem);
  const MaterialTable table = make_material_table(problem);
  const double horizon = horizon_of(problem);
  std::vector<PartRegion> regions;
  for (std::size_t r = 0; r < problem.body.regions.size(); ++r) {
    const BodyRegion& region = problem.body.regions[r];
    const MaterialIndex material = table.of_region[r];
    const double spacing = region.spacing.value_or(0.0);
    const double own = spacing > 0.0 ? horizon / grid.spacing * spacing : horizon;
    regions.push_back({region.shape, material == no_material ? "void" : table.names[material], material,
                       region.horizon.value_or(own), spacing, region.points,
                       InputLocation{{}, "body.region." + std::to_string(r)}});
  }
  const bool empty = table.background == no_material;
  return divide_body(grid, {empty ? "void" : table.names[table.background], table.background, horizon}, regions);
}

int boundary_at(const Problem& problem, const DividedBody& body, const SurfacePoint& place) {
  const double slack = 0.5 * body.parts[static_cast<std::size_t>(place.first)].spacing;
  int selected = -1;
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    const BoundaryOptions& boundary = problem.boundaries[b];
    const bool on_face = boundary.face && static_cast<int>(*boundary.face) == place.face;
    if (boundary.face && !on_face) continue;
    // On faces edges are sharp; elsewhere surfaces are planar pieces that lie off a round shape.
    if (boundary.where && !contains(*boundary.where, place.position, on_face ? 1e-9 * slack : slack)) continue;
    if (on_face) return static_cast<int>(b);
    if (selected < 0) selected = static_cast<int>(b);
  }
  return selected;
}

std::string interface_name(const Problem& problem, const MaterialTable& table, MaterialIndex first,
                           MaterialIndex second) {
  const int contact = contact_between(problem, table, first, second);
  if (contact >= 0) return name_of(problem.contacts[static_cast<std::size_t>(contact)]);
  return table.names[std::min(first, second)] + " to " + table.names[std::max(first, second)];
}

TwoFieldAssembly assemble_two_field(const Problem& problem) {
  TwoFieldAssembly assembly;
  assembly.body = divide(problem);
  assembly.table = make_material_table(problem);
  PartOperators parts = make_operators(assembly.body, problem.nonlocality.kernel);
  RowCollector collector(problem, assembly.body, assembly.table, parts);
  collector.collect();
  std::vector<PartLaw> laws;
  for (const SubDomain& part : assembly.body.parts) {
    laws.push_back(law_of(assembly.table.materials[part.material], assembly.body.dimension));
  }
  TwoFieldLoads loads =
      make_two_field_loads(problem, assembly.body, collector.rows, collector.meanings, collector.fluxes);
  assembly.interfaces = std::move(collector.interfaces);
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    assembly.account_names.push_back(name_of_boundary(problem.boundaries[b], b));
  }
  if (!problem.sources.empty()) assembly.account_names.emplace_back("sources");
  assembly.system = std::make_unique<TwoFieldSystem>(std::move(parts.operators), std::move(laws),
                                                     std::move(collector.rows), std::move(loads));
  return assembly;
}

TwoFieldState initial_state(const Problem& problem, const TwoFieldAssembly& assembly) {
  const TwoFieldSystem& system = *assembly.system;
  TwoFieldState state = system.make_state();
  const auto fill = [&](const Profile& profile, bool relaxing, Field target) {
    CompiledProfile compiled(profile);
    std::size_t number = 0;
    for (std::size_t p = 0; p < assembly.body.parts.size(); ++p) {
      const bool skip = relaxing && system.laws()[p].relaxation_time == 0.0;
      for (const Point& place : assembly.body.parts[p].positions) {
        if (!skip) target[number] = compiled(place, 0.0);
        ++number;
      }
    }
  };
  fill(problem.initial.temperature, false, state.temperature);
  for (std::size_t axis = 0; problem.initial.heat_flux && axis < state.flux.size(); ++axis) {
    fill((*problem.initial.heat_flux)[axis], true, state.flux[axis]);
  }
  return state;
}

}  // namespace peritherm
