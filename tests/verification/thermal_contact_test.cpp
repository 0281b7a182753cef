#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "peritherm/papers/xue_2018_cases.hpp"
#include "peritherm/papers/xue_2018_values.hpp"
#include "peritherm/solutions/heat_wave.hpp"
#include "peritherm/solutions/layered_slab.hpp"

namespace peritherm {
namespace {

ContactErrors contact_mode_errors(const LayersOf2018& layers, int cells) {
  const ContactMode mode = mode_of_2018(layers);
  Problem problem = problem_of_2018({layers, cells, 3.0, 1.0, 1});
  start_in(problem, mode, 0.0);
  step_by(problem, layers.mode_end / 400, 1.0, 1.0);
  return errors_of(march_contact({std::move(problem), {layers.mode_end}}), 0, mode);
}

TEST(ThermalContact, modes_of_every_case_are_met_to_second_order) {
  for (const LayersOf2018& layers : layers_of_2018()) {
    const double coarse = contact_mode_errors(layers, 40).temperature;
    const double fine = contact_mode_errors(layers, 80).temperature;
    EXPECT_NEAR(halving_order(coarse, fine), 2.0, 0.2) << layers.name;
  }
}

TEST(ThermalContact, ramps_have_the_digits_of_the_prototype) {
  for (const auto& known : xue_2018_values::ramps) {
    const LayersOf2018& layers = layers_of_2018(std::string(known.name));
    Problem problem = problem_of_2018({layers, 100, 3.0, 1.0, 1});
    drive(problem, ramp_of(layers));
    step_by(problem, 1e-3, 1.0, 0.0, SingleStepStart::consistent);
    const ContactRun run = march_contact({std::move(problem), {known.time}});
    const InterfaceValues& contact = run.contacts[0].front();
    // Printed to eight digits.
    EXPECT_NEAR(contact.first[0], known.values[1], 1e-8) << known.name;
    EXPECT_NEAR(contact.second[0], known.values[2], 1e-8) << known.name;
    EXPECT_NEAR(contact.flux[0], known.values[4], 1e-8) << known.name;
    EXPECT_LT(run.summary.largest_residual, 1e-12) << known.name;
    EXPECT_EQ(run.plan.index, 2);
    EXPECT_EQ(run.plan.multipliers, 3U);
  }
}

TEST(ThermalContact, a_sudden_start_is_met_within_the_discretisation_error) {
  for (const char* name : {"I perfect", "I resistance"}) {
    const LayersOf2018& layers = layers_of_2018(name);
    const LayeredSlab slab({{0.5, 1.0, 1.0, 0.0}, {0.5, 0.25, 2.0, 0.0, layers.second.resistance}}, 1.0, 0.0);
    Problem problem = problem_of_2018({layers, 100, 3.0, 1.0, 1});
    drive(problem, "1");
    step_by(problem, 5e-4, 0.5, 0.0);
    const ContactRun run = march_contact({std::move(problem), {0.1}});
    EXPECT_NEAR(run.contacts[0].front().first[0], slab.temperature_in(0, 0.5, 0.1), 1e-4) << name;
    EXPECT_NEAR(run.contacts[0].front().second[0], slab.temperature_in(1, 0.5, 0.1), 1e-4) << name;
    for (std::size_t i = 0; i < run.grid.size(); ++i) {
      const double x = run.grid.position(run.grid.index(i))[0];
      // The middles of the layers; beside the contact points are farther off than what they say about it.
      if (std::min(std::abs(x - 0.25), std::abs(x - 0.75)) > 0.01) continue;
      EXPECT_NEAR(run.temperatures[0][i], slab.temperature(x, 0.1), 1e-4) << name << ", " << x;
    }
  }
}

TEST(ThermalContact, a_driven_plate_is_met_on_both_sides_of_the_contact) {
  const LayersOf2018& layers = layers_of_2018("I resistance");
  const double wave_number = 2.0 * std::numbers::pi;
  const DrivenLayers mean({layers.first, layers.second}, FarEnd::held, TemperatureRamp{0.5, layers.rise_time});
  const DrivenLayers wave({layers.first, layers.second}, FarEnd::held, TemperatureRamp{0.5, layers.rise_time},
                          wave_number);
  Problem problem = problem_of_2018({layers, 40, 3.015, 1.0, 2});
  drive(problem, "(" + ramp_of(layers) + ")*0.5*(1 + cos(2*pi*y))");
  step_by(problem, 2e-3, 0.5, 0.0);
  const ContactRun run = march_contact({std::move(problem), {0.1}});
  const InterfaceValues& contact = run.contacts[0].front();
  EXPECT_EQ(contact.flux.size(), 40U);
  for (std::size_t i = 0; i < contact.flux.size(); i += 13) {
    const double cosine = std::cos(wave_number * contact.positions[i][1]);
    const auto at = [&](std::size_t layer) {
      return mean.temperature_in(layer, 0.5, 0.1) + cosine * wave.temperature_in(layer, 0.5, 0.1);
    };
    EXPECT_NEAR(contact.first[i], at(0), 2e-4);
    EXPECT_NEAR(contact.second[i], at(1), 2e-4);
    EXPECT_NEAR(contact.flux[i], mean.flux_in(0, 0.5, 0.1) + cosine * wave.flux_in(0, 0.5, 0.1), 2e-4);
  }
  EXPECT_LT(run.summary.largest_residual, 1e-12);
}

TEST(ThermalContact, a_front_arrives_in_time_without_sawtooth) {
  const ContactLayer layer{0.5, 1.0, 1.0, CattaneoLaw{1.0}, 0.0};
  // The default stabilisation of Cattaneo's law.
  Problem problem = problem_of_2018({{"front", layer, layer, 0.0, {}, 0.0}, 100, 3.0, std::nullopt, 1});
  drive(problem, "1");
  step_by(problem, 0.005, 1.0, 0.0);
  const ContactRun run = march_contact({std::move(problem), {0.7}});
  const std::vector<double>& found = run.temperatures[0];
  std::size_t behind = 0;
  double mean = 0.0;
  for (std::size_t i = 1; i + 1 < found.size(); ++i) {
    const double x = run.grid.position(run.grid.index(i))[0];
    mean += std::abs(found[i] - heat_wave(x, 0.7)) / static_cast<double>(found.size());
    if (x < 0.55) {
      // A sawtooth of this amplitude; the curvature of the wake is below 0.2.
      EXPECT_LT(0.25 * std::abs(found[i - 1] - 2.0 * found[i] + found[i + 1]), 1e-3) << x;
    }
    if (found[i] > 0.5 * std::exp(-0.35)) behind = i;
  }
  // The prototype's value to its digits; without stabilisation it is 0.0535, with 1 it is 0.0500.
  EXPECT_NEAR(mean, 0.0299, 5e-4);
  // Half of the front lies where it should, within one horizon.
  EXPECT_NEAR(run.grid.position(run.grid.index(behind))[0], 0.7, 0.015);
  EXPECT_LT(run.summary.lowest, 0.0);
  EXPECT_EQ(run.summary.lowest_given, 0.0);
}

}  // namespace
}  // namespace peritherm
