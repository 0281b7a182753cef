#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "peritherm/simulation/schedule.hpp"
#include "peritherm/simulation/simulate.hpp"
#include "support/run_problem.hpp"
#include "valid_case.hpp"

namespace peritherm {
namespace {

std::string steady_case(std::string_view piece, std::string_view replacement) {
  std::string text = changed(piece, replacement);
  const std::string_view chosen = "integrator = \"rkl2\"";
  return text.replace(text.find(chosen), chosen.size(), "integrator = \"steady\"");
}

TEST(SteadyStateOfACase, needs_loads_that_do_not_depend_on_time) {
  EXPECT_TRUE(issues_of(steady_case("value = 1000", "value = \"1000*x\"")).empty());
  const std::vector<Issue> issues = issues_of(steady_case("value = 1000", "value = \"1000*t\""));
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].where.key, "source.0.value");
  EXPECT_NE(issues[0].problem.find("depends on t"), std::string::npos);
}

TEST(SteadyStateOfACase, is_written_once_whatever_the_period) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "peritherm_steady_state_written_once";
  std::filesystem::remove_all(folder);
  Problem problem = unit_body(1, 20, 2.5);
  set_face(problem, Face::x_min, held_at(0.0));
  set_face(problem, Face::x_max, held_at(4.0));
  problem.outputs.push_back({0.1, std::nullopt, ProbeOutput{"middle", {0.5}}});
  problem.outputs.push_back({std::nullopt, std::vector<double>{0.0, 0.3}, EnergyOutput{}});
  problem.time.integrator = SteadyState{};
  RunSettings settings;
  settings.folder = folder;
  const RunSummary summary = run(problem, settings);
  EXPECT_EQ(summary.status, "completed");
  EXPECT_EQ(summary.end_time, problem.time.end);
  // Two walls pass the same heat up to the tolerance; heats since the start are unknown.
  EXPECT_LT(summary.energy_relative_residual, 1e-7);
  std::ifstream probes(folder / "probes.csv"), energy(folder / "energy.csv");
  std::string line;
  std::getline(probes, line);
  std::getline(probes, line);
  EXPECT_EQ(line.substr(0, 2), "1,");
  EXPECT_NEAR(std::stod(line.substr(2)), 2.0, 1e-8);
  EXPECT_FALSE(std::getline(probes, line));
  std::getline(energy, line);
  std::getline(energy, line);
  EXPECT_NE(line.find(",nan,"), std::string::npos) << line;
  EXPECT_FALSE(std::getline(energy, line));
  std::filesystem::remove_all(folder);
}

TEST(SteadyStateOfACase, is_planned_with_the_number_of_its_iterations) {
  Problem problem = unit_body(2, 48, 3.0);
  set_face(problem, Face::x_min, held_at(0.0));
  set_face(problem, Face::x_max, held_at(4.0));
  problem.initial.temperature = Profile("sin(37*x)*cos(23*y)");
  problem.time.integrator = SteadyState{};
  const double expected = plan(problem).evaluations;
  March run(problem);
  run.advance_to(1.0);
  const auto needed = static_cast<double>(run.count().evaluations);
  EXPECT_LT(needed, 1.5 * expected);
  EXPECT_GT(needed, expected / 10.0);
}

}  // namespace
}  // namespace peritherm
