#include "peritherm/simulation/simulate.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "peritherm/base/error.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

class Simulate : public testing::Test {
 protected:
  Simulate()
      : folder_(std::filesystem::temp_directory_path() /
                ("peritherm_simulate_" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(folder_);
  }
  ~Simulate() override { std::filesystem::remove_all(folder_); }

  RunSettings settings() const {
    RunSettings chosen;
    chosen.folder = folder_;
    return chosen;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }

  std::filesystem::path folder_;
};

TEST_F(Simulate, a_temperature_that_overflows_ends_the_run_whatever_the_integrator) {
  for (const TimeStepping& integrator :
       {TimeStepping{ForwardEuler{}}, TimeStepping{RungeKutta4{}}, TimeStepping{RungeKuttaLegendre{}}}) {
    Problem problem = unit_body(1, 10, 2.0);
    problem.initial.temperature = 1.7e308;
    problem.sources.push_back({Profile(1e308), std::nullopt});
    problem.time.integrator = integrator;
    RunSettings chosen = settings();
    chosen.overwrite = true;
    try {
      run(problem, chosen);
      FAIL() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::numerics) << error.what();
    }
    EXPECT_NE(read("summary.json").find("\"failed\""), std::string::npos);
  }
}

TEST_F(Simulate, the_resolved_case_names_the_backend_that_ran) {
  run(unit_body(2, 20, 3.0), settings());
  EXPECT_NE(read("resolved.toml").find("backend = \"stencil\""), std::string::npos) << read("resolved.toml");
  EXPECT_NE(read("summary.json").find("per evaluation"), std::string::npos);
}

TEST_F(Simulate, the_plan_names_the_stable_step_of_the_run) {
  Problem problem = unit_body(2, 20, 3.0);
  problem.materials["light"] = {5.0, 0.1, 1.0};
  problem.body.regions.push_back({"light", Box{{0.0, 0.0}, {0.5, 1.0}}});
  problem.nonlocality.interface = InterfaceRule::arithmetic;
  set_face(problem, Face::x_min, Convection{1e4, 20.0});
  problem.time.end = 1e-4;
  EXPECT_EQ(plan(problem).stable_step, run(problem, settings()).plan.stable_step);
}

TEST_F(Simulate, a_step_beyond_the_limit_is_refused_before_anything_is_written) {
  Problem problem = unit_body(1, 10, 2.0);
  problem.time.integrator = RungeKutta4{1.0, 0.9};
  EXPECT_THROW(plan(problem), Error);
  EXPECT_THROW(run(problem, settings()), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

TEST_F(Simulate, only_results_of_earlier_runs_are_replaced) {
  Problem problem = unit_body(1, 10, 2.0);
  problem.time.end = 0.01;
  std::filesystem::create_directories(folder_ / "pictures");
  std::ofstream(folder_ / "pictures" / "holiday.png") << "mine";
  EXPECT_THROW(run(problem, settings()), Error);
  RunSettings chosen = settings();
  chosen.overwrite = true;
  run(problem, chosen);
  EXPECT_EQ(read("pictures/holiday.png"), "mine");
  EXPECT_NE(read("summary.json").find("\"completed\""), std::string::npos);
}

TEST_F(Simulate, a_run_that_is_asked_to_stop_keeps_what_it_has) {
  Problem problem = unit_body(1, 10, 2.0);
  problem.outputs.push_back({0.1, std::nullopt, ProbeOutput{"middle", {0.5}}});
  RunSettings chosen = settings();
  chosen.stop_requested = [] { return true; };
  const RunSummary summary = run(problem, chosen);
  EXPECT_EQ(summary.status, "stopped");
  EXPECT_LT(summary.end_time, problem.time.end);
  EXPECT_NE(read("summary.json").find("\"stopped\""), std::string::npos);
  EXPECT_EQ(read("probes.csv").substr(0, 12), "time,middle\n");
}

}  // namespace
}  // namespace peritherm
