#include "support/cracked_square.hpp"

namespace peritherm {
namespace {

/// Half-length 0.3 cm, 60 degrees, mirror images of each other.
Problem plate(int cells) {
  Problem problem = cracked_square(cells, 1e-6);
  const double low = -0.25480762113533156;
  const double high = 0.26480762113533157;
  add_crack(problem, {-0.655, low}, {-0.355, high});
  add_crack(problem, {0.655, low}, {0.355, high});
  return problem;
}

TEST(PublishedInclinedCracks, cut_the_published_number_of_bonds) {
  EXPECT_EQ(count_of_cut_bonds(plate(60)), 7458U);
  EXPECT_EQ(count_of_cut_bonds(plate(120)), 14990U);
}

TEST(PublishedInclinedCracks, have_the_published_temperatures) {
  const Published published("bobaru_2012_inclined_cracks");
  expect_published(plate(60), published, 2e-3);
  expect_published(plate(120), published, 2e-3);
}

TEST(PublishedInclinedCracks, have_an_error_in_time_far_below_the_tolerance) {
  EXPECT_LT(error_in_time(plate(60), Published("bobaru_2012_inclined_cracks")), 1e-3);
}

}  // namespace
}  // namespace peritherm
