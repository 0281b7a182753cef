#include "peritherm/solutions/exact_solution.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "peritherm/base/error.hpp"
#include "peritherm/solutions/classical.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

const double exact_rounding = rounding(20, 100.0);
constexpr double printed_8 = 0.5e-8;  ///< of values printed to eight decimals

TEST(ExactSolution, examples_of_2010_have_their_known_values) {
  // In SI: centimetres are 0.01 m.
  EXPECT_NEAR(temperature(HeldEnds{0.1, 1.14e-4, 100.0, 0.0}, {0.05, 0.0, 0.0}, 8.0), 51.74760039, printed_8);
  const SteppedStart stepped{0.1, 1.14e-4, 60.0, 0.0, 0.05, 100.0};
  EXPECT_NEAR(temperature(stepped, {0.05, 0.0, 0.0}, 8.0), 53.06258753, printed_8);
  const double length = 0.01 * std::numbers::pi;
  const HeldAndGradient gradient{length, 1.14e-4, 0.0, 20.0, 300.0};
  EXPECT_NEAR(temperature(gradient, {0.5 * length, 0.0, 0.0}, 4.0), 17.22580451, printed_8);
  EXPECT_NEAR(temperature(gradient, {length, 0.0, 0.0}, 8.0), 26.03873825, printed_8);
}

TEST(ExactSolution, examples_of_2012_have_their_known_values) {
  const HeldBox plate{{0.01, 0.01}, 1.14e-4, 40.0, 0.0};
  EXPECT_NEAR(temperature(plate, {0.005, 0.005, 0.0}, 0.025), 34.41233124, printed_8);
  EXPECT_NEAR(temperature(plate, {0.0025, 0.005, 0.0}, 0.025), 26.09252685, printed_8);
  EXPECT_NEAR(temperature(plate, {0.001, 0.005, 0.0}, 0.025), 12.0399715, 0.5e-7);
  const HeldAndInsulated heated{0.01, 1e-4, 0.0, 1.0};
  EXPECT_NEAR(temperature(heated, {0.0025, 0.003, 0.0}, 0.05), 0.42919533, printed_8);
  EXPECT_NEAR(temperature(heated, {0.01, 0.003, 0.0}, 0.2), 0.22768839, printed_8);
  const SlitInSquare slit{0.02, 0.01, -100.0, 100.0, {0.0, 0.0}};
  EXPECT_NEAR(temperature(slit, {0.0, 0.0, 0.0}, 0.5), 45.85248204, printed_8);
  EXPECT_NEAR(temperature(slit, {0.01, 0.005, 0.0}, 0.5), 54.14751796, printed_8);
  EXPECT_NEAR(temperature(slit, {0.0, -0.0025, 0.0}, 0.5), -51.18306506, printed_8);
}

TEST(ExactSolution, bars_of_2021_have_their_known_values) {
  const auto classical = [](double x, double t) {
    return temperature(HeldEnds{0.1, 1e-3, 100.0, 0.0}, {x, 0.0, 0.0}, t);
  };
  EXPECT_NEAR(classical(0.011875, 0.1), 59.89173861, printed_8);
  EXPECT_NEAR(classical(0.05, 0.1), 99.91860960, printed_8);
  EXPECT_NEAR(classical(0.011875, 0.5), 28.78062217, printed_8);
  EXPECT_NEAR(classical(0.05, 0.3), 91.75463352, printed_8);
  EXPECT_NEAR(classical(0.05, 0.42), 83.10045752, printed_8);
  EXPECT_NEAR(classical(0.05, 0.5), 77.23116069, printed_8);
  EXPECT_NEAR(temperature(NonlocalHeldEnds{0.1, 1e-3, 0.01, 100.0, 0.0}, {0.05, 0.0, 0.0}, 0.5), 77.27949332,
              printed_8);
  const LayeredBar four{{0.025, 0.0125, 0.0375, 0.025}, {1e3, 1e2, 1e3, 1e2}, {1e6, 1e6, 1e6, 1e6}, {100.0}, 0.0, 0.0};
  EXPECT_NEAR(temperature(four, {0.05, 0.0, 0.0}, 2.0), 77.20053110, printed_8);
}

TEST(ExactSolution, layers_in_contact_have_their_known_values) {
  RampedLayers jeffreys;
  jeffreys.lengths = {0.5, 0.5};
  jeffreys.conductivities = {1.0, 0.25};
  jeffreys.heat_capacities = {1.0, 2.0};
  jeffreys.relaxation_times = {0.1, 0.2};
  jeffreys.fourier_shares = {0.3, 0.1};
  jeffreys.resistances = {0.5};
  jeffreys.rise_time = 0.05;
  jeffreys.held = 30.0;
  jeffreys.start = 20.0;
  EXPECT_NEAR(temperature(jeffreys, {0.25, 0.0, 0.0}, 0.6), 20.0 + 8.9303941, 0.6e-7);
  EXPECT_NEAR(temperature(jeffreys, {0.75, 0.0, 0.0}, 0.6), 20.0 + 1.1547490, 0.6e-7);
  LayeredBar step{{0.5, 0.5}, {1.0, 0.25}, {1.0, 2.0}, {0.0}, 1.0, 0.0};
  EXPECT_NEAR(temperature(step, {0.25, 0.0, 0.0}, 0.1), 0.59130487, printed_8);
  EXPECT_NEAR(temperature(step, {0.5, 0.0, 0.0}, 0.1), 0.30861088, printed_8);
  EXPECT_NEAR(temperature(step, {0.75, 0.0, 0.0}, 0.1), 0.00814368, printed_8);
  EXPECT_NEAR(temperature(step, {0.25, 0.0, 0.0}, 0.5), 0.84219562, printed_8);
  EXPECT_NEAR(temperature(step, {0.5, 0.0, 0.0}, 0.5), 0.69568801, printed_8);
  EXPECT_NEAR(temperature(step, {0.75, 0.0, 0.0}, 0.5), 0.25077079, printed_8);
  step.resistances = {0.75};
  EXPECT_NEAR(temperature(step, {0.49999999999, 0.0, 0.0}, 100.0), 1.0 - 0.5 / (0.5 + 0.75 + 2.0), 1e-10);
  EXPECT_NEAR(temperature(step, {0.5, 0.0, 0.0}, 100.0), 2.0 / (0.5 + 0.75 + 2.0), 1e-10);
  EXPECT_NEAR(temperature(WaveFront{4.0, 2.0, 0.5, 12.0, 2.0}, {0.5, 0.0, 0.0}, 0.35), 2.0 + 10.0 * 0.78810, 1e-4);
}

TEST(ExactSolution, discs_and_pulses_are_shifted_and_scaled) {
  const Point place{0.6, 0.1, 0.0};
  // Twice as much inside as without a disc, if it conducts nothing but has the resistance of nothing: 2/(1 + 0 + 0).
  const InclusionInGradient disc{0.3, 1e-12, 2.0, 0.0, 5.0, 7.0, {0.5, 0.0}};
  EXPECT_NEAR(temperature(disc, place, 0.0), 7.0 + 5.0 * 2.0 * 0.1, 1e-10);
  const CoaxialRings rings{{0.1, 0.3, 0.7}, {5.0, 5.0}, 0.0, 90.0, 20.0, {0.5, 0.0}};
  const double radius = std::hypot(0.1, 0.1);
  EXPECT_NEAR(temperature(rings, place, 0.0), 90.0 - 70.0 * std::log(radius / 0.1) / std::log(7.0), 1e-12);
  PulsedLayers pulse;
  pulse.lengths = {0.1, 0.4};
  pulse.conductivities = {2.0, 1.0};
  pulse.heat_capacities = {3.0, 1.0};
  pulse.energy = 1.4;
  pulse.pulse_time = 0.01;
  pulse.start = 3.0;
  EXPECT_NEAR(temperature(pulse, {0.3, 0.0, 0.0}, 20.0), 3.0 + 1.4 / 0.7, 1e-9);
}

TEST(ExactSolution, start_and_held_temperatures_are_shifted_and_scaled) {
  const Point place{0.3, 0.0, 0.0};
  const double share = slab_with_held_ends({1.0, 2.0}, 0.3, 0.02);
  EXPECT_NEAR(temperature(HeldEnds{1.0, 2.0, 70.0, 20.0}, place, 0.02), 20.0 + 50.0 * share, exact_rounding);
  const double heated = slab_with_prescribed_gradient({1.0, 2.0}, 15.0, 4.0, 0.3, 0.02);
  EXPECT_NEAR(temperature(HeldAndGradient{1.0, 2.0, 5.0, 20.0, 4.0}, place, 0.02), 5.0 + heated, exact_rounding);
  EXPECT_NEAR(temperature(LumpedBody{100.0, 20.0, 0.01}, place, 100.0 * std::numbers::ln2), 60.0, exact_rounding);
  const SlitInGradient slit{1.0, 30.0, 5.0, {0.3, 2.0}};
  EXPECT_NEAR(temperature(slit, {0.3, 2.0, 0.0}, 0.0), 5.0 + 30.0 * 0.5, exact_rounding);
}

/// α (∂²/∂x² + ∂²/∂y²) T − ∂T/∂t by central differences, over the size of its terms.
double residual(const ExactSolution& solution, double diffusivity, const Point& place, double time) {
  const TemperatureAt value = make_temperature(solution);
  const double h = 1e-3;
  const double tau = 1e-4 * time;
  const double middle = value(place, time);
  double laplacian = 0.0;
  for (const std::size_t axis : {0U, 1U}) {
    Point before = place;
    Point after = place;
    before[axis] -= h;
    after[axis] += h;
    laplacian += (value(before, time) - 2.0 * middle + value(after, time)) / (h * h);
  }
  const double rate = (value(place, time + tau) - value(place, time - tau)) / (2.0 * tau);
  return (diffusivity * laplacian - rate) / std::max(1.0, std::abs(rate));
}

TEST(ExactSolution, local_solutions_satisfy_the_heat_equation) {
  // Fourth derivatives of these times h²/12 = 1e-7 stay below 1e-4, as do third ones in time.
  const Point place{0.31, 0.42, 0.0};
  for (const double time : {0.02, 0.3}) {
    EXPECT_NEAR(residual(HeldEnds{1.0, 0.5, 10.0, 2.0}, 0.5, place, time), 0.0, 1e-4);
    EXPECT_NEAR(residual(HeldAndInsulated{1.0, 0.5, 0.0, 10.0}, 0.5, place, time), 0.0, 1e-4);
    EXPECT_NEAR(residual(SteppedStart{1.0, 0.5, 6.0, 0.0, 0.5, 10.0}, 0.5, place, time), 0.0, 1e-4);
    EXPECT_NEAR(residual(HeldAndGradient{1.0, 0.5, 1.0, 5.0, 3.0}, 0.5, place, time), 0.0, 1e-4);
    EXPECT_NEAR(residual(HeldBox{{1.0, 0.8}, 0.5, 10.0, 2.0}, 0.5, place, time), 0.0, 1e-4);
    const LayeredBar layers{{0.2, 0.5}, {1.0, 2.0}, {1.0, 4.0}, {10.0, 3.0}, 1.0, 7.0};
    EXPECT_NEAR(residual(layers, 0.5, place, time), 0.0, 1e-4);
    EXPECT_NEAR(residual(SlitInSquare{2.0, 1.0, -1.0, 1.0, {0.0, 0.0}}, 1.0, place, time), 0.0, 1e-4);
    EXPECT_NEAR(residual(SlitInGradient{1.0, 1.0, 0.0, {0.0, 0.0}}, 1.0, place, time), 0.0, 1e-4);
  }
}

TEST(ExactSolution, gradients_are_derivatives_of_temperatures) {
  const double h = 1e-4;
  for (const ExactSolution& solution :
       {ExactSolution(HeldEnds{1.0, 0.5, 10.0, 2.0}), ExactSolution(HeldAndInsulated{1.0, 0.5, 0.0, 10.0}),
        ExactSolution(SteppedStart{1.0, 0.5, 6.0, 0.0, 0.5, 10.0}),
        ExactSolution(HeldAndGradient{1.0, 0.5, 1.0, 5.0, 3.0}), ExactSolution(HeldBox{{1.0, 0.8}, 0.5, 10.0, 2.0})}) {
    for (const double time : {0.01, 0.1, 0.5}) {
      for (const double x : {0.1, 0.5, 0.9}) {
        const auto value = [&solution, time](double place) { return temperature(solution, {place, 0.3, 0.0}, time); };
        const double difference = (value(x + h) - value(x - h)) / (2.0 * h);
        // Third derivatives are below 10 (2αt)^(−3/2) = 1e4.
        EXPECT_NEAR(gradient_along_x(solution, {x, 0.3, 0.0}, time), difference, 1e4 * h * h / 6.0 + exact_rounding / h)
            << x << ", " << time;
      }
    }
  }
  EXPECT_DOUBLE_EQ(gradient_along_x(HeldAndGradient{1.0, 0.5, 1.0, 5.0, 3.0}, {1.0, 0.0, 0.0}, 0.01), 3.0);
  EXPECT_THROW(gradient_along_x(LumpedBody{1.0, 0.0, 1.0}, {}, 1.0), Error);
}

TEST(ExactSolution, places_beyond_the_body_are_refused_but_for_rounding) {
  const HeldEnds held{1.0, 1.0, 1.0, 0.0};
  EXPECT_THROW(temperature(held, {1.1, 0.0, 0.0}, 0.1), Error);
  EXPECT_THROW(temperature(held, {-0.1, 0.0, 0.0}, 0.1), Error);
  EXPECT_NEAR(temperature(held, {1.0 + 1e-12, 0.0, 0.0}, 0.1), 0.0, exact_rounding);
  EXPECT_NEAR(temperature(SlitInSquare{2.0, 1.0, -1.0, 1.0, {0.0, 0.0}}, {1.0 + 1e-12, 1.0 + 1e-12, 0.0}, 0.0), 1.0,
              exact_rounding);
}

TEST(ExactSolution, faults_of_options_are_named) {
  EXPECT_EQ(find_fault(HeldEnds{1.0, 1.0, 1.0, 0.0}, 1), "");
  EXPECT_EQ(find_fault(SteppedStart{1.0, 1.0, 1.0, 0.0, 2.0, 0.0}, 1), "has its step beyond the end of the bar");
  EXPECT_EQ(find_fault(LayeredBar{{1.0, 1.0}, {1.0}, {1.0, 1.0}, {0.0}, 0.0, 0.0}, 1),
            "has 2 lengths, 1 conductivities and 2 heat_capacities");
  EXPECT_EQ(find_fault(LayeredBar{{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}, {0.0, 1.0, 2.0}, 0.0, 0.0}, 1),
            "needs one start for all layers or one for each");
  LayeredBar contacts{{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}, {0.0}, 0.0, 0.0};
  contacts.resistances = {0.1, 0.2};
  EXPECT_EQ(find_fault(contacts, 1), "has 2 lengths and 2 resistances, which must be one less");
  RampedLayers ramped;
  ramped.lengths = {1.0};
  ramped.conductivities = {1.0};
  ramped.heat_capacities = {1.0};
  ramped.relaxation_times = {1.0, 2.0};
  EXPECT_EQ(find_fault(ramped, 1), "needs relaxation_times and fourier_shares for all layers or for none");
  EXPECT_EQ(find_fault(CoaxialRings{{1.0, 2.0}, {1.0, 1.0}, 0.0, 1.0, 0.0, {0.0, 0.0}}, 2),
            "needs three radii and two conductivities");
  EXPECT_EQ(find_fault(CoaxialRings{{1.0, 3.0, 2.0}, {1.0, 1.0}, 0.0, 1.0, 0.0, {0.0, 0.0}}, 2),
            "has radii that do not grow");
  EXPECT_EQ(find_fault(InclusionInGradient{}, 1), "is of a plate, but the body is 1-D");
  EXPECT_EQ(find_fault(HeldBox{{1.0, 1.0}, 1.0, 1.0, 0.0}, 3), "has 2 lengths, but the body is 3-D");
  EXPECT_EQ(find_fault(SlitInSquare{1.0, 2.0, 0.0, 1.0, {0.0, 0.0}}, 2), "has a slit that cuts all of the square");
  EXPECT_EQ(find_fault(SlitInGradient{1.0, 2.0, 0.0, {0.0, 0.0}}, 1), "has a slit, which a 1-D body cannot have");
  EXPECT_THROW(make_temperature(LayeredBar{}), Error);
}

TEST(ExactSolution, a_layer_that_needs_too_many_modes_is_refused) {
  EXPECT_THROW(temperature(LayeredBar{{1.0, 1e-7}, {1.0, 1.0}, {1.0, 1.0}, {1.0}, 0.0, 0.0}, {0.5, 0.0, 0.0}, 1.0),
               Error);
}

}  // namespace
}  // namespace peritherm
