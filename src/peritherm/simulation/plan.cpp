#include "peritherm/simulation/plan.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "peritherm/base/error.hpp"
#include "peritherm/discretisation/damage.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/memory.hpp"
#include "peritherm/simulation/schedule.hpp"
#include "peritherm/simulation/simulate.hpp"

namespace peritherm {
namespace {

/// Rough costs of one evaluation on one core of a present-day machine [s].
constexpr double stencil_seconds_per_bond = 0.08e-9;
constexpr double stencil_seconds_per_point = 4e-9;
constexpr double list_seconds_per_bond = 1.3e-9;
/// Below this, waiting for one another costs threads more than they gain, above all on a busy machine.
constexpr double least_work_per_thread = 150e-6;

StencilOptions stencil_options(const Problem& problem) {
  return {problem.nonlocality.kernel, horizon_of(problem), problem.nonlocality.partial_volumes,
          problem.nonlocality.calibration};
}

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

double bytes_of_fields(const Grid& grid, int radius, int states) {
  double padded = 1.0;
  for (int axis = 0; axis < grid.dimension; ++axis) padded *= grid.count(axis) + 2.0 * radius;
  // Materials, holders and special flags take 4 B a point; output gathers temperature and flux, 32 B; the energy
  // balance needs a field for a moment.
  return padded * 8.0 * states + static_cast<double>(grid.size()) * 44.0;
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

void refuse_if_too_large(double bytes, const Grid& grid) {
  const auto available = static_cast<double>(available_memory());
  if (available == 0.0 || bytes <= available) return;
  throw Error("the run needs about " + readable(bytes) + " of memory for " + std::to_string(grid.size()) +
                  " points, and " + readable(available) + " are available",
              "Choose fewer cells, or run it on a machine with more memory", Fault::machine);
}

/// One evaluation on one thread.
double evaluation_seconds(const Problem& problem, const Stencil& stencil) {
  const auto points = static_cast<double>(make_grid(problem).size());
  const double bonds = points * static_cast<double>(stencil.entries.size());
  if (choose_backend(problem) == BackendName::bond) return bonds * list_seconds_per_bond;
  return bonds * stencil_seconds_per_bond + points * stencil_seconds_per_point;
}

void estimate_costs(const Problem& problem, const TimeStepping& stepping, HeatSystem& system, const Stencil& stencil,
                    int threads, Plan& plan) {
  const double fastest_rate = system.fastest_rate();
  plan.evaluations = estimate_evaluations(stepping, fastest_rate, march_times(problem), system.size());
  std::visit(
      [&](const auto& chosen) {
        plan.stable_step = chosen.stability / fastest_rate;
        if constexpr (requires { chosen.step; }) plan.step = chosen.step.value_or(chosen.safety * plan.stable_step);
      },
      stepping);
  if (const auto* stabilised = std::get_if<RungeKuttaLegendre>(&stepping)) {
    plan.evaluations += growth_evaluations(problem, plan.spacing, stabilised->relative_tolerance);
  }
  plan.duration = plan.evaluations * evaluation_seconds(problem, stencil) / threads;
}

double memory_estimate(const Problem& problem) {
  const Grid grid = make_grid(problem);
  const StencilOptions options = stencil_options(problem);
  const double ratio = options.horizon / grid.spacing;
  double bytes = bytes_of_fields(grid, static_cast<int>(std::ceil(ratio + 0.5)),
                                 std::visit([](const auto& chosen) { return chosen.states; }, problem.time.integrator));
  // Heated points carry their place and heat capacity, and a field holds their rates.
  if (!problem.sources.empty()) bytes += 64.0 * static_cast<double>(grid.size());
  if (choose_backend(problem) == BackendName::bond) {
    bytes += bytes_of_bonds(grid, make_stencil(options, grid.spacing, grid.dimension).entries.size());
  }
  return bytes;
}

}  // namespace

void refuse_if_too_large(const Problem& problem) { refuse_if_too_large(memory_estimate(problem), make_grid(problem)); }

int set_threads(const Problem& problem) {
  int threads = problem.numerics.threads;
  if (threads == 0) {
    const double work = evaluation_seconds(
        problem, make_stencil(stencil_options(problem), make_grid(problem).spacing, make_grid(problem).dimension));
    threads = std::clamp(static_cast<int>(work / least_work_per_thread), 1, omp_get_num_procs());
  }
  omp_set_num_threads(threads);
  return threads;
}

Plan make_plan(const Problem& problem, const Assembly& assembly, const ChosenStepping& chosen, int threads) {
  const Geometry& geometry = assembly.geometry;
  const Body& body = geometry.body;
  Plan plan;
  plan.dimension = body.grid.dimension;
  plan.spacing = body.grid.spacing;
  plan.horizon = geometry.stencil_options.horizon;
  plan.points = static_cast<std::size_t>(std::count_if(body.material_of.begin(), body.material_of.end(),
                                                       [](MaterialIndex m) { return m != no_material; }));
  plan.bonds = count_bonds(body, geometry.stencil);
  for (const CutBond& cut : find_cut_bonds(body, geometry.stencil)) {
    plan.cut_bonds += cut.time <= problem.time.end ? 1 : 0;
  }
  plan.backend = name_of(assembly.backend);
  plan.integrator = std::visit([](const auto& options) { return std::string(options.name); }, chosen.stepping);
  plan.integrator_reason = chosen.reason;
  plan.memory_bytes = static_cast<std::size_t>(memory_estimate(problem));
  if (assembly.backend == BackendName::stencil) plan.memory_bytes += assembly.system->bytes();
  estimate_costs(problem, chosen.stepping, *assembly.system, geometry.stencil, threads, plan);
  return plan;
}

Plan plan(const Problem& problem) {
  refuse_if_too_large(problem);
  const int threads = set_threads(problem);
  const Assembly assembly = assemble(problem);
  // Refuses a step beyond the stability limit, as the run would.
  const ChosenStepping chosen = choose_stepping(problem.time.integrator, *assembly.system, 0.0, march_times(problem));
  make_integrator(chosen.stepping, *assembly.system);
  return make_plan(problem, assembly, chosen, threads);
}

}  // namespace peritherm
