#include "peritherm/solutions/contact_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

using ModePair = std::array<ContactLayer, 2>;

ModePair fourier_pair(double resistance) {
  return {{{0.5, 1.0, 1.0, FourierLaw{}, 0.0}, {0.5, 0.25, 2.0, FourierLaw{}, resistance}}};
}
ModePair jeffreys_pair(double resistance) {
  return {{{0.5, 1.0, 1.0, JeffreysLaw{0.1, 0.3}, 0.0}, {0.5, 0.25, 2.0, JeffreysLaw{0.2, 0.1}, resistance}}};
}
ModePair mixed_pair(double resistance) {
  return {{{0.5, 10.0, 1.0, FourierLaw{}, 0.0}, {0.5, 0.1, 1.0, CattaneoLaw{0.5}, resistance}}};
}

/// Printed: the rate, T(.25), T(.5-), T(.5+), T(.75) and the flux at the contact.
struct PrintedMode {
  ModePair layers;
  std::complex<double> rate;
  double time;
  std::array<double, 5> values;
};

constexpr double mode_digit = 0.6e-10;

TEST(ContactMode, laws_of_flux_have_their_known_modes) {
  const std::vector<PrintedMode> known{{fourier_pair(0.0),
                                        -2.997269960607,
                                        0.2,
                                        {0.3024445883, 0.5491113734, 0.5491113734, 0.8082053941, -0.8091569414}},
                                       {fourier_pair(0.5),
                                        -2.500715699953,
                                        0.2,
                                        {0.3285657858, 0.6064438471, 1.0809072256, 1.2358668761, -0.9489267569}},
                                       {jeffreys_pair(0.0),
                                        {-3.405500096603, 2.672634591388},
                                        0.5,
                                        {0.0274833874, 0.0423274521, 0.0423274521, -0.0415349941, -0.1227697663}},
                                       {jeffreys_pair(0.5),
                                        {-3.243632924927, 1.890791193594},
                                        0.5,
                                        {0.0658008811, 0.1156440385, 0.2448165620, 0.1632073399, -0.2583450470}},
                                       {mixed_pair(0.2),
                                        {-1.101903979687, 2.587099313997},
                                        0.5,
                                        {0.0814048289, 0.1577658050, 0.7350990089, -20.3430263573, -2.8866660193}}};
  for (const PrintedMode& printed : known) {
    const ContactMode mode = ContactMode(printed.layers, printed.rate * 1.01).with_unit_at(0, 0.5);
    EXPECT_NEAR(mode.rate().real(), printed.rate.real(), 1e-12);
    EXPECT_NEAR(mode.rate().imag(), printed.rate.imag(), 1e-12);
    EXPECT_NEAR(mode.temperature(0, 0.25, printed.time), printed.values[0], mode_digit);
    EXPECT_NEAR(mode.temperature(0, 0.5, printed.time), printed.values[1], mode_digit);
    EXPECT_NEAR(mode.temperature(1, 0.5, printed.time), printed.values[2], mode_digit);
    EXPECT_NEAR(mode.temperature(1, 0.75, printed.time), printed.values[3], mode_digit);
    EXPECT_NEAR(mode.flux_along_x(0, 0.5, printed.time), printed.values[4], mode_digit);
  }
}

TEST(ContactMode, modes_along_a_plate_have_their_known_rates) {
  const double wave_number = 2.0 * std::numbers::pi;
  EXPECT_NEAR(ContactMode(fourier_pair(0.5), -8.0, wave_number).rate().real(), -7.934825143275, 1e-12);
  const std::complex<double> second = ContactMode(jeffreys_pair(0.5), {-3.4, 5.7}, wave_number).rate();
  EXPECT_NEAR(second.real(), -3.406596099062, 1e-12);
  EXPECT_NEAR(second.imag(), 5.701568441454, 1e-12);
  const std::complex<double> third = ContactMode(mixed_pair(0.2), {-1.0, 3.8}, wave_number).rate();
  EXPECT_NEAR(third.real(), -1.042988144062, 1e-12);
  EXPECT_NEAR(third.imag(), 3.834006655030, 1e-12);
}

/// ρc ∂T/∂t + div q and τ ∂q/∂t + q + k (∇T + τ F ∂∇T/∂t) by central differences of second order.
void expect_balance(const ContactMode& mode, const ContactLayer& layer, std::size_t number, double x, double t) {
  const double h = 1e-4;
  const double y = 0.07;
  const auto along = [h](const auto& value) { return (value(h) - value(-h)) / (2.0 * h); };
  const double divergence = along([&](double d) { return mode.flux_along_x(number, x + d, t, y); }) +
                            along([&](double d) { return mode.flux_along_y(number, x, t, y + d); });
  // Third derivatives of these modes are below 1e5 times h²/6.
  const double tolerance = 1e5 * h * h / 6.0;
  EXPECT_NEAR(layer.heat_capacity * mode.temperature_rate(number, x, t, y), -divergence, tolerance);
  EXPECT_NEAR(mode.temperature_rate(number, x, t, y),
              along([&](double d) { return mode.temperature(number, x, t + d, y); }), tolerance);
  const double tau = relaxation_time(layer.law);
  const double slope = along([&](double d) { return mode.temperature(number, x + d, t, y); });
  const double slope_rate = along([&](double d) { return mode.temperature_rate(number, x + d, t, y); });
  const double flux_rate = along([&](double d) { return mode.flux_along_x(number, x, t + d, y); });
  EXPECT_NEAR(tau * flux_rate + mode.flux_along_x(number, x, t, y),
              -layer.conductivity * (slope + tau * fourier_share(layer.law) * slope_rate), tolerance);
}

TEST(ContactMode, modes_satisfy_their_equations_and_the_contact) {
  const double wave_number = 2.0 * std::numbers::pi;
  const std::vector<std::pair<ModePair, std::complex<double>>> all{
      {fourier_pair(0.5), -8.0}, {jeffreys_pair(0.5), {-3.4, 5.7}}, {mixed_pair(0.2), {-1.0, 3.8}}};
  for (const auto& [layers, guess] : all) {
    const ContactMode mode = ContactMode(layers, guess, wave_number).with_unit_at(1, 0.7);
    expect_balance(mode, layers[0], 0, 0.31, 0.2);
    expect_balance(mode, layers[1], 1, 0.83, 0.2);
    const double flux = mode.flux_along_x(0, 0.5, 0.2, 0.07);
    EXPECT_NEAR(mode.flux_along_x(1, 0.5, 0.2, 0.07), flux, 1e-12);
    EXPECT_NEAR(mode.temperature(0, 0.5, 0.2, 0.07) - mode.temperature(1, 0.5, 0.2, 0.07), layers[1].resistance * flux,
                1e-12);
    EXPECT_NEAR(mode.temperature(0, 0.0, 0.2), 0.0, 1e-14);
    EXPECT_NEAR(mode.temperature(1, 1.0, 0.2), 0.0, 1e-14);
  }
}

TEST(ContactMode, a_guess_without_a_mode_nearby_is_refused) {
  EXPECT_THROW(ContactMode(fourier_pair(0.0), {-1e9, 1e9}), Error);
}

TEST(DiscMode, the_known_disc_has_its_known_rate) {
  const DiscMode mode(DiscInRing{0.5, 1.0, 0.25, 1.0, 2.0, 1.0, 0.5});
  EXPECT_NEAR(mode.rate(), 1.381396819619, 1e-12);
  EXPECT_DOUBLE_EQ(mode.temperature_inside(0.0, 0.0), 1.0);
}

TEST(DiscMode, a_mode_satisfies_its_equation_and_the_contact) {
  const DiscInRing disc{0.5, 1.0, 0.25, 1.0, 2.0, 1.0, 0.5};
  const DiscMode mode(disc);
  EXPECT_NEAR(mode.temperature_inside(0.5, 0.3) - mode.temperature_outside(0.5, 0.3), 0.5 * mode.contact_flux(0.3),
              1e-13);
  EXPECT_NEAR(mode.temperature_outside(1.0, 0.3), 0.0, 1e-13);
  const double h = 1e-4;
  const auto residual = [&](const auto& value, double radius, double diffusivity) {
    const double before = value(radius - h);
    const double after = value(radius + h);
    const double laplacian = (before - 2.0 * value(radius) + after) / (h * h) + (after - before) / (2.0 * h * radius);
    return diffusivity * laplacian + mode.rate() * value(radius);
  };
  // Fourth derivatives are below 400, times h²/12; rounding 1e-15/h².
  EXPECT_NEAR(residual([&](double r) { return mode.temperature_inside(r, 0.0); }, 0.3, 0.125), 0.0, 2e-6);
  EXPECT_NEAR(residual([&](double r) { return mode.temperature_outside(r, 0.0); }, 0.8, 1.0), 0.0, 2e-6);
  // One-sided differences of second order: h² times a third derivative below 100.
  const auto inside = [&](double r) { return mode.temperature_inside(r, 0.0); };
  const auto outside = [&](double r) { return mode.temperature_outside(r, 0.0); };
  const double slope_inside = (3.0 * inside(0.5) - 4.0 * inside(0.5 - h) + inside(0.5 - 2.0 * h)) / (2.0 * h);
  const double slope_outside = (-3.0 * outside(0.5) + 4.0 * outside(0.5 + h) - outside(0.5 + 2.0 * h)) / (2.0 * h);
  EXPECT_NEAR(-0.25 * slope_inside, mode.contact_flux(0.0), 1e-6);
  EXPECT_NEAR(-slope_outside, mode.contact_flux(0.0), 1e-6);
}

}  // namespace
}  // namespace peritherm
