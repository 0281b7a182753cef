#include "support/cracked_square.hpp"

namespace peritherm {
namespace {

Problem plate() {
  Problem problem = cracked_square(60, 3e-6);
  add_crack(problem, {-0.5, -0.496}, {0.5, 0.504});
  add_crack(problem, {0.5, -0.496}, {-0.5, 0.504});
  for (Crack& crack : problem.cracks) crack.tip_speed = 0.002;
  return problem;
}

TEST(PublishedCrossingCracks, cut_the_published_number_of_bonds) { EXPECT_EQ(count_of_cut_bonds(plate()), 17079U); }

TEST(PublishedCrossingCracks, have_the_published_temperatures) {
  expect_published(plate(), Published("bobaru_2012_crossing_cracks"), 5e-3);
}

TEST(PublishedCrossingCracks, have_an_error_in_time_far_below_the_tolerance) {
  EXPECT_LT(error_in_time(plate(), Published("bobaru_2012_crossing_cracks")), 2.5e-3);
}

}  // namespace
}  // namespace peritherm
