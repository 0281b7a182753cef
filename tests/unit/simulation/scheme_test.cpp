#include "peritherm/simulation/scheme.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "peritherm/simulation/write.hpp"
#include "support/run_problem.hpp"
#include "valid_case.hpp"

namespace peritherm {
namespace {

/// A bar held at both ends.
Problem bar_of_scheme(Scheme scheme) {
  Problem problem = unit_body(1, 21, 3.0);
  problem.nonlocality.scheme = scheme;
  set_all_faces(problem, HeldTemperature{1.0, std::nullopt, std::nullopt});
  return problem;
}

const HeldTemperature& held_of(const Problem& problem, std::size_t boundary) {
  return std::get<HeldTemperature>(problem.boundaries.at(boundary).condition);
}

TEST(Scheme, the_default_is_calibrated_on_the_grid_and_mirrors) {
  const Problem problem = resolved(bar_of_scheme(Scheme::peritherm));
  EXPECT_EQ(problem.body.points, PointPlacement::centres);
  EXPECT_EQ(problem.nonlocality.calibration, Calibration::discrete);
  EXPECT_EQ(problem.nonlocality.partial_volumes, PartialVolumes::partial_area);
  EXPECT_EQ(problem.nonlocality.self_term, SelfTerm::none);
  EXPECT_EQ(problem.nonlocality.interface, InterfaceRule::length_weighted_harmonic);
  EXPECT_EQ(held_of(problem, 0).imposed, Imposed::mirror);
}

TEST(Scheme, what_a_case_says_goes_before_its_scheme) {
  Problem problem = bar_of_scheme(Scheme::mei_2021);
  problem.nonlocality.partial_volumes = PartialVolumes::trapezoid;
  std::get<HeldTemperature>(problem.boundaries[1].condition).imposed = Imposed::constant;
  problem = resolved(problem);
  EXPECT_EQ(problem.nonlocality.partial_volumes, PartialVolumes::trapezoid);
  EXPECT_EQ(problem.nonlocality.calibration, Calibration::continuum);
  EXPECT_EQ(held_of(problem, 0).imposed, Imposed::row);
  EXPECT_EQ(held_of(problem, 1).imposed, Imposed::constant);
}

TEST(Scheme, a_resolved_problem_stays_as_it_is_and_reads_back) {
  for (const auto& [scheme, name] : EnumNames<Scheme>::values) {
    const Problem problem = resolved(bar_of_scheme(scheme));
    EXPECT_EQ(resolved(problem), problem) << name;
    EXPECT_EQ(read_case(write_problem(problem), "written.toml").problem, problem) << name;
  }
}

TEST(Scheme, faces_that_no_boundary_names_are_insulated_as_the_scheme_does) {
  Problem problem = unit_body(2, 21, 3.0);
  set_face(problem, Face::y_min, HeldTemperature{1.0, std::nullopt, std::nullopt});
  EXPECT_EQ(resolved(problem).boundaries.size(), 1U);
  problem.nonlocality.scheme = Scheme::bobaru_2012;
  const Problem complete = resolved(problem);
  ASSERT_EQ(complete.boundaries.size(), 4U);
  for (std::size_t b = 1; b < 4; ++b) {
    EXPECT_NE(complete.boundaries[b].face, Face::y_min);
    EXPECT_EQ(std::get<Insulated>(complete.boundaries[b].condition).imposed, Outside::flux_formula);
  }
}

TEST(Scheme, selected_points_are_held_whatever_the_scheme) {
  Problem problem =
      read_case(changed("face = \"y_max\"", "where = { type = \"ball\", centre = [0, 0], radius = 0.002 }"),
                "case.toml")
          .problem;
  problem.nonlocality.scheme = Scheme::mei_2021;
  EXPECT_EQ(held_of(resolved(problem), 0).imposed, std::nullopt);
  EXPECT_TRUE(issues_of(write_problem(problem)).empty());
}

TEST(Scheme, the_table_in_the_guide_is_that_of_the_program) {
  std::ifstream file(std::string(PERITHERM_SOURCE_DIR) + "/docs/guide/schemes.md");
  std::ostringstream guide;
  guide << file.rdbuf();
  const auto expect_row = [&guide](const std::string& key, const auto& choice) {
    std::string row = "| " + key + " |";
    for (const auto& [scheme, name] : EnumNames<Scheme>::values) {
      row += " `" + std::string(name_of(choice(choices_of(scheme)))) + "` |";
    }
    EXPECT_NE(guide.str().find(row), std::string::npos) << row;
  };
  expect_row("`[body] points`", [](const SchemeChoices& choices) { return choices.points; });
  expect_row("`partial_volumes`", [](const SchemeChoices& choices) { return choices.partial_volumes; });
  expect_row("`calibration`", [](const SchemeChoices& choices) { return choices.calibration; });
  expect_row("`self_term`", [](const SchemeChoices& choices) { return choices.self_term; });
  expect_row("`interface`", [](const SchemeChoices& choices) { return choices.interface; });
  expect_row("`boundary_volumes`", [](const SchemeChoices& choices) { return choices.boundary_volumes; });
  expect_row("`imposed` of `temperature`", [](const SchemeChoices& choices) { return choices.held; });
  expect_row("`imposed` of `insulated`", [](const SchemeChoices& choices) { return choices.insulated; });
  expect_row("`imposed` of `flux`", [](const SchemeChoices& choices) { return choices.flux; });
}

}  // namespace
}  // namespace peritherm
