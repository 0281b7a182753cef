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

/// Peaks of runs at a horizon of three spacings, fitted: 1-D 1e5 points, 2-D 1e4 to 1e6, 3-D 8e3 to 6.4e4. Rows of
/// points below a surface differ from place to place, those of others are kept once, but for their correction in 3-D.
constexpr double bytes_per_point[] = {0.0, 500.0, 470.0, 9.2e3};
constexpr double bytes_per_surface_place[] = {0.0, 0.0, 23e3, 37e3};
constexpr double measured_ratio = 3.0;  ///< bonds grow with a power of the ratio, layers below surfaces with one more
constexpr double bytes_of_everything_else = 17e6;
/// Solvers for several lengths of a step take that much more.
constexpr double factor_without_step = 1.8;

double two_field_bytes(const Problem& problem, double points, double surface_places) {
  const Grid grid = make_grid(problem);
  const double ratio = horizon_of(problem) / grid.spacing / measured_ratio;
  const double bonds = std::pow(ratio, grid.dimension);
  const auto* gs4 = std::get_if<GeneralisedSingleStep>(&problem.time.integrator);
  const double factor = gs4 != nullptr && gs4->step ? 1.0 : factor_without_step;
  return bytes_of_everything_else + factor * bonds *
                                        (bytes_per_point[grid.dimension] * points +
                                         bytes_per_surface_place[grid.dimension] * ratio * surface_places);
}

/// Of the grid, and of regions with a spacing of their own that are boxes or, of rings, balls.
double expected_points(const Problem& problem) {
  const Grid grid = make_grid(problem);
  auto points = static_cast<double>(grid.size());
  for (const BodyRegion& region : problem.body.regions) {
    const double spacing = region.spacing.value_or(grid.spacing);
    const auto* box = std::get_if<Box>(&region.shape);
    const auto* ball = std::get_if<Ball>(&region.shape);
    if (spacing == grid.spacing || (box == nullptr && ball == nullptr)) continue;
    double cells = 1.0;
    for (int axis = 0; axis < grid.dimension; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double length = box != nullptr ? std::min(box->to[a], grid.origin[a] + grid.length(axis)) -
                                                 std::max(box->from[a], grid.origin[a])
                                           : 2.0 * ball->radius;
      cells *= std::max(0.0, length) / spacing;
    }
    points += cells;
  }
  return points;
}

std::size_t flux_unknowns_of(const TwoFieldSystem& system) {
  std::size_t unknowns = 0;
  for (std::size_t p = 0; p < system.parts().size(); ++p) {
    if (system.laws()[p].relaxation_time == 0.0) continue;
    unknowns += system.parts()[p].size() * static_cast<std::size_t>(system.dimension());
  }
  return unknowns;
}

}  // namespace

void refuse_if_two_fields_are_too_large(const Problem& problem) {
  const Grid grid = make_grid(problem);
  const double points = expected_points(problem);
  double surface = 0.0;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    surface += 2.0 * static_cast<double>(grid.size()) / grid.cells[static_cast<std::size_t>(axis)];
  }
  refuse_if_too_large(two_field_bytes(problem, points, surface), static_cast<std::size_t>(std::min(points, 1e18)));
}

Problem prepare_two_field(const Problem& given) {
  Problem problem = resolved(given);
  if (std::holds_alternative<AutomaticStepping>(problem.time.integrator)) {
    GeneralisedSingleStep stepping;
    const auto& automatic = std::get<AutomaticStepping>(problem.time.integrator);
    if (automatic.relative_tolerance) stepping.relative_tolerance = *automatic.relative_tolerance;
    problem.time.integrator = stepping;
  }
  const Grid grid = make_grid(problem);
  refuse_if_two_fields_are_too_large(problem);
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
  const auto surface = static_cast<double>(assembly.body.surface.size());
  plan.memory_bytes = static_cast<std::size_t>(two_field_bytes(problem, static_cast<double>(plan.points), surface) +
                                               40.0 * static_cast<double>(raster.size()));
  plan.two_field = TwoFieldPlan{assembly.body.parts.size(), assembly.interfaces.size(), system.multipliers(),
                                flux_unknowns_of(system), system.index(0.0)};
  return plan;
}

}  // namespace peritherm
