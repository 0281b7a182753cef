#include "peritherm/discretisation/broken_bonds.hpp"

#include <gtest/gtest.h>

#include "peritherm/discretisation/cut_schedule.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

Problem stretched(Problem problem, double critical_elongation, const std::vector<std::string>& displacement,
                  double every) {
  DamageOptions& damage = problem.damage.emplace();
  damage.critical_elongation = critical_elongation;
  damage.displacement.emplace();
  for (const std::string& component : displacement) damage.displacement->emplace_back(component);
  damage.every = every;
  return problem;
}

/// Calls visit(p, offset, time of breaking) for all bonds of all points, through mirrored faces too.
template <class Visit>
void for_bonds_of(const Geometry& geometry, Visit&& visit) {
  const Body& body = geometry.body;
  for (std::size_t n = 0; n < body.grid.size(); ++n) {
    const GridIndex p = body.grid.index(n);
    for (const auto& [offset, conductance] : geometry.stencil.entries) {
      const GridIndex q{p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]};
      visit(p, offset, body.broken.time_of(body.grid.position(p), body.grid.position(q)));
    }
  }
}

TEST(BrokenBonds, a_uniform_stretch_breaks_each_bond_when_its_direction_asks_for_it) {
  constexpr double critical = 0.01, rate = 0.03;
  for (const PointPlacement placement : placements) {
    Problem problem = unit_body(2, 12, 3.0);
    problem.body.points = placement;
    problem.body.origin = Coordinates{-0.3, 0.7};
    problem = stretched(problem, critical, {"0.03*t*x", "0"}, 0.3);
    const Geometry geometry = make_geometry(problem);
    std::size_t broken = 0;
    for_bonds_of(geometry, [&](const GridIndex&, const GridIndex& offset, const std::optional<double>& time) {
      const double square = offset[0] * offset[0] + offset[1] * offset[1];
      // (1 + rate t)² ξx² + ξy² = (1 + e₀)² |ξ|²
      const double growth = critical * (2.0 + critical) * square / (offset[0] * offset[0]);
      const double expected = (std::sqrt(1.0 + growth) - 1.0) / rate;
      // The last look comes at or after the end of the run, 1 s.
      const bool breaks = offset[0] != 0 && expected <= 1.2;
      ASSERT_EQ(time.has_value(), breaks) << offset[0] << ", " << offset[1];
      if (!breaks) return;
      ++broken;
      // Differences of displacements lose what coordinates of up to twelve spacings hold more than one.
      EXPECT_NEAR(*time, expected, rounding(4 * 12, 1.0));
    });
    EXPECT_GT(broken, 1000U);
  }
}

TEST(BrokenBonds, all_bonds_along_a_bar_break_when_its_stretch_is_critical) {
  const Geometry geometry = make_geometry(stretched(unit_body(1, 20, 3.0), 0.02, {"0.04*t*x"}, 1.0));
  for_bonds_of(geometry, [&](const GridIndex&, const GridIndex&, const std::optional<double>& time) {
    ASSERT_TRUE(time.has_value());
    EXPECT_NEAR(*time, 0.5, rounding(4 * 20, 0.5));
  });
}

TEST(BrokenBonds, bodies_that_move_and_turn_keep_their_bonds) {
  for (const PointPlacement placement : placements) {
    Problem problem = unit_body(2, 10, 3.0);
    problem.body.points = placement;
    problem = stretched(problem, 1e-6, {"x*cos(t) - y*sin(t) - x + 3*t", "x*sin(t) + y*cos(t) - y - t"}, 0.5);
    problem.time.end = 6.0;
    EXPECT_TRUE(make_geometry(problem).body.broken.empty());
  }
}

TEST(BrokenBonds, what_is_broken_stays_broken) {
  // Stretched to 0.1 at 0.5 s, back at 1 s, pressed together after that.
  const Geometry geometry = make_geometry(stretched(unit_body(1, 10, 2.0), 0.05, {"0.1*x*sin(pi*t)"}, 0.1));
  const CutBonds cuts = find_cut_bonds(geometry.body, geometry.stencil);
  EXPECT_EQ(cuts.count_before(0.1), 0U);
  EXPECT_EQ(cuts.count_before(0.5), count_bonds(geometry.body, geometry.stencil));
  EXPECT_EQ(cuts.count_before(1.0), cuts.count_before(0.5));
}

TEST(BrokenBonds, times_are_of_second_order_in_the_time_between_looks) {
  const double right = std::sqrt(0.05);  // the stretch is t²
  for (const double every : {0.1, 0.05, 0.025, 0.0125}) {
    const Geometry geometry = make_geometry(stretched(unit_body(1, 10, 2.0), 0.05, {"t*t*x"}, every));
    const auto times = geometry.body.broken.row(5).times;
    ASSERT_FALSE(times.empty());
    // A chord of t² lies above it by every²/4 at most, and the slope is above 2 (right − every).
    EXPECT_LE(times.front(), right);
    EXPECT_GE(times.front(), right - every * every / 4.0 / (2.0 * (right - every)));
  }
}

TEST(BrokenBonds, bonds_that_are_long_from_the_start_are_broken_from_the_start) {
  Problem problem = stretched(unit_body(1, 10, 2.0), 0.05, {"0.1*(x > 0.5)"}, 0.1);
  problem.damage->every.reset();
  const Geometry geometry = make_geometry(problem);
  const CutBonds cuts = find_cut_bonds(geometry.body, geometry.stencil);
  EXPECT_EQ(cuts.count_before(0.0), 3U) << "one bond to the next point, and two to the one after";
}

TEST(BrokenBonds, damage_is_the_share_of_broken_bonds) {
  Problem problem = stretched(unit_body(1, 10, 2.0), 0.05, {"0.1*t*(x > 0.5)"}, 0.5);
  const Geometry geometry = make_geometry(problem);
  const CutBonds cuts = find_cut_bonds(geometry.body, geometry.stencil);
  // Bonds to the next point and to the one after break at 0.05 and 0.1 s, when the gap is half a spacing's tenth wide.
  const auto at = [&](double time) { return damage(geometry.body, geometry.stencil, cuts, time); };
  EXPECT_EQ(at(0.049), std::vector<double>(10, 0.0));
  EXPECT_EQ(at(0.051), (std::vector<double>{0, 0, 0, 0, 0.25, 0.25, 0, 0, 0, 0}));
  EXPECT_EQ(at(0.2), (std::vector<double>{0, 0, 0, 0.25, 0.5, 0.5, 0.25, 0, 0, 0}));
}

TEST(BrokenBonds, an_opening_displacement_cuts_what_a_crack_of_that_extent_cuts) {
  // Nearest neighbours only: elsewhere bonds turn, and become longer by the square of the opening only.
  Problem torn = unit_body(2, 20, 1.2);
  torn.nonlocality.partial_volumes = PartialVolumes::whole;
  Problem cracked = torn;
  torn = stretched(torn, 0.1, {"0", "0.01*(y > 0.5)*(abs(x - 0.5) < 0.3)"}, 1.0);
  cracked.cracks.emplace_back().points = {{0.2, 0.5}, {0.8, 0.5}};
  const Geometry first = make_geometry(torn), second = make_geometry(cracked);
  const CutBonds broken = find_cut_bonds(first.body, first.stencil), cut = find_cut_bonds(second.body, second.stencil);
  EXPECT_EQ(broken.size(), 12U);
  EXPECT_EQ(damage(first.body, first.stencil, broken, 0.0), damage(second.body, second.stencil, cut, 0.0));
}

TEST(BrokenBonds, one_gap_does_not_count_twice) {
  RemainingShare share;
  share.pass({0.0, 0.5, false});
  EXPECT_EQ(share.value(), 0.5);
  share.pass({1.0, 0.3, true, true});
  EXPECT_EQ(share.value(), 0.3);
  share.pass({2.0, 0.5, true, false, 1});
  EXPECT_EQ(share.value(), 0.25);
}

TEST(BrokenBonds, conductances_fall_to_the_transmission_when_bonds_break) {
  Problem problem = stretched(unit_body(1, 10, 1.0), 0.05, {"0.1*t*x"}, 1.0);
  problem.damage->transmission = 0.25;
  problem.numerics.backend = BackendName::bond;
  Assembly assembly = assemble(problem);
  const auto conductance = [&] {
    double largest = 0.0;
    assembly.system->conduction().visit_bonds(assembly.layout.entry({4, 0, 0}),
                                              [&](std::size_t, double g) { largest = std::max(largest, g); });
    return largest;
  };
  assembly.system->begin_step(0.0, 0.5);
  const double whole = conductance();
  assembly.system->begin_step(0.4, 0.8);
  EXPECT_NEAR(conductance(), whole * (0.25 + 0.75 * 0.25), rounding(40, whole)) << "a quarter of the step, then α";
  assembly.system->begin_step(0.6, 0.8);
  EXPECT_NEAR(conductance(), 0.25 * whole, rounding(40, whole));
}

}  // namespace
}  // namespace peritherm
