#include "peritherm/solutions/classical.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double half_digit_8 = 0.5e-8;  ///< of values printed to eight decimals

const Slab bar{10.0, 1.14};

/// Terms of a series or images, each of size 1: every one is evaluated to a few roundings.
const double series = rounding(20, 1.0);

TEST(Classical, a_slab_with_held_ends_has_its_known_values) {
  EXPECT_NEAR(100.0 * slab_with_held_ends(bar, 5.0, 8.0), 51.74760039, half_digit_8);
}

TEST(Classical, a_slab_with_held_ends_is_its_fourier_series) {
  const Slab slab{2.0, 0.3};
  for (const double t : {0.4, 1.3, 1.4, 5.0}) {
    double sum = 0.0;
    for (int n = 1; n < 60; n += 2) {
      const double wave = n * std::numbers::pi / slab.length;
      sum += 4.0 / (n * std::numbers::pi) * std::sin(wave * 0.3) * std::exp(-slab.diffusivity * wave * wave * t);
    }
    EXPECT_NEAR(slab_with_held_ends(slab, 0.3, t), sum, rounding(30, 1.0)) << "t = " << t;
  }
}

TEST(Classical, early_and_late_sums_meet) {
  // The switch stands at αt/L² = 0.1, of a half slab at 0.025; the curve has no jump there.
  const Slab slab{1.0, 1.0};
  for (const double x : {0.0, 0.1, 0.37, 0.8, 1.0}) {
    EXPECT_NEAR(slab_held_and_insulated(slab, x, 0.1 * (1 - 1e-15)), slab_held_and_insulated(slab, x, 0.1), series);
    EXPECT_NEAR(slab_with_held_ends(slab, x, 0.025 * (1 - 1e-15)), slab_with_held_ends(slab, x, 0.025), series);
    EXPECT_NEAR(slab_with_prescribed_gradient(slab, 1.0, 2.0, x, 0.1 * (1 - 1e-15)),
                slab_with_prescribed_gradient(slab, 1.0, 2.0, x, 0.1), 4.0 * series);
  }
}

TEST(Classical, at_the_start_and_for_tiny_times_the_start_stands) {
  for (const double t : {0.0, 1e-30, 1e-9}) {
    EXPECT_EQ(slab_with_held_ends(bar, 3.0, t), 1.0);
    EXPECT_EQ(slab_held_and_insulated(bar, 3.0, t), 1.0);
    EXPECT_EQ(slab_with_step_start(bar, {60.0, 0.0, 5.0}, 100.0, 4.0, t), 60.0);
    EXPECT_EQ(slab_with_step_start(bar, {60.0, 0.0, 5.0}, 100.0, 6.0, t), 0.0);
    EXPECT_EQ(slab_with_prescribed_gradient(bar, 20.0, 3.0, 4.0, t), 0.0);
  }
}

TEST(Classical, held_ends_have_their_temperature) {
  for (const double t : {1e-6, 0.1, 8.0, 1e3}) {
    EXPECT_NEAR(slab_with_held_ends(bar, 0.0, t), 0.0, series);
    EXPECT_NEAR(slab_with_held_ends(bar, 10.0, t), 0.0, series);
    EXPECT_NEAR(slab_with_step_start(bar, {60.0, 0.0, 5.0}, 100.0, 10.0, t), 100.0, 100.0 * series);
    EXPECT_NEAR(slab_with_prescribed_gradient(bar, 20.0, 3.0, 0.0, t), 20.0, 20.0 * series);
  }
}

TEST(Classical, long_after_the_start_the_steady_state_stands) {
  EXPECT_EQ(slab_heated_from_one_end(bar, 7.0, 1e9), 1.0);
  EXPECT_DOUBLE_EQ(slab_with_prescribed_gradient(bar, 20.0, 3.0, 7.0, 1e9), 41.0);
}

TEST(Classical, a_square_and_a_cube_cool_as_products) {
  const Slab side{1.0, 1.14};
  const double value = square_with_held_sides(side, 0.5, 0.5, 0.025);
  EXPECT_NEAR(value, std::pow(slab_with_held_ends(side, 0.5, 0.025), 2), rounding(2, 1.0));
  EXPECT_NEAR(cube_with_held_faces(side, 0.5, 0.5, 0.2, 0.025), value * slab_with_held_ends(side, 0.2, 0.025),
              rounding(3, 1.0));
}

TEST(Classical, a_square_with_one_heated_side_has_its_known_values) {
  const Slab side{1.0, 1.0};
  EXPECT_NEAR(slab_heated_from_one_end(side, 0.25, 0.05), 0.42919533, half_digit_8);
  EXPECT_NEAR(slab_heated_from_one_end(side, 0.50, 0.05), 0.1138484, half_digit_8);
  EXPECT_NEAR(slab_heated_from_one_end(side, 1.00, 0.05), 0.0031308, half_digit_8);
  EXPECT_NEAR(slab_heated_from_one_end(side, 0.25, 0.10), 0.57624075, half_digit_8);
  EXPECT_NEAR(slab_heated_from_one_end(side, 0.50, 0.10), 0.26434868, half_digit_8);
  EXPECT_NEAR(slab_heated_from_one_end(side, 1.00, 0.10), 0.05069464, half_digit_8);
  EXPECT_NEAR(slab_heated_from_one_end(side, 0.25, 0.20), 0.69791607, half_digit_8);
  EXPECT_NEAR(slab_heated_from_one_end(side, 0.50, 0.20), 0.44682411, half_digit_8);
  EXPECT_NEAR(slab_heated_from_one_end(side, 1.00, 0.20), 0.22768839, half_digit_8);
}

TEST(Classical, a_bar_with_a_step_start_has_its_known_value) {
  EXPECT_NEAR(slab_with_step_start(bar, {60.0, 0.0, 5.0}, 100.0, 5.0, 8.0), 53.06258753, half_digit_8);
}

TEST(Classical, a_bar_with_a_prescribed_gradient_has_its_known_values) {
  const Slab rod{std::numbers::pi, 1.14};
  const double middle = 0.5 * rod.length;
  EXPECT_NEAR(slab_with_prescribed_gradient(rod, 20.0, 3.0, middle, 0.1), 0.02044012, half_digit_8);
  EXPECT_NEAR(slab_with_prescribed_gradient(rod, 20.0, 3.0, rod.length, 0.1), 1.14295397, half_digit_8);
  EXPECT_NEAR(slab_with_prescribed_gradient(rod, 20.0, 3.0, middle, 4.0), 17.22580451, half_digit_8);
  EXPECT_NEAR(slab_with_prescribed_gradient(rod, 20.0, 3.0, rod.length, 4.0), 18.83768352, half_digit_8);
  EXPECT_NEAR(slab_with_prescribed_gradient(rod, 20.0, 3.0, middle, 8.0), 22.31809733, half_digit_8);
  EXPECT_NEAR(slab_with_prescribed_gradient(rod, 20.0, 3.0, rod.length, 8.0), 26.03873825, half_digit_8);
}

TEST(Classical, a_lumped_body_halves_its_distance_from_the_surroundings_in_its_half_life) {
  EXPECT_EQ(lumped_convection(100.0, 20.0, 0.01, 0.0), 100.0);
  EXPECT_DOUBLE_EQ(lumped_convection(100.0, 20.0, 0.01, 100.0 * std::numbers::ln2), 60.0);
}

TEST(Classical, a_slit_in_a_gradient_has_two_faces_and_no_effect_far_away) {
  EXPECT_DOUBLE_EQ(slit_in_gradient(0.5, 0.3, 0.0), 0.4);
  EXPECT_DOUBLE_EQ(slit_in_gradient(0.5, 0.3, -0.0), -0.4);
  EXPECT_NEAR(slit_in_gradient(0.5, 0.8, 0.0), 0.0, rounding(2, 1.0));
  EXPECT_DOUBLE_EQ(slit_in_gradient(0.5, 0.0, 1.2), 1.3);
  // The first correction is a²/(2|z|²) of the gradient's value.
  EXPECT_NEAR(slit_in_gradient(0.5, 0.0, 1e9) / 1e9, 1.0, rounding(2, 1.0));
}

struct Probe {
  double x, y, value;
};

TEST(Classical, a_slit_in_a_square_has_its_known_values) {
  for (const auto& [x, y, value] :
       {Probe{0.0, 0.0, 45.85248204}, Probe{0.125, 0.0, 44.41429767}, Probe{0.25, 0.0, 39.77356464},
        Probe{0.375, 0.0, 30.44001780}, Probe{0.45, 0.0, 20.09340225}, Probe{0.0, 0.1, 46.74856365},
        Probe{0.0, 0.25, 51.18306506}, Probe{0.0, 0.5, 64.43973878}, Probe{0.0, 0.75, 81.51784864},
        Probe{1.0, 0.1, 11.56704340}, Probe{1.0, 0.25, 28.38236246}, Probe{1.0, 0.5, 54.14751796},
        Probe{1.0, 0.75, 77.61125579}}) {
    EXPECT_NEAR(100.0 * slit_in_square(0.5, x, y), value, half_digit_8) << x << ", " << y;
    EXPECT_EQ(slit_in_square(0.5, -x, -y), -slit_in_square(0.5, x, y));
  }
}

TEST(Classical, a_slit_in_a_square_lets_the_known_share_of_heat_pass) {
  EXPECT_NEAR(slit_in_square_conductance(0.5), 0.8196441885, 0.5e-10);
}

TEST(Classical, a_tiny_slit_leaves_the_gradient_of_the_square_as_it_is) {
  // A slit changes the field of a uniform gradient by a²/2 over the distance, and its images by no more.
  const double half_length = 1e-5;
  for (const double y : {0.2, 0.5, 0.9}) {
    EXPECT_NEAR(slit_in_square(half_length, 0.4, y), y, 10.0 * half_length * half_length);
  }
}

TEST(Classical, a_small_slit_in_a_square_looks_like_one_in_a_gradient) {
  const double half_length = 0.01;
  // The square's sides act back in the order of a² on the slit's own field.
  const double tolerance = 5.0 * half_length * half_length * half_length;
  EXPECT_NEAR(slit_in_square(half_length, 0.004, 0.0), slit_in_gradient(half_length, 0.004, 0.0), tolerance);
  EXPECT_NEAR(slit_in_square(half_length, 0.012, 0.02), slit_in_gradient(half_length, 0.012, 0.02), tolerance);
}

}  // namespace
}  // namespace peritherm
