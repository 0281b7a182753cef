#include "peritherm/simulation/reduce_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "peritherm/simulation/answer_case.hpp"
#include "peritherm/simulation/model_question.hpp"
#include "peritherm/simulation/read.hpp"
#include "peritherm/simulation/reduction_memory.hpp"
#include "peritherm/simulation/verify_model.hpp"
#include "peritherm/simulation/write.hpp"
#include "peritherm/studies/solve.hpp"
#include "reduced_plate.hpp"
#include "support/study_folder.hpp"

namespace peritherm {
namespace {

Problem plate_to_reduce(const std::vector<std::string>& overrides = {}) {
  return read_case(reduced_plate, "plate.toml", overrides, CaseUse::reduce).problem;
}

std::string faults_of_plate(const std::vector<std::string>& overrides, CaseUse use = CaseUse::reduce) {
  try {
    read_case(reduced_plate, "plate.toml", overrides, use);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// A model of the plate, made once for all tests.
struct MadeModel {
  ReducibleCase reducible = make_reducible(plate_to_reduce());
  ReducedCase reduced = reduce_case(reducible);
};
MadeModel& made_model() {
  static MadeModel made;
  return made;
}

ModelCase case_of_model(const std::vector<std::string>& overrides) {
  return make_model_case(made_model().reduced.model, "model.h5", overrides);
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(ReduceCase, the_section_is_written_as_it_was_read) {
  for (const char* method :
       {"{type=\"rational_krylov\", shifts=[1,100], shortest_time=0.01}", "{type=\"proper_orthogonal\", snapshots=20}",
        "{type=\"static_condensation\", capacity=\"lumped\", retained={every=[3,2], share=0.1, seed=4}}",
        "{type=\"craig_bampton\", modes=7, start=\"sampled\", retained={points=[[0.1,0.2]], "
        "region=[{shape={type=\"ball\", centre=[0.5,0.5], radius=0.2}, every=2}]}}"}) {
    const Problem problem = plate_to_reduce({"reduction=" + std::string(method)});
    EXPECT_EQ(read_case(write_problem(problem), "again").problem.reduction, problem.reduction) << method;
  }
}

TEST(ReduceCase, a_case_that_says_nothing_takes_the_default_method) {
  std::string text(reduced_plate);
  const auto begin = text.find("[reduction]");
  text.erase(begin, text.find("[time]") - begin);
  EXPECT_FALSE(read_case(text, "plate.toml").problem.reduction.has_value());
  EXPECT_EQ(read_case(text, "plate.toml", {}, CaseUse::reduce).problem.reduction, ReductionOptions{});
}

TEST(ReduceCase, what_cannot_be_reduced_can_be_run) {
  const std::vector<std::string> grows{"crack.0.tip_speed=1"};
  EXPECT_EQ(faults_of_plate(grows, CaseUse::run), "");
  EXPECT_NE(faults_of_plate(grows).find("crack.0.tip_speed: a crack that grows"), std::string::npos);
  EXPECT_EQ(faults_of_plate({"crack.0.tip_speed=1", "reduction=proper_orthogonal"}), "");
  EXPECT_NE(faults_of_plate({"time.integrator=steady", "boundary.0.value=1"}).find("a steady state has no course"),
            std::string::npos);
}

TEST(ReduceCase, loads_are_found_with_their_patterns_and_the_start_is_the_level) {
  const ReducibleCase& reducible = made_model().reducible;
  ASSERT_EQ(reducible.full.loads.size(), 4u);
  EXPECT_EQ(reducible.full.loads[0].key, "boundary.0.value");
  EXPECT_EQ(reducible.full.loads[0].shapes.size(), 2u);
  EXPECT_EQ(reducible.full.loads[2].key, "boundary.2.ambient");
  EXPECT_EQ(reducible.full.loads[3].source, 0);
  EXPECT_EQ(reducible.full.level, 20.0);
  EXPECT_EQ(reducible.full.shortest_time, 0.01);
  EXPECT_EQ(made_model().reduced.model.inputs(), 5u);
}

/// Rational Krylov subspaces are judged by a coarser part of themselves, so that the estimate errs on the safe side.
TEST(ReduceCase, the_true_error_is_below_the_estimate_and_the_tolerance) {
  MadeModel& made = made_model();
  const ModelVerification verification = verify_model(made.reducible, made.reduced);
  ASSERT_EQ(verification.times.size(), 3u);
  EXPECT_LE(verification.rms, verification.estimated + verification.tolerance * verification.span);
  EXPECT_LE(verification.rms, 1e-7 * verification.span);
  EXPECT_LE(verification.probes.at(0).maximum, verification.maximum * (1.0 + 1e-9));
  EXPECT_GT(verification.full_seconds, 0.0);
}

TEST(ReduceCase, other_loads_starts_and_times_are_answered_as_full_runs_are) {
  const std::vector<std::string> changes{"boundary.0.value=50*x + 20*t",
                                         "boundary.1.value=10*cos(5*t)",
                                         "boundary.2.ambient=5",
                                         "source.0.value=300*t",
                                         "time.end=0.4",
                                         "output=[{type=\"probe\", name=\"a\", at=[0.69,0.72], times=[0.03,0.4]}]"};
  const ModelCase asked = case_of_model(changes);
  const ModelQuestion question = make_question(asked.problem, asked.model, {0.03, 0.4});
  const std::vector<ModelState> states = answer(asked.model, question);
  const ModelProbe probe = probe_model(asked.problem, asked.model, {0.69, 0.72});
  Problem full = asked.problem;
  full.time.integrator = Chebyshev{1e-9};
  const Solution solution = solve(full, std::vector<double>{0.03, 0.4});
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> lifted(solution.grid.size());
    lift(asked.model, states[k], question.level, lifted);
    double sum = 0.0, count = 0.0;
    for (std::size_t n = 0; n < lifted.size(); ++n) {
      if (std::isnan(solution.temperatures[k][n])) continue;
      sum += std::pow(lifted[n] - solution.temperatures[k][n], 2);
      count += 1.0;
    }
    // Of both: what the fit of loads in time may miss, and the full run.
    const double slack = 100.0 * (question.tolerance + 1e-9);
    EXPECT_LE(std::sqrt(sum / count), estimated_error(asked.model, states[k]) + slack);
    EXPECT_NEAR(probe.temperature(states[k], question.level), solution.at(k, {0.69, 0.72, 0.0}), 1e-4);
  }
}

TEST(ReduceCase, the_mean_of_a_start_that_differs_is_the_level) {
  ModelQuestion question;
  const Problem problem = plate_to_reduce({"initial.temperature=100*x"});
  set_start(problem, problem.initial.temperature, question);
  ASSERT_EQ(question.start.size(), 144u);
  double sum = 0.0;
  for (const double value : question.start) sum += value;
  EXPECT_NEAR(sum, 0.0, 144 * 100 * 0x1p-50);
  // Cut away.
  EXPECT_EQ(question.start[9 * 12 + 9], 0.0);
}

TEST(ReduceCase, what_a_model_was_built_with_is_refused_and_the_rest_is_read) {
  EXPECT_NO_THROW(case_of_model({"boundary.2.ambient=3", "source.0.value=1", "title=x"}));
  for (const char* change : {"boundary.2.coefficient=3", "body.cells=[6,6]", "crack=[]", "numerics.backend=bond"}) {
    try {
      case_of_model({change});
      ADD_FAILURE() << change;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("the model was built with it"), std::string::npos) << error.what();
    }
  }
}

TEST(ReduceCase, times_that_a_model_was_not_built_for_are_warned_of) {
  EXPECT_TRUE(case_of_model({}).warnings.empty());
  EXPECT_EQ(case_of_model({"time.end=2", "output=[]"}).warnings.size(), 1u);
  EXPECT_EQ(case_of_model({"time.end=0.001", "output=[]"}).warnings.size(), 1u);
}

TEST(ReduceCase, loads_of_a_file_change_what_they_name) {
  const ModelCase model_case = case_of_model({});
  const std::vector<LoadHistory> loads = read_loads(
      "format = 1\n[[load]]\nname = \"a\"\nset = [\"boundary.1.value=2 W/cm^2\", \"initial.temperature=50*x\"]\n"
      "[[load]]\nname = \"b\"\n",
      "loads.toml", model_case);
  ASSERT_EQ(loads.size(), 2u);
  EXPECT_EQ(loads[0].loads[1], Profile(2e4));
  EXPECT_TRUE(loads[0].own_start);
  EXPECT_EQ(loads[0].start, Profile("50*x"));
  EXPECT_EQ(loads[1].loads, load_profiles(model_case.problem, model_case.model.loads));
  EXPECT_FALSE(loads[1].own_start);
}

TEST(ReduceCase, each_load_gets_a_folder_and_all_of_them_a_table) {
  const StudyFolder folder("many_loads");
  const ModelCase model_case = case_of_model({});
  const std::vector<LoadHistory> loads =
      read_loads("format = 1\n[[load]]\nname = \"cold, dark\"\nset = [\"source.0.value=0\"]\n[[load]]\nname = \"b\"\n",
                 "loads.toml", model_case);
  AnswerSettings settings;
  settings.folder = folder.path() / "many";
  const AnswerSummary summary = answer_loads(model_case, loads, settings);
  EXPECT_EQ(summary.loads, 2u);
  EXPECT_LT(summary.relative_error, 1e-4);
  settings.folder = folder.path() / "one";
  answer_case(model_case, settings);
  const std::vector<std::string> table = lines_of(folder.path() / "many" / "loads.csv");
  ASSERT_EQ(table.size(), 7u);
  EXPECT_EQ(table[0], "load,time,beside the hole,estimated_error");
  EXPECT_EQ(table[1].substr(0, 13), "\"cold, dark\",");
  EXPECT_EQ(lines_of(folder.path() / "many" / "b" / "probes.csv"), lines_of(folder.path() / "one" / "probes.csv"));
  EXPECT_EQ(lines_of(folder.path() / "many" / "b" / "energy.csv").size(), 4u);
}

/// Heat that has entered is what is stored more, as far as the model is a projection.
TEST(ReduceCase, heats_of_an_answer_balance) {
  const StudyFolder folder("balance");
  const ModelCase model_case = case_of_model({});
  AnswerSettings settings;
  settings.folder = folder.path() / "out";
  answer_case(model_case, settings);
  const std::vector<std::string> table = lines_of(settings.folder / "energy.csv");
  ASSERT_EQ(table.size(), 4u);
  EXPECT_EQ(table[0].substr(0, 17), "time,stored_heat,");
  const double residual = std::stod(table[3].substr(table[3].rfind(',') + 1));
  // Heat of the size Σ C · span flows; a model of 1e-7 of the span misses no more than its share.
  EXPECT_LT(std::abs(residual), 100.0 * 1e-5);
}

TEST(ReduceCase, dense_matrices_that_would_not_fit_are_refused_beforehand) {
  Problem problem = plate_to_reduce({"reduction={type=\"static_condensation\", retained={every=[1]}}"});
  const double small = reduction_bytes(problem, problem.reduction->method);
  problem.body.cells = {4000, 4000};
  const double large = reduction_bytes(problem, problem.reduction->method);
  EXPECT_GT(large, 1e6 * small);
  try {
    refuse_large_reduction(problem, problem.reduction->method, large);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::machine);
    EXPECT_NE(std::string(error.what()).find("Retain fewer points"), std::string::npos);
  }
}

}  // namespace
}  // namespace peritherm
