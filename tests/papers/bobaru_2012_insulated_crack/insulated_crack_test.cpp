#include "support/cracked_square.hpp"

namespace peritherm {
namespace {

Problem slit_plate(int cells) {
  Problem problem = cracked_square(cells, 3e-7);
  add_crack(problem, {-0.500001, 1e-6}, {0.500001, 1e-6});
  return problem;
}

TEST(PublishedInsulatedCrack, cuts_the_published_number_of_bonds) {
  EXPECT_EQ(count_of_cut_bonds(slit_plate(60)), 6325U);
  EXPECT_EQ(count_of_cut_bonds(slit_plate(120)), 12595U);
}

TEST(PublishedInsulatedCrack, has_the_published_temperatures) {
  const Published published("bobaru_2012_insulated_crack");
  expect_published(slit_plate(60), published, 2e-3);
  expect_published(slit_plate(120), published, 2e-3);
}

TEST(PublishedInsulatedCrack, has_an_error_in_time_far_below_the_tolerance) {
  EXPECT_LT(error_in_time(slit_plate(60), Published("bobaru_2012_insulated_crack")), 1e-3);
}

}  // namespace
}  // namespace peritherm
