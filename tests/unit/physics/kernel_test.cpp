#include "peritherm/physics/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr std::size_t quadrature_points = 5 * 64;
constexpr std::array<double, 4> unit_sphere{0.0, 2.0, 2.0 * std::numbers::pi, 4.0 * std::numbers::pi};

double moment(const ConstantKernel&, int p) { return 1.0 / (p + 1); }
double moment(const LinearKernel&, int p) { return 1.0 / ((p + 1) * (p + 2)); }
double moment(const QuadraticKernel&, int p) { return 1.0 / (p + 1) - 2.0 / (p + 3) + 1.0 / (p + 5); }

/// ∫₀¹ exp(−a²s²) s^p ds by parts: p raises (p − 2) by (p − 1)/(2a²).
double moment(const GaussianKernel& kernel, int p) {
  const double a = kernel.sharpness;
  if (p == 0) return std::sqrt(std::numbers::pi) * std::erf(a) / (2.0 * a);
  if (p == 1) return (1.0 - std::exp(-a * a)) / (2.0 * a * a);
  return ((p - 1) * moment(kernel, p - 2) - std::exp(-a * a)) / (2.0 * a * a);
}

double amplitude(KernelForm form, int exponent, int dimension) {
  return micro_conductivity_amplitude(Kernel{form, exponent}, 1.0, 1.0, dimension);
}

TEST(Kernel, amplitudes_agree_with_closed_moments_for_every_shape_exponent_and_dimension) {
  const double conductivity = 1.14;
  const double horizon = 0.3;
  for (const KernelForm& form : {KernelForm{ConstantKernel{}}, KernelForm{LinearKernel{}},
                                 KernelForm{QuadraticKernel{}}, KernelForm{GaussianKernel{1.7}}}) {
    for (int exponent = 0; exponent <= 2; ++exponent) {
      for (int dimension = 1; dimension <= 3; ++dimension) {
        const int p = dimension + 1 - exponent;
        const double integral = std::visit([&](const auto& shape) { return moment(shape, p); }, form);
        const double expected =
            2.0 * dimension * conductivity / (unit_sphere[dimension] * integral * std::pow(horizon, p + 1));
        EXPECT_NEAR(micro_conductivity_amplitude(Kernel{form, exponent}, conductivity, horizon, dimension), expected,
                    rounding(quadrature_points, expected))
            << "shape " << form.index() << ", exponent " << exponent << ", " << dimension << "-D";
      }
    }
  }
}

TEST(Kernel, amplitudes_of_the_papers_are_met) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(amplitude(ConstantKernel{}, 2, 1), 1.0, rounding(quadrature_points, 1.0));
  EXPECT_NEAR(amplitude(LinearKernel{}, 2, 1), 2.0, rounding(quadrature_points, 2.0));
  EXPECT_NEAR(amplitude(ConstantKernel{}, 2, 2), 4.0 / pi, rounding(quadrature_points, 4.0 / pi));
  EXPECT_NEAR(amplitude(LinearKernel{}, 2, 2), 12.0 / pi, rounding(quadrature_points, 12.0 / pi));
}

TEST(Kernel, amplitude_is_proportional_to_the_conductivity) {
  const Kernel kernel;
  const double one = micro_conductivity_amplitude(kernel, 1.0, 0.1, 3);
  EXPECT_DOUBLE_EQ(micro_conductivity_amplitude(kernel, 400.0, 0.1, 3), 400.0 * one);
}

TEST(Kernel, shapes_have_their_values_inside_the_horizon) {
  EXPECT_DOUBLE_EQ(shape(Kernel{ConstantKernel{}, 2}, 0.25), 1.0);
  EXPECT_DOUBLE_EQ(shape(Kernel{LinearKernel{}, 2}, 0.25), 0.75);
  EXPECT_DOUBLE_EQ(shape(Kernel{QuadraticKernel{}, 2}, 0.5), 0.5625);
  EXPECT_DOUBLE_EQ(shape(Kernel{GaussianKernel{2.0}, 2}, 0.5), std::exp(-1.0));
}

TEST(Kernel, distances_beyond_the_horizon_count_as_on_its_edge) {
  EXPECT_EQ(shape(Kernel{LinearKernel{}, 2}, 1.5), 0.0);
  EXPECT_EQ(shape(Kernel{QuadraticKernel{}, 2}, 1.5), 0.0);
  EXPECT_EQ(shape(Kernel{GaussianKernel{2.0}, 2}, 1.5), std::exp(-4.0));
}

}  // namespace
}  // namespace peritherm
