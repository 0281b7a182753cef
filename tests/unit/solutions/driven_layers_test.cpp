#include "peritherm/solutions/driven_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "peritherm/base/error.hpp"
#include "peritherm/solutions/heat_wave.hpp"
#include "peritherm/solutions/laplace_series.hpp"
#include "peritherm/solutions/layered_slab.hpp"

namespace peritherm {
namespace {

const ContactLayer fourier_first{0.5, 1.0, 1.0, FourierLaw{}, 0.0};
const ContactLayer jeffreys_first{0.5, 1.0, 1.0, JeffreysLaw{0.1, 0.3}, 0.0};
const ContactLayer quick_first{0.5, 10.0, 1.0, FourierLaw{}, 0.0};

ContactLayer fourier_second(double resistance) { return {0.5, 0.25, 2.0, FourierLaw{}, resistance}; }
ContactLayer jeffreys_second(double resistance) { return {0.5, 0.25, 2.0, JeffreysLaw{0.2, 0.1}, resistance}; }
ContactLayer wave_second(double resistance) { return {0.5, 0.1, 1.0, CattaneoLaw{0.5}, resistance}; }

TEST(LaplaceSeries, known_transforms_are_inverted) {
  for (const double t : {1e-3, 0.3, 20.0}) {
    EXPECT_NEAR(invert_laplace_series([](auto s) { return 1.0 / ((s + 1.0) * (s + 1.0)); }, t, 1e-14), t * std::exp(-t),
                1e-12);
    EXPECT_NEAR(invert_laplace_series([](auto s) { return std::exp(-std::sqrt(s)) / s; }, t, 1e-14),
                std::erfc(0.5 / std::sqrt(t)), 1e-12);
  }
}

/// Printed to eight digits: T(.25), T(.5-), T(.5+), T(.75), flux at the contact.
struct PrintedRamp {
  std::string name;
  ContactLayer first;
  ContactLayer second;
  double rise_time;
  double time;
  std::array<double, 5> values;
};

TEST(DrivenLayers, ramps_have_their_known_values) {
  const std::vector<PrintedRamp> known{{"I perfect",
                                        fourier_first,
                                        fourier_second(0.0),
                                        0.05,
                                        0.1,
                                        {0.09350182, 0.02472762, 0.02472762, 0.00010171, 0.11186865}},
                                       {"I perfect",
                                        fourier_first,
                                        fourier_second(0.0),
                                        0.05,
                                        0.5,
                                        {0.79344803, 0.61600616, 0.61600616, 0.16810730, 0.63372322}},
                                       {"I resistance",
                                        fourier_first,
                                        fourier_second(0.5),
                                        0.05,
                                        0.1,
                                        {0.09539212, 0.03489757, 0.01033714, 0.00003439, 0.04912087}},
                                       {"I resistance",
                                        fourier_first,
                                        fourier_second(0.5),
                                        0.05,
                                        0.5,
                                        {0.83502714, 0.69499192, 0.44575252, 0.11168185, 0.49847881}},
                                       {"II perfect",
                                        jeffreys_first,
                                        jeffreys_second(0.0),
                                        0.05,
                                        0.2,
                                        {0.33032600, 0.11838762, 0.11838762, 0.00000070, 0.19979055}},
                                       {"II resistance",
                                        jeffreys_first,
                                        jeffreys_second(0.5),
                                        0.05,
                                        0.2,
                                        {0.33406940, 0.14003060, 0.07561199, 0.00000036, 0.12883724}},
                                       {"II resistance",
                                        jeffreys_first,
                                        jeffreys_second(0.5),
                                        0.05,
                                        0.6,
                                        {0.89303941, 0.78011675, 0.53555342, 0.11547490, 0.48912666}},
                                       {"III perfect",
                                        quick_first,
                                        wave_second(0.0),
                                        0.1,
                                        0.5,
                                        {0.85936003, 0.84890408, 0.84890408, 0.00000000, 0.30582884}},
                                       {"III perfect",
                                        quick_first,
                                        wave_second(0.0),
                                        0.1,
                                        1.0,
                                        {0.99065943, 0.98426594, 0.98426594, 0.47158801, 0.25177651}},
                                       {"III resistance",
                                        quick_first,
                                        wave_second(0.2),
                                        0.1,
                                        0.5,
                                        {0.85985843, 0.84990039, 0.79271443, 0.00000000, 0.28592983}}};
  for (const PrintedRamp& printed : known) {
    const DrivenLayers layers({printed.first, printed.second}, FarEnd::held, TemperatureRamp{1.0, printed.rise_time});
    const double t = printed.time;
    const std::array<double, 5> computed{layers.temperature_in(0, 0.25, t), layers.temperature_in(0, 0.5, t),
                                         layers.temperature_in(1, 0.5, t), layers.temperature(0.75, t),
                                         layers.flux_in(0, 0.5, t)};
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(computed[k], printed.values[k], 0.51e-8) << printed.name << k;
    EXPECT_NEAR(layers.flux_in(1, 0.5, t), computed[4], 1e-12) << printed.name;
    EXPECT_NEAR(layers.quick().temperature(0.75, t), computed[3], 1e-7) << printed.name;
    EXPECT_NEAR(layers.quick().temperature(0.25, t), computed[0], 1e-7) << printed.name;
  }
}

TEST(DrivenLayers, plates_driven_in_part_have_their_known_values) {
  // T(0, y, t) = ramp (1 + cos 2πy)/2, half the sum of two solutions.
  const auto expect_plate = [](const std::vector<ContactLayer>& layers, double rise_time, double t,
                               const std::array<double, 7>& printed) {
    const double wave_number = 2.0 * std::numbers::pi;
    const DrivenLayers mean(layers, FarEnd::held, TemperatureRamp{0.5, rise_time});
    const DrivenLayers wave(layers, FarEnd::held, TemperatureRamp{0.5, rise_time}, wave_number);
    const auto at = [&](std::size_t layer, double x, double y) {
      return mean.temperature_in(layer, x, t) + std::cos(wave_number * y) * wave.temperature_in(layer, x, t);
    };
    const double flux = mean.flux_in(0, 0.5, t) + std::cos(0.1 * wave_number) * wave.flux_in(0, 0.5, t);
    const std::array<double, 7> computed{
        at(0, 0.25, 0.125),           at(0, 0.25, 0.4), at(0, 0.5, 0.1), at(1, 0.5, 0.1), at(1, 0.75, 0.125), flux,
        0.5 * mean.flux_in(0, 0.5, t)};
    for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(computed[k], printed[k], 0.51e-8) << k;
  };
  expect_plate({fourier_first, fourier_second(0.5)}, 0.05, 0.1,
               {0.06421441, 0.02879704, 0.02157430, 0.00640797, 0.00002118, 0.03033266, 0.01228022});
  expect_plate({quick_first, wave_second(0.2)}, 0.1, 0.6,
               {0.53482344, 0.38113364, 0.49123138, 0.45973126, 0.00111524, 0.15750059, 0.07263420});
}

TEST(DrivenLayers, a_step_agrees_with_the_sum_of_modes) {
  const DrivenLayers driven({fourier_first, fourier_second(0.5), {0.2, 3.0, 1.0, FourierLaw{}, 0.1}}, FarEnd::held,
                            TemperatureRamp{1.0, 0.0});
  const LayeredSlab slab({{0.5, 1.0, 1.0, 0.0}, {0.5, 0.25, 2.0, 0.0, 0.5}, {0.2, 3.0, 1.0, 0.0, 0.1}}, 1.0, 0.0);
  for (const double t : {1e-3, 0.01, 0.1, 0.5, 3.0}) {
    for (const double x : {0.1, 0.4, 0.6, 0.9, 1.1}) {
      EXPECT_NEAR(driven.temperature(x, t), slab.temperature(x, t), 2e-12) << x << ", " << t;
    }
    EXPECT_NEAR(driven.temperature_in(0, 0.5, t), slab.temperature_in(0, 0.5, t), 2e-12) << t;
    EXPECT_NEAR(driven.temperature_in(1, 0.5, t), slab.temperature_in(1, 0.5, t), 2e-12) << t;
  }
}

/// ∫ f over [0, end] by Simpson's rule.
double simpson(const std::function<double(double)>& f, double end, int pieces) {
  const double h = end / (2 * pieces);
  double sum = f(0.0) + f(end);
  for (int i = 1; i < 2 * pieces; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(i * h);
  return sum * h / 3.0;
}

TEST(DrivenLayers, a_wave_is_the_wake_of_all_steps_before) {
  const double rise = 0.1;
  const DrivenLayers driven({{1.0, 1.0, 1.0, CattaneoLaw{1.0}, 0.0}}, FarEnd::unbounded, TemperatureRamp{1.0, rise});
  for (const double t : {0.4, 1.0, 2.5}) {
    for (const double x : {0.0, 0.2, 0.35, 0.8}) {
      const auto one = [&](double s) {
        const double z = s / rise;
        return 0.5 * z * z * std::exp(-z) / rise * heat_wave(x, std::max(x, t - s));
      };
      const double expected = t > x ? simpson(one, t - x, 2000) : 0.0;
      // Simpson's rule: (t/4000)⁴/180 of a fourth derivative below 1e5.
      EXPECT_NEAR(driven.temperature(x, t), expected, 1e-9) << x << ", " << t;
    }
  }
}

TEST(DrivenLayers, a_pulse_into_a_fourier_half_space_is_the_integral_of_sources) {
  const double duration = 0.02;
  const DrivenLayers driven({{1.0, 2.0, 3.0, FourierLaw{}, 0.0}}, FarEnd::unbounded, FluxPulse{5.0, duration});
  for (const double t : {0.05, 0.3}) {
    const double x = 0.2;
    const auto source = [&](double s) {
      const double z = s / duration;
      const double age = t - s;
      if (age <= 0.0) return 0.0;
      return 5.0 * 0.5 * z * z * std::exp(-z) / duration * std::exp(-x * x * 3.0 / (4.0 * 2.0 * age)) /
             std::sqrt(std::numbers::pi * 2.0 * 3.0 * age);
    };
    EXPECT_NEAR(driven.temperature(x, t), simpson(source, t, 4000), 1e-10) << t;
  }
}

TEST(DrivenLayers, insulated_layers_keep_the_heat_of_a_pulse) {
  const DrivenLayers film({{0.1, 2.0, 3.0, CattaneoLaw{0.01}, 0.0}, {0.4, 1.0, 1.0, JeffreysLaw{0.02, 0.5}, 0.05}},
                          FarEnd::insulated, FluxPulse{0.7, 0.01});
  for (const double x : {0.0, 0.05, 0.3, 0.5}) EXPECT_NEAR(film.temperature(x, 10.0), 0.7 / (0.3 + 0.4), 1e-11) << x;
  EXPECT_NEAR(film.temperature_in(0, 0.1, 0.05) - film.temperature_in(1, 0.1, 0.05), 0.05 * film.flux_in(1, 0.1, 0.05),
              1e-12);
  EXPECT_NEAR(film.flux_in(1, 0.5, 0.05), 0.0, 1e-12);
  EXPECT_NEAR(film.flux_in(0, 0.0, 0.03), 0.7 * 4.5 * std::exp(-3.0) / 0.01, 1e-9);
}

TEST(DrivenLayers, more_layers_than_it_knows_are_refused) {
  EXPECT_THROW(DrivenLayers(std::vector<ContactLayer>(17, fourier_first), FarEnd::held, TemperatureRamp{}), Error);
}

/// The balance of heat and the law of flux by central differences.
TEST(DrivenLayers, layers_obey_their_laws_of_flux) {
  const DrivenLayers layers({jeffreys_first, wave_second(0.2)}, FarEnd::held, TemperatureRamp{1.0, 0.1});
  const double h = 1e-3;
  const auto expect_laws = [&](std::size_t number, const ContactLayer& layer, double x, double t) {
    const auto temperature = [&](double dx, double dt) { return layers.temperature_in(number, x + dx, t + dt); };
    const auto flux = [&](double dx, double dt) { return layers.flux_in(number, x + dx, t + dt); };
    const double rate = (temperature(0.0, h) - temperature(0.0, -h)) / (2.0 * h);
    const double divergence = (flux(h, 0.0) - flux(-h, 0.0)) / (2.0 * h);
    // Third derivatives below 2000, times h²/6.
    EXPECT_NEAR(layer.heat_capacity * rate, -divergence, 1e-3);
    const auto slope = [&](double dt) { return (temperature(h, dt) - temperature(-h, dt)) / (2.0 * h); };
    const double tau = relaxation_time(layer.law);
    EXPECT_NEAR(
        tau * (flux(0.0, h) - flux(0.0, -h)) / (2.0 * h) + flux(0.0, 0.0),
        -layer.conductivity * (slope(0.0) + tau * fourier_share(layer.law) * (slope(h) - slope(-h)) / (2.0 * h)), 1e-3);
  };
  expect_laws(0, jeffreys_first, 0.3, 0.4);
  expect_laws(1, wave_second(0.2), 0.6, 1.0);
}

}  // namespace
}  // namespace peritherm
