#include "peritherm/simulation/plan.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "peritherm/base/error.hpp"
#include "peritherm/discretisation/broken_bonds.hpp"
#include "peritherm/discretisation/damage.hpp"
#include "peritherm/discretisation/face_pieces.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/geometry/polyline.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/memory.hpp"
#include "peritherm/simulation/schedule.hpp"
#include "peritherm/simulation/simulate.hpp"

namespace peritherm {
namespace {

/// Below this, waiting for one another costs threads more than they gain, above all on a busy machine.
constexpr double least_work_per_thread = 150e-6;

/// While cracks grow, the cutting of bonds sets the steps: so many evaluations per spacing that a tip passes, measured
/// on crossing cracks.
double growth_evaluations(const Problem& problem, double spacing, double tolerance) {
  double passed = 0.0;
  for (const Crack& crack : problem.cracks) {
    if (!crack.tip_speed) continue;
    double length = crack.disc ? crack.disc->radius : 0.0;
    for (std::size_t k = 1; k < crack.points.size(); ++k) {
      const Point a = to_point(crack.points[k - 1]), b = to_point(crack.points[k]);
      length += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }
    const double duration = std::max(0.0, problem.time.end - crack.start_time);
    passed = std::max(passed, std::min(length, *crack.tip_speed * duration) / spacing);
  }
  return 210.0 * passed * std::pow(1e-4 / tolerance, 0.35);
}

/// Conjugate gradients need half the root of the condition number for each factor e of accuracy, twice; the slowest
/// decay is that of a bar as long as the box and insulated at one end.
double steady_evaluations(const Problem& problem, double fastest_rate, double tolerance) {
  const Grid grid = make_grid(problem);
  double length = 0.0;
  for (int axis = 0; axis < grid.dimension; ++axis) length = std::max(length, grid.length(axis));
  double diffusivity = 0.0;
  for (const auto& [name, material] : problem.materials) {
    diffusivity = std::max(diffusivity, material.conductivity / volumetric_heat_capacity(material));
  }
  const double slowest_rate = diffusivity * std::pow(0.5 * std::numbers::pi / length, 2);
  return 10.0 + 0.5 * std::sqrt(fastest_rate / slowest_rate) * std::log(2.0 / tolerance);
}

/// Temperatures are gathered for whatever is written; flux and damage one after the other.
double bytes_while_writing(const OutputKind& kind) {
  std::vector<FieldName> fields;
  if (const auto* vtk = std::get_if<VtkOutput>(&kind)) fields = vtk->fields;
  if (const auto* picture = std::get_if<PictureOutput>(&kind)) fields = {picture->field};
  double most = 0.0;
  for (const FieldName field : fields) {
    most = std::max(most, field == FieldName::heat_flux ? 24.0 : (field == FieldName::damage ? 8.0 : 0.0));
  }
  return 8.0 + most;
}

constexpr double bytes_of_program = 12e6;  // the library, what it links to, and a folder's worth of small things

/// The states that a run holds, and what its outputs take for the moment of writing.
double bytes_of_fields(const Problem& problem, int states) {
  const Grid grid = make_grid(problem);
  const double ratio = horizon_of(problem) / grid.spacing;
  const PaddedGrid layout(grid, static_cast<int>(std::ceil(ratio + 0.5)));
  bool holds = grid.placement == PointPlacement::boundary;
  for (const BoundaryOptions& boundary : problem.boundaries) {
    const auto* held = std::get_if<HeldTemperature>(&boundary.condition);
    holds = holds || ties_points(boundary.condition) || (held != nullptr && (!boundary.face || holds_inside(*held)));
  }
  double per_point = 1.0 + (holds ? 2.0 : 0.0);
  double output = 0.0;
  for (const OutputOptions& options : problem.outputs) output = std::max(output, bytes_while_writing(options.kind));
  per_point += output;
  return bytes_of_program + 8.0 * states * static_cast<double>(layout.size()) +
         per_point * static_cast<double>(grid.size());
}

double bytes_of_bonds(const Grid& grid, std::size_t bonds_per_point) {
  const auto bonds = static_cast<double>(grid.size()) * static_cast<double>(bonds_per_point);
  // Neighbour numbers of the search, entries and conductances while rows are built, then 12 B a bond.
  return bonds * 24.0 + static_cast<double>(grid.size()) * 100.0;
}

std::string readable(double bytes) {
  std::ostringstream text;
  text.precision(3);
  text << bytes / (1024.0 * 1024.0 * 1024.0) << " GiB";
  return text.str();
}

double evaluations_for(const Problem& problem, const TimeStepping& stepping, double fastest_rate, double spacing,
                       std::size_t state_size) {
  if (const auto* steady = std::get_if<SteadyState>(&stepping)) {
    return steady_evaluations(problem, fastest_rate, steady->relative_tolerance);
  }
  double evaluations = estimate_evaluations(stepping, fastest_rate, march_times(problem), state_size);
  if (const auto* stabilised = std::get_if<RungeKuttaLegendre>(&stepping)) {
    evaluations += growth_evaluations(problem, spacing, stabilised->relative_tolerance);
  }
  return evaluations;
}

/// While bonds break by elongation: about four evaluations for each time at which any does, measured on a plate that
/// is torn open (3 to 5).
double breaking_evaluations(const Problem& problem, const TimeStepping& stepping, const BrokenBonds& broken) {
  const auto* stabilised = std::get_if<RungeKuttaLegendre>(&stepping);
  if (stabilised == nullptr || broken.empty()) return 0.0;
  const auto times = static_cast<double>(broken.count_times(0.0, problem.time.end));
  return 4.0 * times * std::pow(1e-4 / stabilised->relative_tolerance, 0.35);
}

void estimate_steps(const Problem& problem, const TimeStepping& stepping, const Assembly& assembly, Plan& plan) {
  HeatSystem& system = *assembly.system;
  const double fastest_rate = system.fastest_rate();
  plan.evaluations = evaluations_for(problem, stepping, fastest_rate, plan.spacing, system.size()) +
                     breaking_evaluations(problem, stepping, assembly.geometry.body.broken);
  std::visit(
      [&](const auto& chosen) {
        plan.stable_step = chosen.stability / fastest_rate;
        if constexpr (requires { chosen.safety; }) {
          plan.step = chosen.step.value_or(chosen.safety * plan.stable_step);
        } else if constexpr (requires { chosen.step; }) {
          plan.step = chosen.step.value_or(0.0);
        }
      },
      stepping);
}

/// Before anything large is made: no bond conducts better than the best of all materials, no point stores less than the
/// poorest.
double expected_fastest_rate(const Problem& problem, const Grid& grid, const Stencil& stencil) {
  double conductivity = 0.0, capacity = std::numeric_limits<double>::infinity();
  for (const auto& [name, material] : problem.materials) {
    conductivity = std::max(conductivity, material.conductivity);
    capacity = std::min(capacity, volumetric_heat_capacity(material));
  }
  return conductivity * largest_symbol(stencil, grid.dimension) / (capacity * grid.cell_volume());
}

/// What does not depend on the bonds of this very body.
double memory_of_run(const Problem& problem, const Stencil& stencil) {
  double bytes =
      bytes_of_fields(problem, std::visit([](const auto& chosen) { return chosen.states; }, problem.time.integrator));
  if (problem.damage) bytes += bytes_of_break_search(make_grid(problem), stencil);
  return bytes;
}

/// Points of a face that follow others by the flux formula keep half of their bonds.
double bytes_of_followers(const Problem& problem, const Grid& grid, const Stencil& stencil) {
  constexpr double bytes_per_tie = 80.0;  // Kept: an entry, a gain, a sign. While they are made: what stands for each.
  double bytes = 0.0;
  for (const BoundaryOptions& boundary : problem.boundaries) {
    if (!boundary.face || !ties_points(boundary.condition)) continue;
    const double points = static_cast<double>(grid.size()) / grid.count(axis_of(*boundary.face));
    bytes += points * 0.5 * static_cast<double>(stencil.entries.size()) * bytes_per_tie;
  }
  return bytes;
}

/// Known before anything is allocated: corrected bonds are not, but they lie near surfaces and cracks only.
double memory_estimate(const Problem& problem, const Stencil& stencil, BackendName backend, int threads) {
  const Grid grid = make_grid(problem);
  double bytes = memory_of_run(problem, stencil) + backend_bytes(problem, backend, stencil.radius, threads) +
                 bytes_of_followers(problem, grid, stencil);
  // The field of heating rates, and its derivatives in time.
  bool heats = false, changes = false;
  for (const HeatSource& source : problem.sources) {
    heats = true;
    changes = changes || CompiledProfile(source.value).depends_on_time();
  }
  bytes += (heats ? 8.0 : 0.0) * static_cast<double>(grid.size());
  bytes += (changes ? 8.0 * (propagator_load_degree + 1) : 0.0) * static_cast<double>(grid.size());
  if (backend == BackendName::bond) bytes += bytes_of_bonds(grid, stencil.entries.size());
  return bytes;
}

/// Threads that the run uses; also tells OpenMP.
int set_threads(const Problem& problem, const Stencil& stencil) {
  int threads = problem.numerics.threads;
  if (threads == 0) {
    const double work = expect_backend(problem, stencil, 1).evaluation_seconds;
    threads = std::clamp(static_cast<int>(work / least_work_per_thread), 1, omp_get_num_procs());
  }
  omp_set_num_threads(threads);
  return threads;
}

}  // namespace

void refuse_if_too_large(double bytes, std::size_t points) {
  const auto available = static_cast<double>(available_memory());
  if (available == 0.0 || bytes <= available) return;
  throw Error("the run needs about " + readable(bytes) + " of memory for " + std::to_string(points) + " points, and " +
                  readable(available) + " are available",
              "Choose fewer cells, or run it on a machine with more memory", Fault::machine);
}

Prepared prepare(const Problem& given) {
  const Problem problem = resolved(given);
  const Grid grid = make_grid(problem);
  const Stencil stencil = make_stencil(stencil_options_of(problem), grid.spacing, grid.dimension);
  // Whatever the backend, and before the choice makes anything as large as the grid.
  refuse_if_too_large(memory_of_run(problem, stencil), grid.size());
  Prepared prepared{problem, {}, set_threads(problem, stencil), 0.0, 0.0};
  const double evaluations = evaluations_for(problem, problem.time.integrator,
                                             expected_fastest_rate(problem, grid, stencil), grid.spacing, grid.size());
  prepared.choice = choose_backend(problem, stencil, prepared.threads, evaluations);
  prepared.problem.numerics.backend = prepared.choice.backend;
  prepared.bytes = memory_estimate(prepared.problem, stencil, prepared.choice.backend, prepared.threads);
  prepared.duration = evaluations * prepared.choice.evaluation_seconds;
  refuse_if_too_large(prepared.bytes, grid.size());
  return prepared;
}

/// "(0.1, 0.2) m"
std::string at_place(const Point& place, int dimension) {
  std::string text = "(" + fmt::format("{:.6g}", place[0]);
  for (int axis = 1; axis < dimension; ++axis) text += fmt::format(", {:.6g}", place[axis]);
  return text + ") m";
}

/// Has a crack corners nearer to each other than a spacing, and not on one straight line?
bool winds_within_spacings(const CrackSurface& crack, const Grid& grid) {
  if (grid.dimension != 2 || !crack.mirrors()) return false;
  const std::vector<Point> corners = simplified(crack.corners(HUGE_VAL), straight_within * grid.spacing);
  for (std::size_t k = 0; corners.size() > 2 && k + 1 < corners.size(); ++k) {
    if (length(difference(corners[k + 1], corners[k])) < grid.spacing) return true;
  }
  return false;
}

/// Faces that could not be mirrored are never passed over.
void describe_faces(const Problem& problem, const Body& body, Plan& plan) {
  for (std::size_t c = 0; c < problem.cracks.size(); ++c) {
    if (winds_within_spacings(body.cracks[c], body.grid)) {
      plan.warnings.push_back("crack." + std::to_string(c) +
                              " has corners nearer to each other than a spacing: the grid cannot follow its way there, "
                              "and mirrored bonds are less accurate. Choose more cells, or fewer corners");
    }
    if (problem.cracks[c].faces != Faces::mirror || !body.cracks[c].is_too_short_to_mirror()) continue;
    plan.warnings.push_back(
        "crack." + std::to_string(c) +
        " is shorter than a spacing, and its bonds are only cut: the grid does not know which way it "
        "goes. Choose more cells, or faces = \"cut\"");
  }
  const MirroredFaces& faces = body.faces;
  if (faces.empty()) return;
  plan.faces = FacesPlan{faces.points().size(), faces.lowest_share(), faces.highest_share()};
  if (faces.cut_points().empty()) return;
  const Point place = body.grid.position(body.grid.index(static_cast<std::size_t>(faces.cut_points().front())));
  plan.warnings.push_back("beside cracks " + std::to_string(faces.cut_points().size()) +
                          (faces.cut_points().size() == 1 ? " point keeps" : " points keep") +
                          " bonds that are only cut, the first at " + at_place(place, body.grid.dimension) +
                          ": other cracks, materials or open faces are too near for mirrored ones, or a gap lets "
                          "pass more than the spacing resolves. Choose a smaller horizon with more cells, or faces = "
                          "\"cut\"");
}

Plan make_plan(const Prepared& prepared, const Assembly& assembly, const ChosenStepping& chosen) {
  const Problem& problem = prepared.problem;
  const Geometry& geometry = assembly.geometry;
  const Body& body = geometry.body;
  Plan plan;
  plan.dimension = body.grid.dimension;
  plan.spacing = body.grid.spacing;
  plan.horizon = geometry.stencil_options.horizon;
  plan.points = body.grid.size();
  if (body.has_voids()) {
    plan.points -= static_cast<std::size_t>(std::count(body.material_of.begin(), body.material_of.end(), no_material));
  }
  plan.bonds = count_bonds(body, geometry.stencil);
  const CutBonds* const known = assembly.system->conduction().cut_bonds();
  plan.cut_bonds = known != nullptr ? known->count_before(problem.time.end)
                                    : find_cut_bonds(body, geometry.stencil).count_before(problem.time.end);
  describe_faces(problem, body, plan);
  plan.backend = name_of(assembly.backend);
  plan.backend_reason = prepared.choice.reason;
  plan.precision = name_of(problem.numerics.precision);
  plan.integrator = std::visit([](const auto& options) { return std::string(options.name); }, chosen.stepping);
  plan.integrator_reason = chosen.reason;
  const bool rows = assembly.backend == BackendName::bond;
  plan.memory_bytes =
      static_cast<std::size_t>(rows ? memory_estimate(problem, geometry.stencil, assembly.backend, prepared.threads) +
                                          bytes_per_broken_bond * static_cast<double>(body.broken.size())
                                    : memory_of_run(problem, geometry.stencil) +
                                          static_cast<double>(assembly.system->bytes())) +
      body.broken.bytes();
  estimate_steps(problem, chosen.stepping, assembly, plan);
  plan.duration = plan.evaluations * prepared.choice.evaluation_seconds;
  return plan;
}

}  // namespace peritherm
