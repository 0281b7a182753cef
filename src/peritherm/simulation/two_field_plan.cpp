#include "peritherm/simulation/two_field_plan.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/plan.hpp"

namespace peritherm {
namespace {

/// Threads of fewer points wait for one another longer than they work.
constexpr std::size_t least_points_per_thread = 20'000;

/// Bytes per point, measured: operators, matrix and factor or vectors of the iteration.
double bytes_per_point(int dimension) { return dimension == 1 ? 2e3 : (dimension == 2 ? 5e3 : 15e3); }

std::size_t flux_unknowns_of(const TwoFieldSystem& system) {
  std::size_t unknowns = 0;
  for (std::size_t p = 0; p < system.parts().size(); ++p) {
    if (system.laws()[p].relaxation_time == 0.0) continue;
    unknowns += system.parts()[p].size() * static_cast<std::size_t>(system.dimension());
  }
  return unknowns;
}

}  // namespace

Problem prepare_two_field(const Problem& given) {
  Problem problem = resolved(given);
  if (std::holds_alternative<AutomaticStepping>(problem.time.integrator)) {
    GeneralisedSingleStep stepping;
    const auto& automatic = std::get<AutomaticStepping>(problem.time.integrator);
    if (automatic.relative_tolerance) stepping.relative_tolerance = *automatic.relative_tolerance;
    problem.time.integrator = stepping;
  }
  const Grid grid = make_grid(problem);
  refuse_if_too_large(bytes_per_point(grid.dimension) * static_cast<double>(grid.size()), grid.size());
  const int worth = static_cast<int>(std::min<std::size_t>(grid.size() / least_points_per_thread, 1024));
  const int most = std::clamp(worth, 1, omp_get_num_procs());
  omp_set_num_threads(problem.numerics.threads > 0 ? problem.numerics.threads : most);
  return problem;
}

Plan make_two_field_plan(const Problem& problem, const TwoFieldAssembly& assembly, const Grid& raster) {
  const TwoFieldSystem& system = *assembly.system;
  Plan plan;
  plan.dimension = system.dimension();
  plan.points = system.size();
  plan.spacing = make_grid(problem).spacing;
  plan.horizon = horizon_of(problem);
  plan.backend = "two_field";
  plan.precision = name_of(problem.numerics.precision);
  plan.integrator = std::visit([](const auto& chosen) { return std::string(chosen.name); }, problem.time.integrator);
  if (const auto* gs4 = std::get_if<GeneralisedSingleStep>(&problem.time.integrator); gs4 != nullptr && gs4->step) {
    plan.step = *gs4->step;
    plan.evaluations = std::ceil(problem.time.end / plan.step);
  }
  plan.memory_bytes = static_cast<std::size_t>(bytes_per_point(plan.dimension) * static_cast<double>(plan.points) +
                                               40.0 * static_cast<double>(raster.size()));
  plan.two_field = TwoFieldPlan{assembly.body.parts.size(), assembly.interfaces.size(), system.multipliers(),
                                flux_unknowns_of(system),   system.index(0.0),          ""};
  return plan;
}

}  // namespace peritherm
