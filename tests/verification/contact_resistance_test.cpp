#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "peritherm/geometry/vector.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double kapitza = 0.3;  ///< R

/// Two half-spaces that touch in the plane normal · x = offset, and a flux straight through: the first side lies where
/// normal · x is less.
struct StraightFlux {
  Point normal;
  double offset;
  double first, second;  ///< conductivities
  double flux = 1.5;     ///< from the first to the second

  std::string expression() const {
    const std::string height = fmt::format("({}*x + {}*y + {}*z - {})", normal[0], normal[1], normal[2], offset);
    return fmt::format("{0} <= 1e-9 ? {1}*{0} : {2}*{0} - {3}", height, -flux / first, -flux / second, flux * kapitza);
  }
};

/// A unit body that starts from the steady state; `held` says how faces are held at it.
Problem touching_halves(int dimension, int cells, const StraightFlux& exact) {
  Problem problem = unit_body(dimension, cells, 2.5);
  problem.materials["body"].conductivity = exact.second;
  problem.materials["other"] = {exact.first, 2.0, 3.0};
  Coordinates normal(exact.normal.begin(), exact.normal.begin() + dimension);
  problem.body.regions = {{"other", HalfSpace{normal, exact.offset}, "half"}};
  problem.contacts = {{{"half", "body"}, ContactResistance{kapitza}}};
  problem.initial.temperature = Profile(exact.expression());
  return problem;
}

/// Largest rate at any point, over the fastest that this body knows for a temperature difference of 1.
double relative_rate(March& run) {
  double size = 0.0;
  for (const double rate : run.rates()) size = std::max(size, std::abs(rate));
  return size / run.assembly().system->fastest_rate();
}

TEST(ContactResistance, two_layers_keep_their_exact_steady_state_wherever_they_touch) {
  for (const int dimension : {1, 2, 3}) {
    for (const PointPlacement points : placements) {
      for (const double offset : {0.5, 0.4375, 0.53}) {
        const StraightFlux exact{{1.0, 0.0, 0.0}, offset, 8.0, 1.0};
        Problem problem = touching_halves(dimension, 8, exact);
        problem.body.points = points;
        // Its edges lie on faces, where bonds along the faces and mirrored ones meet them.
        Coordinates corner(static_cast<std::size_t>(dimension), 1.0);
        corner[0] = offset;
        problem.body.regions[0].shape = Box{Coordinates(corner.size(), 0.0), corner};
        set_face(problem, Face::x_min, held_at(Profile(exact.expression())));
        set_face(problem, Face::x_max, held_at(Profile(exact.expression())));
        March run(problem);
        // The jump is R q: any other would leave rates beside the surface. Flux and its account are exact as well.
        EXPECT_LE(relative_rate(run), rounding(100, 1.0)) << dimension << ", " << offset;
        EXPECT_NEAR(run.heat_rates()[0], exact.flux, rounding(1000, exact.flux));
        EXPECT_NEAR(run.heat_rates()[1], -exact.flux, rounding(1000, exact.flux));
        for (const Point& flux : run.flux()) ASSERT_NEAR(flux[0], exact.flux, rounding(1000, exact.flux));
      }
    }
  }
}

TEST(ContactResistance, halves_that_touch_in_any_plane_keep_their_exact_steady_state) {
  const Point normals[] = {{0.8, 0.6, 0.0}, {std::sqrt(0.5), std::sqrt(0.5), 0.0}, {0.48, -0.6, 0.64}};
  for (const Point& normal : normals) {
    const int dimension = normal[2] == 0.0 ? 2 : 3;
    const StraightFlux exact{normal, 0.5 * (normal[0] + normal[1] + normal[2]), 2.0, 2.0};
    Problem problem = touching_halves(dimension, 9, exact);
    // Mirrors would turn the plane: the exact temperatures are given as far as bonds reach instead.
    set_all_faces(problem, held_at(Profile(exact.expression()), Imposed::inner));
    March run(problem);
    EXPECT_LE(relative_rate(run), rounding(100, 1.0)) << normal[0];
  }
}

TEST(ContactResistance, layers_find_the_steady_jump_from_elsewhere) {
  for (const int dimension : {1, 2}) {
    const StraightFlux exact{{1.0, 0.0, 0.0}, 0.5, 8.0, 1.0};
    Problem problem = touching_halves(dimension, 12, exact);
    problem.initial.temperature = 0.0;
    set_face(problem, Face::x_min, held_at(Profile(exact.expression())));
    set_face(problem, Face::x_max, held_at(Profile(exact.expression())));
    problem.time.integrator = SteadyState{};
    March run(problem);
    run.advance_to(1.0);
    const double below = run.temperatures()[5] - exact.flux / exact.first / 24.0;
    const double above = run.temperatures()[6] + exact.flux / exact.second / 24.0;
    // What the solver leaves of the rates, and what adds up across the layers.
    EXPECT_NEAR(below - above, exact.flux * kapitza, rounding(100, exact.flux)) << dimension;
  }
}

constexpr double ball_radius = 0.25;

/// A disc with R on its surface, in a gradient along x that is 1 far away: T = a x inside, x (1 + b/r²) outside.
std::string disc_in_gradient(double inner, double outer) {
  const double inside = 2.0 / (1.0 + inner / outer + kapitza * inner / ball_radius);
  const double dipole = (1.0 - inside * inner / outer) * ball_radius * ball_radius;
  return fmt::format("(x-0.5)*({0} <= {1} ? {2} : 1 + {3}/{0})", "((x-0.5)^2+(y-0.5)^2)", ball_radius * ball_radius,
                     inside, dipole);
}

/// A flux of 1 at the surface of a disc, straight out everywhere: T = -(a/k) ln(r/a), and R more inside.
std::string radial_flux(double inner, double outer) {
  return fmt::format("{0} <= {1} ? {2}*ln({0}/{1}) + {3} : {4}*ln({0}/{1})", "((x-0.5)^2+(y-0.5)^2)",
                     ball_radius * ball_radius, -0.5 * ball_radius / inner, kapitza, -0.5 * ball_radius / outer);
}

/// Held at the exact temperatures as far in as bonds reach from the faces, and in the middle.
double disc_error(const std::string& exact, double inner, double outer, int cells, bool hold_middle) {
  Problem problem = unit_body(2, cells, 2.0);
  problem.materials["body"].conductivity = outer;
  problem.materials["disc"] = {inner, 1.0, 1.0};
  problem.body.regions = {{"disc", Ball{{0.5, 0.5}, ball_radius}}};
  problem.contacts = {{{"disc", "body"}, ContactConductance{1.0 / kapitza}}};
  set_all_faces(problem, held_at(Profile(exact), Imposed::inner));
  if (hold_middle) problem.boundaries.push_back({std::nullopt, Ball{{0.5, 0.5}, 0.1}, held_at(Profile(exact))});
  problem.initial.temperature = Profile(exact);
  problem.time.integrator = SteadyState{};
  March run(problem);
  run.advance_to(1.0);
  CompiledProfile profile{Profile(exact)};
  return run.relative_error([&profile](const Point& x) { return profile(x, 0.0); });
}

double disc_order(const std::string& exact, double inner, double outer, bool hold_middle, std::vector<int> all_cells) {
  std::vector<double> spacings, errors;
  for (const int cells : all_cells) {
    spacings.push_back(1.0 / cells);
    errors.push_back(disc_error(exact, inner, outer, cells, hold_middle));
  }
  return order_of_convergence(spacings, errors);
}

TEST(ContactResistance, around_a_disc_in_a_gradient_is_met_with_first_order) {
  // Bonds across carry less along the surface than the material does: an error in proportion to the horizon.
  for (const double inner : {0.25, 1.0, 10.0}) {
    EXPECT_NEAR(disc_order(disc_in_gradient(inner, 1.0), inner, 1.0, false, {40, 80, 160}), 1.0, 0.1) << inner;
  }
}

TEST(ContactResistance, around_a_disc_is_met_with_more_than_first_order_by_a_flux_straight_out) {
  // Without a flux along the surface the curvature is left, of second order, and how the grid happens to lie.
  for (const double inner : {0.25, 1.0, 10.0}) {
    EXPECT_GT(disc_order(radial_flux(inner, 1.0), inner, 1.0, true, {80, 160}), 1.5) << inner;
  }
}

/// The slowest mode of two layers that touch at x = 1/2 with resistance R, their far ends held at 0.
struct DecayingMode {
  double first = 1.0, second = 0.25;           ///< conductivities
  double first_heat = 1.0, second_heat = 2.0;  ///< ρ c
  double resistance = 0.5;
  double rate = 0.0;

  double wave(double conductivity, double heat) const { return std::sqrt(rate * heat / conductivity); }
  double mismatch() const {
    const double b1 = wave(first, first_heat), b2 = wave(second, second_heat);
    return (std::sin(0.5 * b1) + resistance * first * b1 * std::cos(0.5 * b1)) * second * b2 * std::cos(0.5 * b2) +
           std::sin(0.5 * b2) * first * b1 * std::cos(0.5 * b1);
  }
  void solve() {
    double low = 0.1, high = 0.1;
    rate = low;
    const bool sign = mismatch() > 0.0;
    while ((mismatch() > 0.0) == sign) rate = high += 0.1;
    for (int k = 0; k < 60; ++k) {
      rate = 0.5 * (low + high);
      ((mismatch() > 0.0) == sign ? low : high) = rate;
    }
  }
  double operator()(double x, double t) const {
    const double b1 = wave(first, first_heat), b2 = wave(second, second_heat);
    const double decay = std::exp(-rate * t) / std::sin(0.5 * b1);
    if (x < 0.5) return decay * std::sin(b1 * x);
    return -decay * first * b1 * std::cos(0.5 * b1) / (second * b2 * std::cos(0.5 * b2)) * std::sin(b2 * (1.0 - x));
  }
  std::string expression() const {
    const double b1 = wave(first, first_heat), b2 = wave(second, second_heat);
    return fmt::format("x < 0.5 ? {}*sin({}*x) : {}*sin({}*(1-x))", 1.0 / std::sin(0.5 * b1), b1,
                       (*this)(0.75, 0.0) / std::sin(0.25 * b2), b2);
  }
};

double mode_error(const DecayingMode& mode, int cells, double ratio, PointPlacement points) {
  Problem problem = unit_body(1, cells, ratio);
  problem.body.points = points;
  problem.materials["body"] = {mode.first, mode.first_heat, 1.0};
  problem.materials["film"] = {mode.second, mode.second_heat, 1.0};
  problem.body.regions = {{"film", Box{{0.5}, {1.0}}}};
  problem.contacts = {{{"film", "body"}, ContactResistance{mode.resistance}}};
  problem.initial.temperature = Profile(mode.expression());
  set_all_faces(problem, held_at(0.0));
  March run(problem);
  run.advance_to(0.2);
  return run.relative_error([&](const Point& x) { return mode(x[0], 0.2); });
}

TEST(ContactResistance, two_layers_cool_with_second_order_if_they_touch_between_points) {
  for (const double resistance : {0.0, 0.5}) {
    DecayingMode mode;
    mode.resistance = resistance;
    mode.solve();
    for (const PointPlacement points : placements) {
      std::vector<double> spacings, errors;
      for (const int cells : {40, 80, 160}) {
        spacings.push_back(1.0 / cells);
        errors.push_back(mode_error(mode, cells, 3.0, points));
      }
      // The cell of a point on the surface belongs to one side as a whole, which moves the surface by half a cell.
      const double order = points == PointPlacement::centres ? 2.0 : 1.0;
      EXPECT_NEAR(order_of_convergence(spacings, errors), order, 0.1) << name_of(points) << ", R = " << resistance;
    }
  }
}

}  // namespace
}  // namespace peritherm
