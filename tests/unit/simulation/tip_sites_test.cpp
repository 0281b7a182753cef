#include "peritherm/simulation/tip_sites.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

/// The unit square with 40 × 40 points and a horizon of 0.1; four of them reach across 0.4.
Problem square_with(const std::vector<std::vector<Coordinates>>& cracks) {
  Problem problem = unit_body(2, 40, 4.0);
  for (const auto& points : cracks) problem.cracks.emplace_back().points = points;
  return problem;
}

std::vector<TipSite> sites_of(const Problem& problem, double time = 0.0) {
  check(problem);
  return tip_sites(make_geometry(problem), time);
}

using Ends = std::vector<std::pair<int, int>>;

Ends ends_of(const std::vector<TipSite>& sites) {
  Ends ends;
  for (const TipSite& site : sites) ends.emplace_back(site.crack, site.end);
  return ends;
}

TEST(TipSites, are_the_ends_of_cracks_inside_the_body) {
  const std::vector<TipSite> sites = sites_of(square_with({{{0.4, 0.5}, {0.6, 0.5}}}));
  ASSERT_EQ(ends_of(sites), (Ends{{0, 0}, {0, 1}}));
  EXPECT_EQ(sites[0].position, (Point{0.4, 0.5, 0.0}));
  EXPECT_EQ(sites[1].direction, (Point{1.0, 0.0, 0.0}));
  EXPECT_EQ(sites[1].conductivity, 1.0);
  EXPECT_NEAR(sites[1].horizon, 0.1, rounding(2, 0.1));
  // Points on the crack are above it.
  EXPECT_EQ(sites[0].angle_on_crack, -std::numbers::pi);
  EXPECT_EQ(sites[1].angle_on_crack, std::numbers::pi);
}

TEST(TipSites, ends_on_faces_outside_or_in_holes_are_none) {
  Problem problem = square_with({{{0.0, 0.5}, {0.3, 0.5}}, {{0.5, 0.8}, {0.5, 1.2}}, {{0.6, 0.2}, {0.85, 0.2}}});
  problem.body.regions.push_back({"void", Ball{{0.85, 0.2}, 0.1}});
  EXPECT_EQ(ends_of(sites_of(problem)), (Ends{{0, 1}, {1, 0}, {2, 0}}));
}

TEST(TipSites, ends_on_cracks_are_none) {
  // One ends on the first, two have an end in common, and one ends on itself.
  const Problem problem = square_with({{{0.1, 0.5}, {0.9, 0.5}},
                                       {{0.5, 0.5}, {0.5, 0.7}},
                                       {{0.2, 0.2}, {0.3, 0.2}},
                                       {{0.3, 0.2}, {0.4, 0.1}},
                                       {{0.6, 0.2}, {0.8, 0.2}, {0.8, 0.4}, {0.7, 0.4}, {0.7, 0.2}}});
  EXPECT_EQ(ends_of(sites_of(problem)), (Ends{{0, 0}, {0, 1}, {1, 1}, {2, 0}, {3, 1}, {4, 0}}));
}

TEST(TipSites, closed_cracks_have_none) {
  EXPECT_TRUE(sites_of(square_with({{{0.3, 0.3}, {0.7, 0.3}, {0.5, 0.6}, {0.3, 0.3}}})).empty());
}

TEST(TipSites, move_with_a_growing_crack) {
  Problem problem = square_with({{{0.0, 0.5}, {0.8, 0.5}}});
  problem.cracks[0].tip_speed = 0.5;
  problem.cracks[0].start_time = 0.2;
  EXPECT_TRUE(sites_of(problem, 0.2).empty());
  const std::vector<TipSite> sites = sites_of(problem, 0.8);
  ASSERT_EQ(ends_of(sites), (Ends{{0, 1}}));
  EXPECT_NEAR(sites[0].position[0], 0.3, rounding(4, 1.0));
  EXPECT_EQ(sites[0].growth, 0.5);
  EXPECT_EQ(sites_of(problem, 5.0).at(0).growth, 0.0);
}

TEST(TipSites, of_cracks_that_outrun_heat_see_less) {
  Problem problem = square_with({{{0.0, 0.5}, {0.8, 0.5}}});
  problem.cracks[0].tip_speed = 10.0;
  const TipSite site = sites_of(problem, 0.05).at(0);
  EXPECT_NEAR(site.clear_radius, 0.2, rounding(2, 1.0));
  EXPECT_EQ(site.limit, "where heat lags behind the growing tip, 200 mm away");
}

struct Neighbourhood {
  Problem problem;
  double clear_radius;
  std::string limit;
};

std::vector<Neighbourhood> neighbourhoods() {
  const std::vector<Coordinates> edge{{0.0, 0.5}, {0.5, 0.5}};
  Problem layered = square_with({edge}), held = square_with({edge});
  layered.materials["other"] = {2.0, 1.0, 1.0};
  layered.body.regions.push_back({"other", Box{{0.8, 0.0}, {1.0, 1.0}}});
  held.boundaries.push_back({std::nullopt, Box{{0.8, 0.0}, {1.0, 1.0}}, held_at(1.0)});
  return {
      {square_with({edge}), 0.4, ""},
      {square_with({{{0.0, 0.5}, {0.8, 0.5}}}), 0.2, "a face of the body, 200 mm away"},
      {square_with({{{0.2, 0.5}, {0.5, 0.5}}}), 0.2, "the other end of the crack, 300 mm away"},
      {square_with({edge, {{0.7, 0.4}, {0.7, 0.6}}}), 0.1, "another crack, 200 mm away"},
      {square_with({{{0.0, 0.2}, {0.2, 0.5}, {0.5, 0.5}}}), 0.2, "a corner of the crack, 300 mm away"},
      // A corner that is none.
      {square_with({{{0.0, 0.5}, {0.3, 0.5}, {0.5, 0.5}}}), 0.4, ""},
      // The nearest points stand at (0.8125, 0.4875) and (0.8125, 0.5125).
      {layered, std::hypot(0.3125, 0.0125) - 0.025, "another material, 312.7499 mm away"},
      {held, std::hypot(0.3125, 0.0125), "held points, 312.7499 mm away"},
  };
}

TEST(TipSites, know_how_far_nothing_else_disturbs) {
  for (const Neighbourhood& around : neighbourhoods()) {
    const std::vector<TipSite> sites = sites_of(around.problem);
    const auto last = std::find_if(sites.rbegin(), sites.rend(), [](const TipSite& site) { return site.crack == 0; });
    ASSERT_NE(last, sites.rend());
    const TipSite& site = *last;
    EXPECT_NEAR(site.clear_radius, around.clear_radius, rounding(8, 1.0)) << around.limit;
    EXPECT_EQ(site.limit, around.limit);
    EXPECT_EQ(site.fault, "");
  }
}

TEST(TipSites, of_conducting_cracks_say_so) {
  Problem problem = square_with({{{0.0, 0.5}, {0.5, 0.5}}});
  problem.cracks[0].transmission = 0.2;
  EXPECT_EQ(sites_of(problem).at(0).fault, "the faces of the crack conduct");
}

}  // namespace
}  // namespace peritherm
