#include "peritherm/discretisation/damage.hpp"

#include <gtest/gtest.h>

#include "peritherm/discretisation/row_intervals.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

Problem plate() { return unit_body(2, 30, 3.5); }

bool is_solid(const Body& body, const GridIndex& p) {
  return body.grid.contains(p) && body.material_of[body.grid.number(p)] != no_material;
}

/// Calls visit(p, q) for every bond of the body, from both of its ends.
template <class Visit>
void for_bonds(const Geometry& geometry, Visit&& visit) {
  const Body& body = geometry.body;
  for (std::size_t n = 0; n < body.grid.size(); ++n) {
    const GridIndex p = body.grid.index(n);
    for (const auto& [offset, conductance] : geometry.stencil.entries) {
      const GridIndex q{p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]};
      if (is_solid(body, p) && is_solid(body, q)) visit(p, q);
    }
  }
}

std::size_t cut_bonds_of_all(const Geometry& geometry) {
  std::size_t count = 0;
  const BondTracer tracer(geometry.body);
  BondPath path;
  for_bonds(geometry, [&](const GridIndex& p, const GridIndex& q) {
    tracer.trace(geometry.body.grid.position(p), 0, geometry.body.grid.position(q), 0, path);
    count += path.crossings.empty() ? 0 : 1;
  });
  return count / 2;
}

TEST(Damage, walking_along_cracks_misses_no_bond) {
  // Across a corner, along a row of points, far out of the body, and bent.
  const std::vector<std::vector<Coordinates>> cracks{{{0.1, 0.02}, {0.02, 0.2}},
                                                     {{0.2, 0.5}, {0.7, 0.5}},
                                                     {{-50.0, -35.0}, {51.0, 36.5}},
                                                     {{0.3, 0.3}, {0.5, 0.7}, {0.9, 0.61}}};
  for (const auto& points : cracks) {
    Problem problem = plate();
    problem.cracks.emplace_back().points = points;
    const Geometry geometry = make_geometry(problem);
    EXPECT_EQ(find_cut_bonds(geometry.body, geometry.stencil).size(), cut_bonds_of_all(geometry));
  }
}

TEST(Damage, walking_along_plane_cracks_misses_no_bond) {
  Problem problem = unit_body(3, 12, 2.2);
  problem.cracks.emplace_back().disc = Disc{{0.5, 0.4, 0.6}, {0.2, 0.5, 0.7}, 0.3};
  problem.cracks.emplace_back().points = {{-3.0, -4.0, 0.2}, {5.0, -4.0, 0.4}, {5.0, 6.0, 0.9}, {-3.0, 6.0, 0.7}};
  const Geometry geometry = make_geometry(problem);
  EXPECT_EQ(find_cut_bonds(geometry.body, geometry.stencil).size(), cut_bonds_of_all(geometry));
}

TEST(Damage, bonds_around_holes_are_counted) {
  Problem problem = plate();
  problem.body.regions.push_back({"void", Ball{{0.4, 0.45}, 0.21}});
  problem.body.regions.push_back({"void", Box{{0.7, 0.1}, {0.8, 0.9}}});
  const Geometry geometry = make_geometry(problem);
  std::size_t directed = 0;
  for_bonds(geometry, [&](const GridIndex&, const GridIndex&) { ++directed; });
  EXPECT_EQ(count_bonds(geometry.body, geometry.stencil), directed / 2);
}

TEST(Damage, it_grows_with_the_crack) {
  Problem problem = plate();
  problem.cracks.emplace_back().points = {{0.1, 0.5}, {0.9, 0.5}};
  problem.cracks.back().tip_speed = 1.0;
  const Geometry geometry = make_geometry(problem);
  const CutBonds cuts = find_cut_bonds(geometry.body, geometry.stencil);
  EXPECT_EQ(cuts.count_before(0.0), 0U);
  EXPECT_LT(cuts.count_before(0.4), cuts.size());
  EXPECT_EQ(cuts.count_before(0.9), cuts.size());
  const auto at = [&](double time, double x) {
    const Grid& grid = geometry.body.grid;
    const GridIndex p{static_cast<int>(x * grid.count(0)), grid.count(1) / 2, 0};
    return damage(geometry.body, geometry.stencil, cuts, time)[grid.number(p)];
  };
  EXPECT_EQ(at(0.4, 0.8), 0.0);
  EXPECT_GT(at(0.4, 0.3), 0.3);
  EXPECT_GT(at(0.9, 0.8), 0.3);
}

TEST(RowIntervals, overlapping_ones_are_joined_in_order) {
  std::vector<RowInterval> intervals{{2, 5, 9}, {0, 4, 6}, {2, 1, 5}, {0, 0, 3}, {2, 2, 4}};
  merge(intervals);
  EXPECT_EQ(intervals, (std::vector<RowInterval>{{0, 0, 3}, {0, 4, 6}, {2, 1, 9}}));
}

}  // namespace
}  // namespace peritherm
