#include <gtest/gtest.h>

#include <cmath>

#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double wall_conductivity = 50.0, wall_capacity = 100.0, hot_side = 1000.0, cold_side = 300.0;
/// σ / (1/0.8 + 1/0.6 − 1) [W/(m² K⁴)].
constexpr double radiated = 5.670374419e-8 / (1.0 / 0.8 + 1.0 / 0.6 - 1.0);

/// A wall of thickness 1, parted at a place, whose halves see each other.
Problem parted_wall(int dimension, int cells, double place) {
  Problem problem = unit_body(dimension, cells, dimension == 3 ? 2.0 : 3.0);
  problem.materials["body"] = {wall_conductivity, 1.0, wall_capacity};
  problem.initial.temperature = Profile("300");
  set_face(problem, Face::x_min, held_at(hot_side));
  set_face(problem, Face::x_max, held_at(cold_side));
  Crack& crack = problem.cracks.emplace_back();
  if (dimension == 1) crack.points = {{place}};
  if (dimension == 2) crack.points = {{place, 0.0}, {place, 1.0}};
  if (dimension == 3) crack.points = {{place, 0, 0}, {place, 1, 0}, {place, 1, 1}, {place, 0, 1}};
  crack.gap = GapRadiation{{0.8, 0.6}, {}, 0.0};
  return problem;
}

/// Root of a falling function, by Newton's method.
template <class Value, class Slope>
double root_near(const Value& value, const Slope& slope, double start) {
  for (int k = 0; k < 50; ++k) start -= value(start) / slope(start);
  return start;
}

/// Flux between places at temperatures a and b, a distance before and one behind the gap [W/m²].
double flux_between(double a, double before, double b, double behind) {
  const auto first = [=](double q) { return a - q * before / wall_conductivity; };
  const auto second = [=](double q) { return b + q * behind / wall_conductivity; };
  return root_near([=](double q) { return radiated * (std::pow(first(q), 4) - std::pow(second(q), 4)) - q; },
                   [=](double q) {
                     return -4.0 * radiated / wall_conductivity *
                                (before * std::pow(first(q), 3) + behind * std::pow(second(q), 3)) -
                            1.0;
                   },
                   0.0);
}

TEST(RadiatingGap, passes_what_the_fourth_powers_say) {
  for (const int dimension : {1, 2, 3}) {
    const double place = 0.5, flux = flux_between(hot_side, place, cold_side, 1.0 - place);
    Problem problem = parted_wall(dimension, dimension == 3 ? 8 : 20, place);
    problem.time.integrator = SteadyState{};
    March run(problem);
    run.advance_to(1.0);
    const std::vector<double> values = run.temperatures();
    for (std::size_t n = 0; n < values.size(); ++n) {
      const double x = run.position(n)[0];
      const double exact =
          x < place ? hot_side - flux * x / wall_conductivity : cold_side + flux * (1.0 - x) / wall_conductivity;
      // As with a given coefficient fits stop at 1e-9 of what flows (1e-6 in 3-D). Cubic interpolation between them
      // leaves 1.3e-7 here, and less than half of that with two thirds of the distance between fits.
      EXPECT_NEAR(values[n], exact, (dimension == 3 ? 1e-6 : 2e-7) * (hot_side - cold_side)) << dimension << ' ' << x;
    }
  }
}

/// Classical temperatures of the wall, by finite volumes and Heun's method.
std::vector<double> classical_wall(int cells, int before, double time) {
  const double width = 1.0 / cells, conductance = wall_conductivity / width;
  const double rate = 1.0 / (wall_capacity * width);
  const auto count = static_cast<std::size_t>(cells), gap = static_cast<std::size_t>(before);
  const auto rates = [&](const std::vector<double>& now) {
    std::vector<double> fluxes(count + 1);
    fluxes.front() = 2.0 * conductance * (hot_side - now.front());
    for (std::size_t n = 1; n < count; ++n) fluxes[n] = conductance * (now[n - 1] - now[n]);
    fluxes[gap] = flux_between(now[gap - 1], 0.5 * width, now[gap], 0.5 * width);
    fluxes.back() = 2.0 * conductance * (now.back() - cold_side);
    std::vector<double> result(count);
    for (std::size_t n = 0; n < count; ++n) result[n] = rate * (fluxes[n] - fluxes[n + 1]);
    return result;
  };
  std::vector<double> state(count, cold_side);
  const auto steps = static_cast<int>(std::ceil(time * 2.5 * conductance * rate));
  const double step = time / steps;
  for (int k = 0; k < steps; ++k) {
    const std::vector<double> first = rates(state);
    std::vector<double> next = state;
    for (std::size_t n = 0; n < count; ++n) next[n] += step * first[n];
    const std::vector<double> second = rates(next);
    for (std::size_t n = 0; n < count; ++n) state[n] += 0.5 * step * (first[n] + second[n]);
  }
  return state;
}

TEST(RadiatingGap, warms_the_other_side_at_second_order) {
  const double time = 0.3;
  // An odd multiple of the cells of either run, so that its middles are among the reference's.
  const std::vector<double> reference = classical_wall(360, 144, time);
  double errors[2] = {};
  for (const int level : {0, 1}) {
    const int cells = 20 << level;
    Problem problem = parted_wall(1, cells, 0.4);
    problem.time.end = time;
    March run(problem);
    run.advance_to(time);
    const std::vector<double> values = run.temperatures();
    for (int n = 0; n < cells; ++n) {
      const double at = (n + 0.5) * 360 / cells;
      const auto beside = static_cast<std::size_t>(at);
      const double right = 0.5 * (reference[beside] + reference[at == std::floor(at) ? beside - 1 : beside]);
      errors[level] = std::max(errors[level], std::abs(values[static_cast<std::size_t>(n)] - right));
    }
  }
  EXPECT_LT(errors[1], 1e-3 * (hot_side - cold_side));
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
}

/// Two insulated halves on either side of a slanted crack, in degrees Celsius.
Problem two_halves(BackendName backend) {
  Problem problem = unit_body(2, 24, 3.0);
  problem.materials["body"] = {wall_conductivity, 1.0, wall_capacity};
  problem.numerics.backend = backend;
  problem.initial.temperature = Profile("y > 0.3 + 0.3*x ? 1000 + 50*x : 20");
  Crack& crack = problem.cracks.emplace_back();
  crack.points = {{0.0, 0.3}, {1.0, 0.6}};
  crack.gap = GapRadiation{{0.9, 0.9}, {}, -273.15};
  problem.time.end = 20.0;
  return problem;
}

TEST(RadiatingGap, keeps_all_heat_until_both_sides_are_alike) {
  for (const BackendName backend : {BackendName::stencil, BackendName::bond}) {
    March run(two_halves(backend));
    const double before = run.stored_heat();
    run.advance_to(20.0);
    const std::size_t sums = 28 * static_cast<std::size_t>(run.count().evaluations);
    EXPECT_NEAR(run.stored_heat(), before, rounding(sums, before));
    const double mean = before / wall_capacity;
    for (const double value : run.temperatures()) EXPECT_NEAR(value, mean, 1e-3 * mean);
  }
}

TEST(RadiatingGap, with_small_differences_follows_the_linear_law) {
  std::vector<double> values[2];
  for (const bool linear : {false, true}) {
    Problem problem = two_halves(BackendName::stencil);
    problem.initial.temperature = Profile("500 + (y > 0.3 + 0.3*x ? 0.5 : -0.5)");
    problem.cracks[0].gap = linear ? GapRadiation{{0.9, 0.9}, 500.0, 0.0} : GapRadiation{{0.9, 0.9}, {}, 0.0};
    problem.time.end = 0.2;
    problem.time.integrator = RungeKuttaLegendre{1e-8};
    March run(problem);
    run.advance_to(0.2);
    values[linear] = run.temperatures();
  }
  for (std::size_t n = 0; n < values[0].size(); ++n) {
    // Half a kelvin moves the third power of the mean by 3e-3 at most, where only one side has changed yet.
    EXPECT_NEAR(values[0][n], values[1][n], 3e-3) << n;
  }
}

TEST(RadiatingGap, needs_temperatures_above_absolute_zero) {
  Problem problem = two_halves(BackendName::stencil);
  problem.initial.temperature = Profile("y > 0.5 ? 20 : -300");
  March run(problem);
  EXPECT_THROW(
      {
        try {
          run.advance_to(1.0);
        } catch (const Error& error) {
          const std::string text = error.what();
          EXPECT_NE(text.find("crack.0.gap: a face at"), std::string::npos) << text;
          EXPECT_NE(text.find("colder than absolute zero"), std::string::npos) << text;
          throw;
        }
      },
      Error);
}

TEST(RadiatingGap, carries_a_given_flux_from_any_start) {
  for (const double length : {0.01, 0.2}) {
    for (const double flux : {500.0, 10000.0}) {
      Problem problem = unit_body(1, 20, 3.0);
      problem.body.size = {length};
      problem.materials["body"] = {15.0, 1.0, 1.0};
      set_face(problem, Face::x_min, PrescribedFlux{flux});
      set_face(problem, Face::x_max, held_at(cold_side));
      Crack& crack = problem.cracks.emplace_back();
      crack.points = {{0.5 * length}};
      crack.gap = GapRadiation{{0.8, 0.6}, {}, 0.0};
      problem.time.integrator = SteadyState{};
      March run(problem);
      run.advance_to(1.0);
      const double rise = flux * 0.5 * length / 15.0, beyond = cold_side + rise;
      const double before = std::pow(std::pow(beyond, 4) + flux / radiated, 0.25);
      // The fit stops at 1e-9 of the share, which is 1e-7 of what a gap this weak lets through.
      EXPECT_NEAR(run.temperatures().front(), before + 0.95 * rise, 1e-6 * before) << length << ' ' << flux;
    }
  }
}

TEST(RadiatingGap, lets_copper_blocks_cool_like_lumps) {
  Problem problem = unit_body(1, 20, 3.0);
  problem.materials["body"] = {1e7, 1.0, wall_capacity};
  problem.initial.temperature = Profile("x < 0.5 ? 1000 : 300");
  Crack& crack = problem.cracks.emplace_back();
  crack.points = {{0.5}};
  crack.gap = GapRadiation{{0.8, 0.6}, {}, 0.0};
  problem.time.end = 0.5;
  March run(problem);
  run.advance_to(0.5);
  double hot = hot_side, cold = cold_side;
  const int steps = 10000;
  const auto rate = [](double a, double b) {
    return radiated * (std::pow(a, 4) - std::pow(b, 4)) / (0.5 * wall_capacity);
  };
  for (int k = 0; k < steps; ++k) {
    const double step = 0.5 / steps, first = step * rate(hot, cold),
                 half = step * rate(hot - 0.5 * first, cold + 0.5 * first);
    hot -= half;
    cold += half;
  }
  EXPECT_LT(hot, 0.9 * hot_side);
  // Intervals leave 1e-5 of the temperature, three times as much of what passes.
  EXPECT_NEAR(run.temperatures().front(), hot, 3e-5 * hot_side);
}

/// Points beside the gap are held at 300 until a time and at 1000 from then on.
double behind_the_gap(const std::string& held, double time) {
  Problem problem = unit_body(1, 20, 3.0);
  problem.materials["body"] = {wall_conductivity, 1.0, wall_capacity};
  problem.initial.temperature = Profile("300");
  problem.boundaries.push_back({std::nullopt, Shape{Box{{0.0}, {0.45}}}, held_at(Profile(held))});
  Crack& crack = problem.cracks.emplace_back();
  crack.points = {{0.5}};
  crack.gap = GapRadiation{{1.0, 1.0}, {}, 0.0};
  problem.time.end = 1.0;
  problem.time.integrator = RungeKuttaLegendre{1e-6};
  March run(problem);
  run.advance_to(time);
  return run.at({0.6});
}

TEST(RadiatingGap, follows_held_temperatures_that_jump) {
  const double at_once = behind_the_gap("1000", 0.5), late = behind_the_gap("t < 0.5 ? 300 : 1000", 1.0);
  EXPECT_GT(at_once, 500.0);
  // Half of a first step of time passes with 300 or 1000; steps are of 1e-6 of the temperature.
  EXPECT_NEAR(late, at_once, 1e-4 * at_once);
}

TEST(RadiatingGap, is_steady_beside_a_part_that_nothing_holds) {
  double values[2] = {};
  for (const bool uneven : {false, true}) {
    Problem problem = unit_body(2, 16, 3.0);
    problem.materials["body"] = {wall_conductivity, 1.0, wall_capacity};
    problem.initial.temperature = Profile(uneven ? "y < 0.25 ? 300 + 500*x : 800" : "300");
    set_face(problem, Face::y_max, held_at(hot_side));
    problem.boundaries.push_back({std::nullopt, Shape{Box{{0.0, 0.3}, {1.0, 0.4}}}, held_at(cold_side)});
    problem.cracks.emplace_back().points = {{0.0, 0.25}, {1.0, 0.25}};
    Crack& crack = problem.cracks.emplace_back();
    crack.points = {{0.0, 0.6}, {1.0, 0.6}};
    crack.gap = GapRadiation{{0.8, 0.6}, {}, 0.0};
    problem.time.integrator = SteadyState{};
    March run(problem);
    run.advance_to(1.0);
    values[uneven] = run.at({0.5, 0.5});
  }
  EXPECT_NEAR(values[0], values[1], 1e-6 * hot_side);
}

}  // namespace
}  // namespace peritherm
