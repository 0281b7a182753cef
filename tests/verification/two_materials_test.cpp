#include <gtest/gtest.h>

#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double contrast = 100.0;

/// Conductivity 100 at x < interface, 1 beyond; held at 0 at x = 0 and 1 at x = 1.
Problem two_materials(int dimension, int cells, double interface) {
  Problem problem = unit_body(dimension, cells, 2.5);
  problem.materials["good"] = {contrast, 2.0, 3.0};
  Coordinates corner(static_cast<std::size_t>(dimension), 1.0);
  corner[0] = interface;
  problem.body.regions = {{"good", Box{Coordinates(corner.size(), 0.0), corner}}};
  set_face(problem, Face::x_min, held_at(0.0));
  set_face(problem, Face::x_max, held_at(1.0));
  return problem;
}

double series_flux(double interface) { return 1.0 / (interface / contrast + (1.0 - interface)); }

double steady_profile(double interface, double x) {
  return series_flux(interface) * (x < interface ? x / contrast : interface / contrast + x - interface);
}

/// Steady state from the exact profile on; slow modes decay with about π² times the poorer diffusivity.
double steady_flux(Problem problem) {
  problem.time.integrator = RungeKuttaLegendre{1e-8};
  March run(std::move(problem));
  run.advance_to(8.0);
  return run.heat_rates()[1];
}

TEST(TwoMaterials, in_series_keep_their_exact_steady_state_wherever_the_interface_lies) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : {PointPlacement::centres, PointPlacement::boundary}) {
      for (const double interface : {0.5, 0.4375, 0.53}) {
        Problem problem = two_materials(dimension, 8, interface);
        problem.body.points = points;
        March run(problem);
        std::vector<double> state(run.assembly().system->size(), 0.0);
        for (std::size_t n = 0; n < run.grid().size(); ++n) {
          state[run.assembly().layout.entry(run.grid().index(n))] = steady_profile(interface, run.position(n)[0]);
        }
        std::vector<double> rates(state.size(), 0.0);
        run.assembly().system->combine(0.0, state, 1.0, {}, rates);
        // Resistances along a bond add up, so every bond carries its share of the exact flux, to rounding.
        const double tolerance = rounding(100, run.assembly().system->fastest_rate());
        for (std::size_t n = 0; n < run.grid().size(); ++n) {
          ASSERT_NEAR(rates[run.assembly().layout.entry(run.grid().index(n))], 0.0, tolerance) << interface;
        }
        const std::vector<double> heat = run.assembly().system->account_rates(0.0, state);
        EXPECT_NEAR(heat[1], series_flux(interface), tolerance) << dimension << ", " << interface;
        EXPECT_NEAR(heat[0], -series_flux(interface), tolerance) << dimension << ", " << interface;
      }
    }
  }
}

TEST(TwoMaterials, in_series_find_their_steady_state_from_elsewhere) {
  // exp(-8 π²) of the start is left, and what the integrator's tolerance lets through.
  EXPECT_NEAR(steady_flux(two_materials(1, 16, 0.5)), series_flux(0.5), 1e-5);
}

TEST(TwoMaterials, bonds_by_their_ends_only_reach_the_series_flux_with_first_order) {
  for (const InterfaceRule rule : {InterfaceRule::harmonic, InterfaceRule::minimum}) {
    std::vector<double> spacings;
    std::vector<double> errors;
    for (const int cells : {20, 40, 80}) {
      Problem problem = two_materials(1, cells, 0.5);
      problem.nonlocality.interface = rule;
      spacings.push_back(1.0 / cells);
      errors.push_back(std::abs(steady_flux(problem) - series_flux(0.5)));
    }
    EXPECT_NEAR(order_of_convergence(spacings, errors), 1.0, 0.1) << name_of(rule);
  }
}

TEST(TwoMaterials, keep_the_heat_of_an_insulated_body) {
  for (const auto& [rule, name] : EnumNames<InterfaceRule>::values) {
    for (const int dimension : {1, 2, 3}) {
      Problem problem = two_materials(dimension, 8, 0.53);
      problem.boundaries.clear();
      problem.nonlocality.interface = rule;
      problem.initial.temperature = Profile("100*(x > 0.5)");
      March run(problem);
      const double before = run.stored_heat();
      run.advance_to(0.05);
      const std::size_t sums = run.assembly().geometry.stencil.entries.size() * run.count().evaluations;
      EXPECT_NEAR(run.stored_heat(), before, rounding(sums, before)) << name << ", " << dimension;
      EXPECT_GT(run.at(Coordinates(static_cast<std::size_t>(dimension), 0.2)), 1.0) << name;
    }
  }
}

}  // namespace
}  // namespace peritherm
