#include <gtest/gtest.h>

#include "peritherm/base/error.hpp"
#include "support/differences.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

/// Everything that can move heat, none of it changing in time, in two materials.
Problem busy_plate() {
  Problem problem = unit_body(2, 24, 3.0);
  problem.materials["good"] = {30.0, 2.0, 5.0};
  problem.body.regions = {{"good", Ball{{0.4, 0.6}, 0.2}}};
  problem.initial.temperature = Profile("x + cos(pi*y)");
  set_face(problem, Face::x_min, held_at(Profile("cos(pi*y)")));
  set_face(problem, Face::x_max, PrescribedFlux{Profile("1 + y")});
  set_face(problem, Face::y_max, Convection{2.0, Profile("x")});
  problem.sources.push_back({Profile("30*x"), std::nullopt});
  problem.cracks.emplace_back().points = {{0.5, 0.2}, {0.8, 0.5}};
  problem.time.integrator = SteadyState{};
  return problem;
}

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

/// A plate in two halves, cut at x = 0.5, that nothing holds; each half has its own mean.
Problem halves() {
  Problem problem = unit_body(2, 12, 2.5);
  problem.cracks.emplace_back().points = {{0.5, -0.1}, {0.5, 1.1}};
  problem.initial.temperature = Profile("x < 0.5 ? 3 + cos(4*pi*x) + y : 7 - y");
  problem.time.integrator = SteadyState{};
  return problem;
}

std::string complaint(const Problem& problem) {
  try {
    March(problem).advance_to(problem.time.end);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SteadyState, has_no_rate_left) {
  for (const BackendName backend : {BackendName::stencil, BackendName::bond}) {
    Problem problem = busy_plate();
    problem.numerics.backend = backend;
    March run(problem);
    run.advance_to(1.0);
    // The root mean square of the error is below the tolerance, and no mode is faster than the fastest rate.
    const double points = static_cast<double>(run.grid().size());
    const double error = 1e-10 * span_of(run.temperatures()) + rounding(100, largest(run.temperatures()));
    const double contrast = 30.0;  // of the weights that the mean is taken with
    EXPECT_LT(largest(run.rates()), run.assembly().system->fastest_rate() * error * std::sqrt(contrast * points));
  }
}

TEST(SteadyState, is_where_a_long_march_arrives) {
  Problem problem = busy_plate();
  March steady(problem);
  steady.advance_to(1.0);
  problem.time.integrator = RungeKuttaLegendre{1e-9};
  March march(problem);
  // The slowest mode decays faster than one of a bar of the poorer material, insulated at one end: 2.4 per second.
  march.advance_to(12.0);
  const std::vector<double> expected = march.temperatures(), found = steady.temperatures();
  for (std::size_t n = 0; n < found.size(); ++n) EXPECT_NEAR(found[n], expected[n], 1e-6 * span_of(expected));
}

TEST(SteadyState, of_materials_in_series_is_exact_at_any_contrast) {
  for (const double contrast : {1.0, 1e3, 1e6}) {
    Problem problem = unit_body(1, 64, 2.5);
    problem.materials["good"] = {contrast, 0.1, 0.3};
    problem.body.regions = {{"good", Box{{0.0}, {0.5}}}};
    set_face(problem, Face::x_min, held_at(0.0));
    set_face(problem, Face::x_max, held_at(1.0));
    problem.time.integrator = SteadyState{1e-12};
    March run(problem);
    run.advance_to(1.0);
    const double flux = 1.0 / (0.5 / contrast + 0.5);
    const auto exact = [&](const Point& x) {
      return flux * (x[0] < 0.5 ? x[0] / contrast : 0.5 / contrast + x[0] - 0.5);
    };
    EXPECT_LT(run.relative_error(exact), 1e-10) << contrast;
    // Points of neither material set the pace of the other: about as many iterations as points at most.
    EXPECT_LT(run.count().accepted, 2 * 64) << contrast;
  }
}

TEST(SteadyState, of_an_insulated_body_keeps_its_mean) {
  Problem problem = unit_body(2, 16, 3.0);
  problem.materials["heavy"] = {0.1, 4.0, 2.0};
  problem.body.regions = {{"heavy", Box{{0.0, 0.0}, {1.0, 0.3}}}};
  problem.initial.temperature = Profile("cos(3*x) + y");
  problem.time.integrator = SteadyState{};
  March run(problem);
  const double before = run.stored_heat();
  run.advance_to(1.0);
  const std::vector<double> after = run.temperatures();
  EXPECT_LT(span_of(after), 1e-8);
  EXPECT_NEAR(run.stored_heat(), before, rounding(1000, before));
}

TEST(SteadyState, of_an_insulated_body_may_pass_heat_through) {
  Problem problem = unit_body(2, 16, 3.0);
  problem.initial.temperature = 5.0;
  set_face(problem, Face::x_min, PrescribedFlux{2.0});
  set_face(problem, Face::x_max, PrescribedFlux{-2.0});
  problem.time.integrator = SteadyState{};
  March run(problem);
  const double before = run.stored_heat();
  run.advance_to(1.0);
  EXPECT_NEAR(run.stored_heat(), before, rounding(1000, before));
  // Conductivity 1, so the temperature falls by 2 from face to face.
  EXPECT_NEAR(run.at({0.25, 0.5}) - run.at({0.75, 0.5}), 1.0, 1e-8);
}

TEST(SteadyState, of_separate_parts_keeps_the_heat_of_each) {
  March run(halves());
  const std::vector<double> start = run.temperatures();
  run.advance_to(1.0);
  const std::vector<double> end = run.temperatures();
  for (const bool left : {true, false}) {
    double mean = 0.0, points = 0.0;
    for (std::size_t n = 0; n < start.size(); ++n) {
      if ((run.position(n)[0] < 0.5) != left) continue;
      mean += start[n];
      points += 1.0;
    }
    for (std::size_t n = 0; n < end.size(); ++n) {
      if ((run.position(n)[0] < 0.5) != left) continue;
      EXPECT_NEAR(end[n], mean / points, 1e-8) << n;
    }
  }
}

TEST(SteadyState, of_an_island_keeps_its_heat_while_the_rest_is_held) {
  Problem problem = unit_body(2, 20, 2.5);
  problem.body.regions = {{"void", Box{{0.3, 0.3}, {0.9, 0.9}}}, {"body", Box{{0.5, 0.5}, {0.7, 0.7}}}};
  problem.initial.temperature = Profile("x > 0.45 && x < 0.75 && y > 0.45 && y < 0.75 ? 40*x : 0");
  set_face(problem, Face::x_min, held_at(1.0));
  problem.time.integrator = SteadyState{};
  March run(problem);
  run.advance_to(1.0);
  // Islands of 4 x 4 points, symmetric about their middle at x = 0.6.
  for (std::size_t n = 0; n < run.grid().size(); ++n) {
    const Point x = run.position(n);
    const bool island = std::abs(x[0] - 0.6) < 0.1 && std::abs(x[1] - 0.6) < 0.1;
    const bool hole = !island && x[0] > 0.3 && x[0] < 0.9 && x[1] > 0.3 && x[1] < 0.9;
    if (hole) continue;
    EXPECT_NEAR(run.temperatures()[n], island ? 24.0 : 1.0, 1e-7) << x[0] << ' ' << x[1];
  }
}

TEST(SteadyState, does_not_exist_where_heat_cannot_leave) {
  Problem problem = unit_body(1, 20, 2.5);
  problem.sources.push_back({Profile(3.0), std::nullopt});
  problem.time.integrator = SteadyState{};
  EXPECT_NE(complaint(problem).find("gains 3 W"), std::string::npos) << complaint(problem);
  problem.sources.front().value = Profile(-3.0);
  EXPECT_NE(complaint(problem).find("loses 3 W"), std::string::npos) << complaint(problem);
}

TEST(SteadyState, does_not_exist_where_only_the_parts_together_balance) {
  Problem problem = halves();
  set_face(problem, Face::x_min, PrescribedFlux{1.0});
  set_face(problem, Face::x_max, PrescribedFlux{-1.0});
  EXPECT_NE(complaint(problem).find("gains 1 W"), std::string::npos) << complaint(problem);
}

TEST(SteadyState, takes_growing_cracks_as_they_stand_at_the_end) {
  Problem problem = unit_body(2, 20, 2.5);
  set_face(problem, Face::y_min, held_at(0.0));
  set_face(problem, Face::y_max, held_at(1.0));
  Crack crack;
  crack.faces = Faces::cut;
  crack.points = {{-0.1, 0.5}, {0.9, 0.5}};
  problem.cracks = {crack};
  problem.time.integrator = SteadyState{};
  Problem growing = problem;
  growing.cracks.front().tip_speed = 0.513;
  problem.cracks.front().points.back()[0] = 0.413;
  March standing(problem), grown(growing);
  standing.advance_to(1.0);
  grown.advance_to(1.0);
  const std::vector<double> expected = standing.temperatures(), found = grown.temperatures();
  for (std::size_t n = 0; n < found.size(); ++n) EXPECT_NEAR(found[n], expected[n], 1e-8);
}

TEST(SteadyState, knows_heat_rates_but_no_heats) {
  March run(busy_plate());
  run.advance_to(1.0);
  const std::vector<double> rates = run.heat_rates();
  double sum = 0.0;
  for (const double rate : rates) sum += rate;
  EXPECT_NEAR(sum, 0.0, 1e-7 * largest(rates));
}

TEST(SteadyState, gives_up_with_a_word_on_its_error) {
  Problem problem = busy_plate();
  problem.time.integrator = SteadyState{1e-10, 5};
  EXPECT_NE(complaint(problem).find("not reached in 5 iterations"), std::string::npos) << complaint(problem);
}

TEST(SteadyState, that_the_start_already_is_stays) {
  Problem problem = unit_body(2, 10, 2.5);
  problem.initial.temperature = 300.0;
  set_face(problem, Face::y_min, held_at(300.0));
  problem.time.integrator = SteadyState{};
  March run(problem);
  run.advance_to(1.0);
  for (const double value : run.temperatures()) EXPECT_NEAR(value, 300.0, rounding(28, 300.0));
}

}  // namespace
}  // namespace peritherm
