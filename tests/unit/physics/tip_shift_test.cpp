#include "peritherm/physics/tip_shift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double fine_grid = std::numeric_limits<double>::infinity();
constexpr double printed = 0.5e-4;  // half a unit of the table's last digit

std::vector<Kernel> tabled_kernels() {
  std::vector<Kernel> kernels;
  for (const KernelForm& form : {KernelForm{ConstantKernel{}}, KernelForm{LinearKernel{}},
                                 KernelForm{QuadraticKernel{}}, KernelForm{GaussianKernel{}}}) {
    for (int exponent = 0; exponent <= 2; ++exponent) kernels.push_back({form, exponent});
  }
  return kernels;
}

TEST(TipShift, is_what_the_equations_of_the_grid_give) {
  EXPECT_NEAR(tip_shift({LinearKernel{}, 2}, 2, 3.0), 0.1103, printed);
  EXPECT_NEAR(tip_shift({LinearKernel{}, 2}, 2, 6.5), 0.1062, printed);
  EXPECT_NEAR(tip_shift({ConstantKernel{}, 2}, 2, 4.0), 0.1425, printed);
  EXPECT_NEAR(tip_shift({ConstantKernel{}, 0}, 2, 13.0), 0.1807, printed);
  EXPECT_NEAR(tip_shift({LinearKernel{}, 1}, 3, 2.0), 0.1268, printed);
}

TEST(TipShift, is_none_in_one_dimension) { EXPECT_EQ(tip_shift(Kernel{}, 1, 4.0), 0.0); }

TEST(TipShift, tends_to_the_limit_of_fine_grids) {
  for (const Kernel& kernel : tabled_kernels()) {
    for (int dimension = 2; dimension <= 3; ++dimension) {
      const double limit = tip_shift(kernel, dimension, fine_grid);
      EXPECT_LT(std::abs(tip_shift(kernel, dimension, 26.0) - limit),
                std::abs(tip_shift(kernel, dimension, 13.0) - limit));
      EXPECT_NEAR(tip_shift(kernel, dimension, 1e12), limit, 1e-12);  // the table's slope in 1/m is less than 1
    }
  }
}

TEST(TipShift, limits_are_those_of_the_relation_for_every_kernel_exponent_and_dimension) {
  for (const Kernel& kernel : tabled_kernels()) {
    for (int dimension = 2; dimension <= 3; ++dimension) {
      const double limit = tip_shift(kernel, dimension, fine_grid);
      EXPECT_NEAR(tip_shift_relation(kernel, dimension), limit, 0.004 * limit + printed)
          << "shape " << kernel.form.index() << ", exponent " << kernel.exponent << ", " << dimension << "-D";
    }
  }
}

TEST(TipShift, relation_has_the_closed_moments_of_the_constant_kernel) {
  // In 2-D with exponent 1 the moments are 1/2, 1/3, 1/4; in 3-D with exponent 2 too.
  EXPECT_NEAR(tip_shift_relation({ConstantKernel{}, 1}, 2), 1.010 * (1.0 / 8.0 + 1.0 / 24.0), rounding(320, 1.0));
  const double pi = std::numbers::pi;
  EXPECT_NEAR(tip_shift_relation({ConstantKernel{}, 2}, 3), 1.010 * (9.0 * pi / 256.0 + 1.0 / (9.0 * pi)),
              rounding(320, 1.0));
}

TEST(TipShift, lies_between_neighbouring_columns) {
  const std::vector<double> ratios{2.0, 3.0, 4.0, 5.0, 6.5, 9.0, 13.0, fine_grid};
  for (const Kernel& kernel : tabled_kernels()) {
    for (std::size_t k = 0; k + 1 < ratios.size(); ++k) {
      const double left = tip_shift(kernel, 2, ratios[k]);
      const double right = tip_shift(kernel, 2, ratios[k + 1]);
      const double middle = tip_shift(kernel, 2, 2.0 / (1.0 / ratios[k] + 1.0 / ratios[k + 1]));
      EXPECT_NEAR(middle, 0.5 * (left + right), rounding(4, 1.0));
    }
  }
}

TEST(TipShift, below_the_table_its_first_column_counts) {
  EXPECT_EQ(tip_shift(Kernel{}, 2, 1.2), tip_shift(Kernel{}, 2, 2.0));
}

TEST(TipShift, gaussian_kernels_join_the_table_at_their_usual_sharpness) {
  const double step = 1e-9;
  for (int exponent = 0; exponent <= 2; ++exponent) {
    for (const double ratio : {2.0, 3.7, 8.0, fine_grid}) {
      const double tabled = tip_shift({GaussianKernel{}, exponent}, 3, ratio);
      EXPECT_NEAR(tip_shift({GaussianKernel{2.0 + step}, exponent}, 3, ratio), tabled, step);
      EXPECT_NEAR(tip_shift({GaussianKernel{2.0 - step}, exponent}, 3, ratio), tabled, step);
    }
  }
}

TEST(TipShift, a_gaussian_without_sharpness_is_constant) {
  for (const double ratio : {3.0, 6.5, fine_grid}) {
    const double constant = tip_shift({ConstantKernel{}, 1}, 2, ratio);
    EXPECT_NEAR(tip_shift({GaussianKernel{1e-6}, 1}, 2, ratio), constant, 0.008 * constant);  // two relations' error
  }
}

TEST(TipShift, gaussian_kernels_of_other_sharpness_are_as_near_as_promised) {
  struct Case {
    double sharpness;
    int exponent, dimension;
    double ratio, shift, share;
  };
  // From tools/tip_shift.py --sharpness.
  const std::vector<Case> cases{{1.0, 2, 2, 3.0, 0.1288, 0.01}, {1.0, 2, 2, 6.5, 0.1276, 0.01},
                                {0.5, 0, 3, 4.0, 0.1596, 0.01}, {4.0, 1, 2, 9.0, 0.0580, 0.04},
                                {4.0, 2, 2, 5.0, 0.0518, 0.11}, {3.0, 0, 3, 4.0, 0.0881, 0.11}};
  for (const Case& c : cases) {
    EXPECT_NEAR(tip_shift({GaussianKernel{c.sharpness}, c.exponent}, c.dimension, c.ratio), c.shift, c.share * c.shift)
        << "sharpness " << c.sharpness << ", ratio " << c.ratio;
  }
}

TEST(TipShift, twice_as_sharp_is_half_as_long_once_the_horizon_does_not_matter) {
  // exp(-16) of the kernel is cut off.
  const double sharp = tip_shift({GaussianKernel{4.0}, 2}, 2, 8.0);
  EXPECT_NEAR(tip_shift({GaussianKernel{8.0}, 2}, 2, 16.0), 0.5 * sharp, 1e-4 * sharp);
}

}  // namespace
}  // namespace peritherm
