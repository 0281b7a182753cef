#include <gtest/gtest.h>

#include "peritherm/base/error.hpp"
#include "peritherm/papers/galadima_cases.hpp"
#include "support/full_case.hpp"

namespace peritherm {
namespace {

/// A plate that is heated from below while a crack grows across it.
Problem plate_with_growing_crack() {
  Problem problem = unit_body(2, 20, 3.0);
  set_face(problem, Face::y_min, held_at(1.0));
  set_face(problem, Face::y_max, held_at(0.0));
  problem.time.end = 0.3;
  Crack crack;
  crack.points = {{0.0, 0.51}, {1.0, 0.51}};
  crack.start_time = 0.05;
  crack.tip_speed = 5.0;
  problem.cracks.push_back(crack);
  return problem;
}

TEST(ProperOrthogonal, repeats_the_run_it_was_made_from) {
  Problem problem = unit_body(2, 16, 3.0);
  problem.initial.temperature = Profile("x*y");
  set_face(problem, Face::y_min, held_at(Profile("1 + sin(20*t)")));
  set_face(problem, Face::x_max, Convection{5.0, Profile("y")});
  problem.sources.push_back({Profile("3*x"), std::nullopt});
  problem.time.end = 0.5;
  FullCase full(problem, {1e-3, 1e-2, 0.1, 0.5}, 0.0);
  ProperOrthogonal method;
  method.tolerance = 1e-6;
  method.snapshots = 60;
  const Reduction reduction = reduce(method, full.full());
  EXPECT_LE(reduction.model.unknowns(), 30U);
  const Difference difference =
      largest_difference(reduction.model, full.question({2e-3, 0.0173, 0.1, 0.4}), problem, RungeKutta4{{}, 0.1});
  // Temperatures span 2.6 at most. The estimate holds at the snapshots, of which these times are none.
  EXPECT_LE(reduction.model.estimated_error, 2.0 * method.tolerance);
  EXPECT_LE(difference.rms, 2.0 * 2.6 * reduction.model.estimated_error);
  RecordProperty("rms", std::to_string(difference.rms));
}

TEST(ProperOrthogonal, keeps_the_heat_of_an_insulated_body) {
  Problem problem = unit_body(2, 12, 3.0);
  problem.initial.temperature = Profile("cos(3*x)*y");
  problem.sources.push_back({Profile("x + t"), std::nullopt});
  problem.time.end = 0.2;
  FullCase full(problem, {1e-2, 0.1, 0.2}, 0.3);
  ProperOrthogonal method;
  method.tolerance = 1e-3;
  method.snapshots = 20;
  const Reduction reduction = reduce(method, full.full());
  const ModelQuestion question = full.question({0.0, 0.05, 0.2});
  const std::vector<ModelState> states = answer(reduction.model, question);
  const double first = stored_heat(reduction.model, states.front(), question.level);
  for (const ModelState& state : states) {
    const double heat = std::accumulate(state.heats.begin(), state.heats.end(), 0.0);
    // The source brings in t/2 + t²/2.
    EXPECT_NEAR(heat, 0.5 * state.time + 0.5 * state.time * state.time, 1e-12);
    EXPECT_NEAR(stored_heat(reduction.model, state, question.level) - first, heat, 1e-12);
  }
}

TEST(ProperOrthogonal, follows_a_crack_that_grows) {
  const Problem problem = plate_with_growing_crack();
  FullCase full(problem, {0.01, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3}, 0.0);
  ProperOrthogonal method;
  method.tolerance = 1e-3;
  method.snapshots = 60;
  const Reduction reduction = reduce(method, full.full());
  const ReducedModel& model = reduction.model;
  EXPECT_GT(model.stages.size(), 8U);
  EXPECT_LE(model.unknowns(), 40U);
  EXPECT_LE(model.estimated_error, 2.0 * method.tolerance);
  EXPECT_NE(reduction.notes.back().find("holds for this growth only"), std::string::npos);
  const Difference difference =
      largest_difference(model, full.question({0.03, 0.1, 0.17, 0.3}), problem, RungeKutta4{{}, 0.2});
  EXPECT_LE(difference.rms, 2.0 * model.estimated_error);
  RecordProperty("rms", std::to_string(difference.rms));
  RecordProperty("largest", std::to_string(difference.largest));
  // Without the growth nothing but the first stage would hold: that is far away at the end.
  ReducedModel standing = model;
  standing.stages = {model.stages.front()};
  standing.stages[0].end = std::numeric_limits<double>::infinity();
  EXPECT_GE(largest_difference(standing, full.question({0.3}), problem, RungeKutta4{{}, 0.2}).rms, 0.05);
}

TEST(ProperOrthogonal, needs_no_more_unknowns_than_the_prototype) {
  Problem problem = galadima_plate(PlateLoad::held);
  const std::vector<double> times{1e-6, 5e-6, 2e-5, 7e-5, 2e-4, 7e-4, 3.5e-3, 7e-3};
  FullCase full(problem, times, 0.0);
  // Largest error over all points and these times, from 120 snapshots, by an independent program.
  for (const auto& [unknowns, error] : {std::pair{12, 5e-5}, {18, 3.6e-7}, {24, 4e-9}}) {
    ProperOrthogonal method;
    method.tolerance = 1e-10;
    method.most_unknowns = unknowns;
    const Reduction reduction = reduce(method, full.full());
    EXPECT_EQ(reduction.model.unknowns(), static_cast<std::size_t>(unknowns));
    const Difference difference = largest_difference(reduction.model, full.question(times), problem, Chebyshev{1e-12});
    EXPECT_LE(difference.largest, 1.5 * error) << unknowns;
    // What the method says about itself is what is true at the snapshots, of which these times are some.
    EXPECT_LE(difference.rms, reduction.model.estimated_error) << unknowns;
    EXPECT_GE(difference.rms, 0.2 * reduction.model.estimated_error) << unknowns;
    RecordProperty("error_" + std::to_string(unknowns), std::to_string(difference.largest));
  }
}

TEST(ProperOrthogonal, needs_the_profiles_of_the_case) {
  FullCase full(plate_with_growing_crack(), {0.01, 0.3}, 0.0);
  full.full().profiles.clear();
  EXPECT_THROW(reduce(ProperOrthogonal{}, full.full()), Error);
}

TEST(ProperOrthogonal, stops_when_told_to) {
  FullCase full(plate_with_growing_crack(), {0.01, 0.3}, 0.0);
  EXPECT_THROW(reduce(ProperOrthogonal{}, full.full(), [](const std::string&, double share) { return share < 0.1; }),
               Error);
}

}  // namespace
}  // namespace peritherm
