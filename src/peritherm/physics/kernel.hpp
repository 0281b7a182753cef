#pragma once

#include <cmath>
#include <concepts>
#include <variant>

#include "peritherm/base/describe.hpp"

namespace peritherm {

/// Shape ω(s) of the micro-conductivity, s = |ξ|/δ in [0, 1]; right up to a factor.
template <class K>
concept KernelShape = Alternative<K> && requires(const K shape, double s) {
  { shape(s) } -> std::convertible_to<double>;
};

struct ConstantKernel {
  double operator()(double) const { return 1.0; }
  static constexpr std::string_view name = "constant";
  static constexpr std::string_view help = "1";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const ConstantKernel&) const = default;
};

struct LinearKernel {
  double operator()(double s) const { return 1.0 - s; }
  static constexpr std::string_view name = "linear";
  static constexpr std::string_view help = "1 - s (triangular, conical)";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const LinearKernel&) const = default;
};

struct QuadraticKernel {
  double operator()(double s) const { return (1.0 - s * s) * (1.0 - s * s); }
  static constexpr std::string_view name = "quadratic";
  static constexpr std::string_view help = "(1 - s^2)^2";
  static constexpr auto options() { return std::tuple{}; }
  bool operator==(const QuadraticKernel&) const = default;
};

struct GaussianKernel {
  double sharpness = 2.0;  ///< a in exp(-(a s)²)
  double operator()(double s) const { return std::exp(-sharpness * sharpness * s * s); }
  static constexpr std::string_view name = "gaussian";
  static constexpr std::string_view help = "exp(-(a s)^2)";
  static constexpr auto options() {
    return std::tuple{optional("sharpness", &GaussianKernel::sharpness, "", positive, "a in exp(-(a s)^2)")};
  }
  bool operator==(const GaussianKernel&) const = default;
};

using KernelForm = std::variant<ConstantKernel, LinearKernel, QuadraticKernel, GaussianKernel>;  ///< the list

/// Micro-conductivity κ(ξ) = amplitude · ω(|ξ|/δ) / |ξ|^exponent.
struct Kernel {
  KernelForm form = LinearKernel{};
  int exponent = 2;  ///< power of |ξ| in the denominator: 0, 1 or 2
  static constexpr auto options() {
    return std::tuple{required("", &Kernel::form, "shape of the micro-conductivity over s = |xi| / horizon"),
                      optional("exponent", &Kernel::exponent, "",
                               Check{[](double v) { return v == 0.0 || v == 1.0 || v == 2.0; }, "must be 0, 1 or 2"},
                               "power of |xi| in the denominator of the bond's conductance")};
  }
  bool operator==(const Kernel&) const = default;
};

/// ω(s) of the chosen shape; s beyond 1 counts as 1.
double shape(const Kernel& kernel, double s);

/// ∫₀¹ ω(s) s^power ds, to 1e-9 of its size (Gaussian shapes: up to a sharpness of 20).
double moment_of_shape(const Kernel& kernel, int power);

/// Amplitude for which κ(ξ) [W/(m^(d+2) K)] conducts like Fourier's law as δ → 0:
///   (1/2d) ∫ κ(ξ) |ξ|² dV = conductivity           [bobaru2012, eq. 8, for any exponent and dimension]
double micro_conductivity_amplitude(const Kernel& kernel, double conductivity, double horizon, int dimension);

}  // namespace peritherm
