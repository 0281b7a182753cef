#include <gtest/gtest.h>

#include "peritherm/base/error.hpp"
#include "peritherm/system/spectral_estimate.hpp"
#include "support/differences.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// Standing cracks, two materials, convection, flux and sources: all that may stay as it is.
Problem standing_plate() {
  Problem problem = unit_body(2, 24, 3.0);
  problem.materials["other"] = {3.0, 1.0, 2.0};
  problem.body.regions.push_back({"other", Box{{0.6, 0.6}, {0.9, 0.8}}});
  problem.initial.temperature = Profile("x + cos(pi*y)");
  set_face(problem, Face::x_min, held_at(Profile("1 + y")));
  set_face(problem, Face::x_max, PrescribedFlux{Profile("1 + y")});
  set_face(problem, Face::y_max, Convection{2.0, Profile("x")});
  problem.sources.push_back({Profile("5*x"), std::nullopt});
  Crack crack;
  crack.points = {{0.2, 0.3}, {0.7, 0.45}};
  problem.cracks.push_back(crack);
  return problem;
}

std::vector<double> temperatures_at(Problem problem, const TimeStepping& stepping, double end) {
  problem.time.integrator = stepping;
  March run(std::move(problem));
  run.advance_to(end);
  return run.temperatures();
}

/// Temperatures of the plates here span about 3.
constexpr double span = 3.0;

TEST(Propagator, keeps_its_tolerance_down_to_rounding) {
  const double end = 0.05;
  // Fourth order in steps of a hundredth of the stable one: its own error is below rounding.
  const std::vector<double> reference = temperatures_at(standing_plate(), RungeKutta4{std::nullopt, 0.02}, end);
  for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const double error = rms_difference(temperatures_at(standing_plate(), Chebyshev{tolerance}, end), reference);
    EXPECT_LE(error, tolerance * span) << tolerance;
  }
}

TEST(Propagator, is_exact_for_loads_that_are_polynomials_in_time) {
  Problem problem = standing_plate();
  problem.boundaries = {};
  set_face(problem, Face::x_min, held_at(Profile("y + 3*t - 20*t*t")));
  set_face(problem, Face::y_max, Convection{2.0, Profile("x*t")});
  set_face(problem, Face::x_max, PrescribedFlux{Profile("1 + t*t")});
  problem.sources = {{Profile("5*x*t"), std::nullopt}};
  const double end = 0.1;
  const std::vector<double> reference = temperatures_at(problem, RungeKutta4{std::nullopt, 0.05}, end);
  problem.time.integrator = Chebyshev{1e-10};
  March run(std::move(problem));
  run.advance_to(end);
  EXPECT_EQ(run.count().accepted, 1);
  // One share of the tolerance for each of three series, and as much for what RK4 leaves.
  EXPECT_LE(rms_difference(run.temperatures(), reference), 4e-10 * span);
}

TEST(Propagator, follows_other_loads_piece_by_piece) {
  Problem problem = standing_plate();
  problem.boundaries = {};
  set_face(problem, Face::x_min, held_at(Profile("y + sin(9*t)")));
  problem.sources = {{Profile("t < 0.0312 ? 20*x : 0"), std::nullopt}};
  const double end = 0.1;
  // Steps that end just before and begin just after the source is switched off.
  problem.time.integrator = RungeKutta4{0.0312 / 1000, 0.9};
  March reference(problem);
  reference.advance_to(0.0312 * (1.0 - 1e-13));
  reference.advance_to(0.0312 * (1.0 + 1e-13));
  reference.advance_to(end);
  for (const double tolerance : {1e-4, 1e-7}) {
    problem.time.integrator = Chebyshev{tolerance};
    March run(problem);
    run.advance_to(end);
    // Loads are met to the tolerance times their own variation (1 K at the wall, 20 W/m³ over 0.03 s), series as well.
    EXPECT_LE(rms_difference(run.temperatures(), reference.temperatures()), 3.0 * tolerance * span) << tolerance;
    EXPECT_GT(run.count().accepted, 2);
  }
}

TEST(Propagator, shares_one_recurrence_among_output_times) {
  Problem problem = standing_plate();
  problem.time.integrator = Chebyshev{1e-9};
  const Assembly assembly = assemble(problem);
  const double times[] = {0.003, 0.01, 0.05};
  std::vector<double> state = initial_state(problem, assembly);
  const auto integrator = make_integrator(problem.time.integrator, *assembly.system);
  std::size_t seen = 0;
  const MarchFollower follower{[](double, ConstField) { return true; },
                               [&](double time, Field temperature) {
                                 EXPECT_EQ(time, times[seen]);
                                 std::vector<double> points(assembly.geometry.body.grid.size());
                                 assembly.layout.gather(temperature, points);
                                 const auto alone = temperatures_at(problem, problem.time.integrator, times[seen]);
                                 EXPECT_LE(rms_difference(points, alone), 2e-9 * span);
                                 ++seen;
                                 return true;
                               },
                               [](double) { return true; }};
  EXPECT_EQ(integrator->march(0.0, times, state, follower), 0.05);
  EXPECT_EQ(seen, 3u);
  March last(problem);
  last.advance_to(0.05);
  EXPECT_EQ(integrator->count().evaluations, last.count().evaluations);
}

TEST(Propagator, finds_a_pulse_between_the_outputs) {
  Problem problem = unit_body(2, 8, 2.0);
  problem.sources.push_back({Profile("t > 0.4 && t < 0.45 ? 100 : 0"), std::nullopt});
  problem.time.integrator = Chebyshev{1e-6};
  March run(problem);
  run.advance_to(1.0);
  // 100 W/m³ for 0.05 s; each jump is passed within 1e-12 of the time.
  EXPECT_NEAR(run.stored_heat(), 5.0, 5.0 * 1e-6);
}

TEST(Propagator, follows_a_spot_that_moves_between_probed_points) {
  Problem problem = unit_body(2, 40, 2.0);
  problem.sources.push_back({Profile("sqrt((x - 0.2 - t)^2 + (y - 0.5)^2) < 0.06 ? 100 : 0"), std::nullopt});
  problem.time.integrator = RungeKuttaLegendre{1e-6};
  March reference(problem);
  reference.advance_to(0.3);
  problem.time.integrator = AutomaticStepping{};
  March run(problem);
  run.advance_to(0.3);
  EXPECT_NEAR(run.stored_heat(), reference.stored_heat(), 0.01 * reference.stored_heat());
  EXPECT_LE(rms_difference(run.temperatures(), reference.temperatures()), 0.01 * span_of(reference.temperatures()));
}

TEST(Propagator, is_right_at_times_far_below_the_fastest_decay) {
  Problem problem = standing_plate();
  problem.time.integrator = Chebyshev{1e-10};
  const Assembly assembly = assemble(problem);
  std::vector<double> start = initial_state(problem, assembly), state = start, rate(start.size());
  assembly.system->combine(0.0, start, 1.0, {}, rate);
  const double times[] = {1e-12, 1e-9, 0.01};
  std::size_t seen = 0;
  const MarchFollower follower{[](double, ConstField) { return true; },
                               [&](double time, Field temperature) {
                                 // So early, heats are rates times time; the decays of 1e4/s change rates by 1e-5.
                                 for (std::size_t n = assembly.system->field_size(); n < state.size() && seen < 2;
                                      ++n) {
                                   EXPECT_NEAR(temperature[n], time * rate[n], 1e-4 * std::abs(time * rate[n]));
                                 }
                                 ++seen;
                                 return true;
                               },
                               [](double) { return true; }};
  make_integrator(problem.time.integrator, *assembly.system)->march(0.0, times, state, follower);
  EXPECT_EQ(seen, 3u);
}

TEST(Propagator, leaves_the_state_where_it_is_stopped_within_a_stretch) {
  const Problem problem = standing_plate();
  const Assembly assembly = assemble(problem);
  const std::vector<double> start = initial_state(problem, assembly);
  std::vector<double> state = start;
  const auto integrator = make_integrator(Chebyshev{1e-9}, *assembly.system);
  const double times[] = {0.05};
  const MarchFollower follower{[](double, ConstField) { return true; }, [](double, Field) { return true; },
                               [](double) { return false; }};
  EXPECT_EQ(integrator->march(0.0, times, state, follower), 0.0);
  EXPECT_GT(integrator->count().evaluations, 0);
  for (std::size_t n = 0; n < assembly.system->field_size(); ++n) EXPECT_EQ(state[n], start[n]);
}

/// Claims that all decays are three times slower than they are.
class Underestimated final : public ThermalSystem {
 public:
  explicit Underestimated(ThermalSystem& system) : system_(system) {}
  std::size_t size() const override { return system_.size(); }
  std::size_t field_size() const override { return system_.field_size(); }
  bool begin_step(double from, double to) override { return system_.begin_step(from, to); }
  void combine(double time, Field temperature, double rate_weight, Terms terms, Field result) override {
    system_.combine(time, temperature, rate_weight, terms, result);
  }
  std::optional<LoadPiece> fit_loads(double from, double to, int degree, double tolerance) override {
    return system_.fit_loads(from, to, degree, tolerance);
  }
  void combine_linear(int k, Field temperature, double rate_weight, Terms terms, Field result,
                      Accumulations accumulations) override {
    system_.combine_linear(k, temperature, rate_weight, terms, result, accumulations);
  }
  double heat_product(ConstField a, ConstField b) const override { return system_.heat_product(a, b); }
  double rms(Terms terms) const override { return system_.rms(terms); }
  Extremes extremes(ConstField temperature) const override { return system_.extremes(temperature); }
  double rate_rounding() const override { return system_.rate_rounding(); }
  double fastest_rate() override { return system_.fastest_rate() / 3.0; }

 private:
  ThermalSystem& system_;
};

TEST(Propagator, notices_an_underestimated_rate_and_mends_it) {
  const Problem problem = standing_plate();
  const Assembly assembly = assemble(problem);
  Underestimated system(*assembly.system);
  std::vector<double> state = initial_state(problem, assembly);
  const auto integrator = make_integrator(Chebyshev{1e-9}, system);
  integrator->advance(0.0, 0.05, state, [](double, ConstField) { return true; });
  EXPECT_GT(integrator->count().rejected, 0);
  std::vector<double> points(assembly.geometry.body.grid.size());
  assembly.system->fill(0.05, state);
  assembly.layout.gather(state, points);
  EXPECT_LE(rms_difference(points, temperatures_at(problem, Chebyshev{1e-9}, 0.05)), 2e-9 * span);
}

TEST(Propagator, is_chosen_for_bodies_that_stay_and_refused_for_others) {
  Problem problem = standing_plate();
  const double times[] = {0.1};
  const Assembly standing = assemble(problem);
  EXPECT_TRUE(
      std::holds_alternative<Chebyshev>(choose_stepping(AutomaticStepping{}, *standing.system, 0.0, times).stepping));
  problem.cracks.front().tip_speed = 10.0;
  const Assembly growing = assemble(problem);
  const ChosenStepping chosen = choose_stepping(AutomaticStepping{1e-7}, *growing.system, 0.0, times);
  ASSERT_TRUE(std::holds_alternative<RungeKuttaLegendre>(chosen.stepping));
  EXPECT_EQ(std::get<RungeKuttaLegendre>(chosen.stepping).relative_tolerance, 1e-7);
  EXPECT_THROW(choose_stepping(Chebyshev{}, *growing.system, 0.0, times), Error);
  problem.cracks.clear();
  problem.numerics.precision = Precision::single;
  const Assembly coarse = assemble(problem);
  EXPECT_TRUE(std::holds_alternative<RungeKuttaLegendre>(
      choose_stepping(AutomaticStepping{}, *coarse.system, 0.0, times).stepping));
  EXPECT_THROW(choose_stepping(Chebyshev{}, *coarse.system, 0.0, times), Error);
  EXPECT_THROW(choose_stepping(SteadyState{}, *coarse.system, 0.0, times), Error);
}

TEST(SpectralEstimate, lies_above_the_fastest_rate_and_close_to_it) {
  for (const int dimension : {1, 2, 3}) {
    Problem problem = unit_body(dimension, dimension == 3 ? 12 : 60, 3.0);
    const Assembly assembly = assemble(problem);
    const Grid& grid = assembly.geometry.body.grid;
    // Mirrored everywhere: modes are those of the stencil's symbol, whose largest value is known.
    const double exact = largest_symbol(assembly.geometry.stencil, dimension) / grid.cell_volume();
    const double estimate = estimate_fastest_rate(*assembly.system, grid.size());
    EXPECT_GE(estimate, 0.998 * exact);
    EXPECT_LE(estimate, 1.04 * exact);
  }
}

}  // namespace
}  // namespace peritherm
