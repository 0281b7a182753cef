#include "peritherm/studies/intersection.hpp"

#include <gtest/gtest.h>

#include "peritherm/studies/run_study.hpp"
#include "support/study_folder.hpp"

namespace peritherm {
namespace {

TEST(CurveCrossing, is_the_smallest_positive_root_of_the_difference) {
  // (m − 3)(m − 7) above zero.
  const auto found = find_crossing({2.0, 4.0, 8.0}, {5.0, -3.0, 5.0}, {0.0, 0.0, 0.0});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->ratio, 3.0, 1e-14);
  EXPECT_NEAR(found->temperature, 0.0, 1e-13);
}

TEST(CurveCrossing, of_straight_lines_is_found_too) {
  const auto found = find_crossing({2.0, 4.0, 8.0}, {12.0, 14.0, 18.0}, {11.0, 14.0, 20.0});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->ratio, 4.0, 1e-13);
  EXPECT_NEAR(found->temperature, 14.0, 1e-13);
}

TEST(CurveCrossing, is_absent_where_curves_do_not_meet_or_are_the_same) {
  EXPECT_FALSE(find_crossing({2.0, 4.0, 8.0}, {1.0, 2.0, 4.0}, {2.0, 3.0, 5.0}).has_value());
  EXPECT_FALSE(find_crossing({2.0, 4.0, 8.0}, {1.0, 2.0, 4.0}, {1.0, 2.0, 4.0}).has_value());
  // The root of these lies at −1.
  EXPECT_FALSE(find_crossing({2.0, 4.0, 8.0}, {3.0, 5.0, 9.0}, {0.0, 0.0, 0.0}).has_value());
}

TEST(Parabola, continues_a_square_beyond_its_three_points) {
  // (m − 3)(m − 7)
  EXPECT_NEAR(parabola_at({2.0, 4.0, 8.0}, {5.0, -3.0, 5.0}, 2.0), 5.0, 1e-13);
  EXPECT_NEAR(parabola_at({2.0, 4.0, 8.0}, {5.0, -3.0, 5.0}, 5.0), -4.0, 1e-13);
  EXPECT_NEAR(parabola_at({2.0, 4.0, 8.0}, {5.0, -3.0, 5.0}, 9.0), 12.0, 1e-13);
}

/// Runs one of the studies in examples/intersection without its fine run.
StudySummary run_intersection(const StudyFolder& folder, const std::string& name,
                              std::vector<std::string> overrides = {}) {
  const std::string file = std::string(PERITHERM_SOURCE_DIR) + "/examples/intersection/" + name;
  return run_study(read_study_file(file, overrides), folder.settings());
}

void expect_ratios(const StudySummary& summary, const std::vector<double>& ratios) {
  ASSERT_EQ(summary.intersections.size(), ratios.size());
  for (std::size_t v = 0; v < ratios.size(); ++v) {
    ASSERT_TRUE(summary.intersections[v].chosen.crossing.has_value()) << summary.intersections[v].variant;
    EXPECT_NEAR(summary.intersections[v].chosen.crossing->ratio, ratios[v], 1e-3) << summary.intersections[v].variant;
  }
}

/// Independent prototypes: dense eigen-decomposition of the semi-discrete system, steps of 1e-4 s. Their steps move the
/// ratio by less than 2e-4; the table rounds the first to four decimals, the others to three or four.
TEST(Intersection, of_the_homogeneous_bar_is_that_of_the_prototypes_for_every_quadrature) {
  const StudyFolder folder("intersection");
  const StudySummary summary = run_intersection(folder, "study.toml");
  // whole, half, half_normalised, cell_integrated, trapezoid
  expect_ratios(summary, {2.8888, 3.327, 3.2555, 3.3844, 3.5648});
  // Without runs of [vary] the time is checked in a coarse run of each variant: to 1e-9 of a span of 100, and a margin.
  ASSERT_EQ(summary.time_errors.size(), 5U);
  for (const TimeError& error : summary.time_errors) EXPECT_LT(error.difference, 1e-6) << error.run;
  EXPECT_EQ(summary.time_errors[1].run.find("half, horizon"), 0U) << summary.time_errors[1].run;
  for (const std::size_t compatible : {0, 2, 4}) {
    const IntersectionResult& result = summary.intersections[compatible];
    EXPECT_GT(result.single->rms / result.rerun->rms, 4.0) << result.variant;
    EXPECT_LT(result.cost(), 0.3) << result.variant;
  }
}

TEST(Intersection, of_the_bar_of_two_materials_is_that_of_the_prototypes) {
  const StudyFolder folder("two_materials");
  const StudySummary summary = run_intersection(folder, "two_materials.toml");
  ASSERT_EQ(summary.intersections.size(), 5U);
  // The prototypes hold no figure for `half`, whose bonds conduct too little.
  const std::vector<double> ratios{4.013, 0.0, 4.378, 4.714, 4.922};
  for (const std::size_t v : {0, 2, 3, 4}) {
    EXPECT_NEAR(summary.intersections[v].chosen.crossing->ratio, ratios[v], 1e-3);
  }
}

TEST(Intersection, curves_that_do_not_cross_are_told_with_their_temperatures) {
  const StudyFolder folder("no_crossing");
  const StudySummary summary = run_intersection(folder, "study.toml", {"intersection.time=0.1", "variant=[]"});
  EXPECT_EQ(summary.status, "failed");
  ASSERT_EQ(summary.failures.size(), 1U);
  EXPECT_NE(summary.failures[0].find("do not cross at (0.05) m, t = 0.1 s"), std::string::npos) << summary.failures[0];
}

}  // namespace
}  // namespace peritherm
