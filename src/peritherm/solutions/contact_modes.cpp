#include "peritherm/solutions/contact_modes.hpp"

#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {
namespace {

using Complex = std::complex<double>;

Complex squared_root(const ContactLayer& layer, Complex s, double wave_number) {
  return -layer.heat_capacity * s / effective_conductivity(layer, s) - wave_number * wave_number;
}

/// The equation of the modes over b₁ b₂, which makes it a function of b² without branches.
Complex contact_mismatch(const std::array<ContactLayer, 2>& layers, Complex s, double wave_number) {
  std::array<Complex, 2> sines;
  std::array<Complex, 2> slopes;
  for (std::size_t i = 0; i < 2; ++i) {
    const Complex root = std::sqrt(squared_root(layers[i], s, wave_number));
    const double length = layers[i].length;
    sines[i] = std::abs(root) * length < 1e-8 ? Complex(length) : std::sin(root * length) / root;
    slopes[i] = effective_conductivity(layers[i], s) * std::cos(root * length);
  }
  return (sines[0] + layers[1].resistance * slopes[0]) * slopes[1] + sines[1] * slopes[0];
}

/// J₀(βr) Y₀(βb) − Y₀(βr) J₀(βb), which vanishes at r = b, and its slope over r.
double ring_function(double root, double radius, double outer) {
  return std::cyl_bessel_j(0.0, root * radius) * std::cyl_neumann(0.0, root * outer) -
         std::cyl_neumann(0.0, root * radius) * std::cyl_bessel_j(0.0, root * outer);
}

double ring_slope(double root, double radius, double outer) {
  return -root * (std::cyl_bessel_j(1.0, root * radius) * std::cyl_neumann(0.0, root * outer) -
                  std::cyl_neumann(1.0, root * radius) * std::cyl_bessel_j(0.0, root * outer));
}

}  // namespace

ContactMode::ContactMode(const std::array<ContactLayer, 2>& layers, Complex guess, double wave_number)
    : layers_(layers), wave_number_(wave_number), rate_(guess) {
  bool settled = false;
  for (int step = 0; step < 100 && !settled; ++step) {
    // The function is analytic, so a difference along the real axis is its derivative.
    const double h = 1e-6 * std::abs(rate_);
    const Complex slope =
        (contact_mismatch(layers_, rate_ + h, wave_number_) - contact_mismatch(layers_, rate_ - h, wave_number_)) /
        (2.0 * h);
    const Complex change = contact_mismatch(layers_, rate_, wave_number_) / slope;
    rate_ -= change;
    settled = std::abs(change) < 1e-14 * std::abs(rate_);
  }
  if (!settled) {
    throw Error("no mode of two layers in contact was found near " + shortest(guess.real()) + " + " +
                    shortest(guess.imag()) + "i 1/s",
                "Guess nearer to its rate");
  }
  if (guess.imag() == 0.0) rate_ = rate_.real();
  for (std::size_t i = 0; i < 2; ++i) {
    conductivities_[i] = effective_conductivity(layers_[i], rate_);
    roots_[i] = std::sqrt(squared_root(layers_[i], rate_, wave_number_));
  }
  const auto slope_at_contact = [this](std::size_t i) {
    return conductivities_[i] * roots_[i] * std::cos(roots_[i] * layers_[i].length);
  };
  factors_ = {1.0, -slope_at_contact(0) / slope_at_contact(1)};
}

Complex ContactMode::amplitude(std::size_t layer, double x) const {
  const double depth = layer == 0 ? x : layers_[0].length + layers_[1].length - x;
  return factors_[layer] * std::sin(roots_[layer] * depth);
}

ContactMode ContactMode::with_unit_at(std::size_t layer, double x) const {
  ContactMode copy = *this;
  const Complex unit = amplitude(layer, x);
  for (Complex& factor : copy.factors_) factor /= unit;
  return copy;
}

double ContactMode::temperature(std::size_t layer, double x, double time, double y) const {
  return (amplitude(layer, x) * std::exp(rate_ * time)).real() * std::cos(wave_number_ * y);
}

double ContactMode::temperature_rate(std::size_t layer, double x, double time, double y) const {
  return (rate_ * amplitude(layer, x) * std::exp(rate_ * time)).real() * std::cos(wave_number_ * y);
}

double ContactMode::flux_along_x(std::size_t layer, double x, double time, double y) const {
  const double depth = layer == 0 ? x : layers_[0].length + layers_[1].length - x;
  const double sign = layer == 0 ? -1.0 : 1.0;
  const Complex slope = factors_[layer] * roots_[layer] * std::cos(roots_[layer] * depth);
  return sign * (conductivities_[layer] * slope * std::exp(rate_ * time)).real() * std::cos(wave_number_ * y);
}

double ContactMode::flux_along_y(std::size_t layer, double x, double time, double y) const {
  const Complex value = conductivities_[layer] * amplitude(layer, x) * std::exp(rate_ * time);
  return wave_number_ * value.real() * std::sin(wave_number_ * y);
}

/// Both sides of k_i T_i' / (T_i + R k_i T_i') = k_o T_o' / T_o, multiplied out.
double DiscMode::mismatch(double rate) const {
  const double inside = std::sqrt(rate * disc_.heat_capacity_inside / disc_.conductivity_inside);
  const double outside = std::sqrt(rate * disc_.heat_capacity_outside / disc_.conductivity_outside);
  const double slope = -disc_.conductivity_inside * inside * std::cyl_bessel_j(1.0, inside * disc_.radius);
  return (std::cyl_bessel_j(0.0, inside * disc_.radius) + disc_.resistance * slope) * disc_.conductivity_outside *
             ring_slope(outside, disc_.radius, disc_.outer_radius) -
         ring_function(outside, disc_.radius, disc_.outer_radius) * slope;
}

DiscMode::DiscMode(const DiscInRing& disc) : disc_(disc) {
  // Steps in √μ that are small beside the first zero of any of the functions.
  const double slowness = disc.radius * std::sqrt(disc.heat_capacity_inside / disc.conductivity_inside) +
                          disc.outer_radius * std::sqrt(disc.heat_capacity_outside / disc.conductivity_outside);
  const double step = 0.02 / slowness;
  double low = step;
  while (mismatch(low * low) * mismatch((low + step) * (low + step)) > 0.0) low += step;
  double high = low + step;
  const double sign = mismatch(low * low);
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (mismatch(middle * middle) * sign > 0.0 ? low : high) = middle;
  }
  rate_ = low * high;
  const double outside = std::sqrt(rate_ * disc.heat_capacity_outside / disc.conductivity_outside);
  factor_outside_ =
      -contact_flux(0.0) / (disc.conductivity_outside * ring_slope(outside, disc.radius, disc.outer_radius));
}

double DiscMode::temperature_inside(double radius, double time) const {
  const double inside = std::sqrt(rate_ * disc_.heat_capacity_inside / disc_.conductivity_inside);
  return std::cyl_bessel_j(0.0, inside * radius) * std::exp(-rate_ * time);
}

double DiscMode::temperature_outside(double radius, double time) const {
  const double outside = std::sqrt(rate_ * disc_.heat_capacity_outside / disc_.conductivity_outside);
  return factor_outside_ * ring_function(outside, radius, disc_.outer_radius) * std::exp(-rate_ * time);
}

double DiscMode::contact_flux(double time) const {
  const double inside = std::sqrt(rate_ * disc_.heat_capacity_inside / disc_.conductivity_inside);
  return disc_.conductivity_inside * inside * std::cyl_bessel_j(1.0, inside * disc_.radius) * std::exp(-rate_ * time);
}

}  // namespace peritherm
