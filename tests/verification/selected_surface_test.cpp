#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "peritherm/base/error.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

BoundaryOptions unit_flux_on(const Shape& where) { return {std::nullopt, where, PrescribedFlux{1.0}}; }

TEST(SelectedSurface, a_layer_of_any_thickness_takes_up_the_heat_of_its_face) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : placements) {
      for (const Calibration calibration : {Calibration::discrete, Calibration::continuum}) {
        for (const double thickness : {0.13, 0.5}) {
          Problem problem = unit_body(dimension, 8, 2.5);
          problem.body.points = points;
          problem.nonlocality.calibration = calibration;
          // Other faces have boundaries of their own, so only this one is open.
          for (int face = 1; face < 2 * dimension; ++face) set_face(problem, static_cast<Face>(face), Insulated{});
          Coordinates from(static_cast<std::size_t>(dimension), 0.0), to(from.size(), 1.0);
          to[0] = thickness;
          problem.boundaries.push_back(unit_flux_on(Box{from, to}));
          March run(problem);
          EXPECT_NEAR(run.heat_rates().back(), 1.0, rounding(512, 1.0)) << dimension << ' ' << thickness;
        }
      }
    }
  }
}

/// Heat rate through the rim of a hole of radius 0.3 over its circumference.
double share_through_hole(int cells) {
  Problem problem = unit_body(2, cells, 3.0);
  const Coordinates centre{0.5, 0.5};
  problem.body.regions.push_back({"void", Ball{centre, 0.3}});
  problem.boundaries.push_back(unit_flux_on(Ball{centre, 0.4}));
  March run(problem);
  return run.heat_rates().back() / (2.0 * std::numbers::pi * 0.3);
}

TEST(SelectedSurface, a_staircase_has_the_area_of_the_circle_that_it_stands_for) {
  // The surface lies within half a spacing of the staircase, so the radius is off by at most that.
  for (const int cells : {40, 80, 160}) EXPECT_NEAR(share_through_hole(cells), 1.0, 0.5 / (0.3 * cells)) << cells;
}

TEST(SelectedSurface, a_selection_without_a_surface_is_refused) {
  Problem problem = unit_body(2, 20, 3.0);
  problem.boundaries.push_back(unit_flux_on(Box{{0.4, 0.4}, {0.6, 0.6}}));
  EXPECT_THROW(assemble(problem), Error);
}

TEST(SelectedSurface, a_layer_too_thin_to_hold_a_point_is_refused) {
  Problem problem = unit_body(1, 20, 3.0);
  HeldTemperature held = held_at(40.0, Imposed::inner);
  held.thickness = 1e-9;
  set_face(problem, Face::x_max, held);
  EXPECT_THROW(assemble(problem), Error);
  problem.body.points = PointPlacement::boundary;
  EXPECT_NO_THROW(assemble(problem));
}

}  // namespace
}  // namespace peritherm
