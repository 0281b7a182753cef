#include "peritherm/solutions/layered_slab.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "peritherm/solutions/classical.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

using Laplace = std::complex<double>;

/// The same problem in the Laplace domain: per layer T = start/s + a cosh(√(sρc/k) (x − left)) + b sinh(…)/…,
/// the unknown temperatures of the interfaces from the balance of flux, a tridiagonal system.
class TransformedSlab {
 public:
  TransformedSlab(std::vector<SlabLayer> layers, double left, double right)
      : layers_(std::move(layers)), left_(left), right_(right) {}

  Laplace operator()(double x, Laplace s) const {
    const std::vector<Laplace> held = interface_values(s);
    double begin = 0.0;
    std::size_t i = 0;
    while (i + 1 < layers_.size() && x > begin + layers_[i].length) begin += layers_[i++].length;
    const SlabLayer& layer = layers_[i];
    const Laplace root = std::sqrt(s * layer.heat_capacity / layer.conductivity);
    const Laplace start = layer.start / s;
    const double from = x - begin;
    return start + (held[i] - start) * ratio(root, layer.length - from, layer.length) +
           (held[i + 1] - start) * ratio(root, from, layer.length);
  }

 private:
  /// 1 − exp(−w) without cancellation.
  static Laplace one_minus_exponential(Laplace w) {
    return std::abs(w) < 1.0 ? 2.0 * std::exp(-0.5 * w) * std::sinh(0.5 * w) : 1.0 - std::exp(-w);
  }

  /// sinh(√ a) / sinh(√ l) without overflow.
  static Laplace ratio(Laplace root, double a, double l) {
    return std::exp(root * (a - l)) * one_minus_exponential(2.0 * root * a) / one_minus_exponential(2.0 * root * l);
  }

  std::vector<Laplace> interface_values(Laplace s) const {
    const std::size_t n = layers_.size();
    std::vector<Laplace> diagonal(n + 1, 1.0);
    std::vector<Laplace> above(n + 1, 0.0);
    std::vector<Laplace> right_side(n + 1, 0.0);
    right_side[0] = left_ / s;
    right_side[n] = right_ / s;
    std::vector<Laplace> coth(n);
    std::vector<Laplace> csch(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Laplace root = std::sqrt(s * layers_[i].heat_capacity / layers_[i].conductivity);
      const Laplace small = std::exp(-2.0 * root * layers_[i].length);
      coth[i] = layers_[i].conductivity * root * (1.0 + small) / one_minus_exponential(2.0 * root * layers_[i].length);
      csch[i] = layers_[i].conductivity * root * 2.0 * std::exp(-root * layers_[i].length) /
                one_minus_exponential(2.0 * root * layers_[i].length);
    }
    for (std::size_t i = 1; i < n; ++i) {
      // Elimination goes along with the assembly.
      diagonal[i] = coth[i - 1] + coth[i];
      above[i] = -csch[i];
      right_side[i] =
          (coth[i - 1] - csch[i - 1]) * (layers_[i - 1].start / s) + (coth[i] - csch[i]) * (layers_[i].start / s);
      const Laplace factor = csch[i - 1] / diagonal[i - 1];
      diagonal[i] += factor * above[i - 1];
      right_side[i] += factor * right_side[i - 1];
    }
    std::vector<Laplace> values(n + 1);
    values[n] = right_side[n];
    for (std::size_t i = n; i-- > 0;) values[i] = (right_side[i] - above[i] * values[i + 1]) / diagonal[i];
    return values;
  }

  std::vector<SlabLayer> layers_;
  double left_;
  double right_;
};

/// Inversion along Weideman's hyperbola: 16 points leave about 1e-13 of the largest value [weideman2007].
template <class Transform>
double invert_laplace(const Transform& transform, double t) {
  constexpr int points = 16;
  const double step = 1.081792140 / points;
  const double scale = 4.492075287 * points / t;
  constexpr double tilt = 1.172104229;
  Laplace sum = 0.0;
  for (int k = 0; k < points; ++k) {
    const Laplace u(0.0, (k + 0.5) * step);
    const Laplace s = scale * (1.0 + std::sin(u - tilt));
    const Laplace slope = scale * std::cos(u - tilt);
    sum += std::exp(s * t) * transform(s) * slope;
  }
  return step / std::numbers::pi * sum.real();
}

constexpr double inversion = 1e-10;  ///< of values up to 100; measured on known transforms below

const std::vector<SlabLayer> four_segments{
    {2.5, 10.0, 1.0, 100.0}, {1.25, 1.0, 1.0, 100.0}, {3.75, 10.0, 1.0, 100.0}, {2.5, 1.0, 1.0, 100.0}};

TEST(LayeredSlab, the_inversion_is_as_accurate_as_the_tests_take_it) {
  for (const double t : {1e-4, 0.3, 20.0}) {
    EXPECT_NEAR(invert_laplace([](Laplace s) { return 100.0 / (s + 1.0); }, t), 100.0 * std::exp(-t), inversion);
    const auto error_function = [](Laplace s) { return 100.0 * std::exp(-std::sqrt(s)) / s; };
    EXPECT_NEAR(invert_laplace(error_function, t), 100.0 * std::erfc(0.5 / std::sqrt(t)), inversion);
  }
}

TEST(LayeredSlab, four_segments_have_their_known_values) {
  const LayeredSlab layered(four_segments, 0.0, 0.0);
  const TransformedSlab transformed(four_segments, 0.0, 0.0);
  constexpr std::array<double, 8> places{1.1875, 2.75, 3.125, 3.625, 5.0, 6.25, 8.125, 8.75};
  constexpr std::array<double, 8> at_1{10.34324576, 36.60321569, 58.66640053, 83.31808411,
                                       92.71319601, 94.36803371, 82.20506642, 62.56833341};
  constexpr std::array<double, 8> at_2{6.65021693,  26.64294425, 45.28937159, 68.03925070,
                                       77.20053110, 78.82541740, 65.30853495, 47.14693256};
  // The reference was computed to 2.4e-9 and then rounded.
  const double reference = 2.4e-9 + 0.5e-8;
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(layered.temperature(places[i], 1.0), at_1[i], reference) << places[i];
    EXPECT_NEAR(layered.temperature(places[i], 2.0), at_2[i], reference) << places[i];
    for (const double t : {1.0, 2.0}) {
      const double inverted = invert_laplace([&](Laplace s) { return transformed(places[i], s); }, t);
      EXPECT_NEAR(layered.temperature(places[i], t), inverted, inversion) << places[i];
    }
  }
}

TEST(LayeredSlab, four_segments_have_their_known_rates) {
  const LayeredSlab layered(four_segments, 0.0, 0.0);
  const auto& rates = layered.decay_rates();
  EXPECT_NEAR(rates.at(0), 0.1995610083591853, 1e-14);
  EXPECT_NEAR(rates.at(1), 1.5608221786, 0.5e-10);
  EXPECT_NEAR(rates.at(2), 2.8739920975, 0.5e-10);
  EXPECT_NEAR(rates.at(3), 5.0641468829, 0.5e-10);
  for (std::size_t n = 1; n < rates.size(); ++n) EXPECT_LT(rates[n - 1], rates[n]);
}

TEST(LayeredSlab, any_layers_agree_with_an_inversion_at_early_and_late_times) {
  // The elimination loses as many digits as the conductances k/l of the layers differ by: here three of fifteen.
  const std::vector<SlabLayer> layers{{0.3, 2.0, 5.0, 10.0}, {0.1, 10.0, 0.5, -30.0}, {1.0, 0.1, 1.0, 60.0}};
  const LayeredSlab layered(layers, 100.0, -20.0);
  const TransformedSlab transformed(layers, 100.0, -20.0);
  for (const double t : {1e-7, 1e-6, 1e-5, 1e-3, 0.05, 1.0, 30.0}) {
    for (const double x : {0.0, 0.01, 0.29999, 0.3, 0.301, 0.31, 0.39, 0.4, 0.41, 0.8, 1.3, 1.4}) {
      const double inverted = invert_laplace([&](Laplace s) { return transformed(x, s); }, t);
      EXPECT_NEAR(layered.temperature(x, t), inverted, inversion) << "x = " << x << ", t = " << t;
    }
  }
}

TEST(LayeredSlab, early_and_late_sums_meet) {
  const std::vector<SlabLayer> layers{{1.0, 1.0, 1.0, 0.0}, {0.5, 2.0, 1.0, 1.0}};
  const LayeredSlab layered(layers, 1.0, 3.0);
  const double meeting = 0.125 / (4.0 * 5.9 * 5.9);  // l² ρc/(4·5.9² k) of the quicker layer
  for (const double x : {0.0, 0.05, 0.5, 0.99, 1.0, 1.01, 1.25, 1.5}) {
    EXPECT_NEAR(layered.temperature(x, meeting * (1.0 - 1e-12)), layered.temperature(x, meeting * (1.0 + 1e-12)), 1e-12)
        << x;
  }
}

TEST(LayeredSlab, equal_layers_are_one_slab) {
  const LayeredSlab layered({{0.2, 3.0, 2.0, 1.0}, {0.5, 3.0, 2.0, 1.0}, {0.3, 3.0, 2.0, 1.0}}, 0.0, 0.0);
  for (const double t : {0.0, 1e-5, 1e-4, 0.01, 0.3, 3.0}) {
    for (const double x : {0.1, 0.2, 0.5, 0.77}) {
      EXPECT_NEAR(layered.temperature(x, t), slab_with_held_ends({1.0, 1.5}, x, t), 1e-13) << x << ", " << t;
    }
  }
}

TEST(LayeredSlab, one_layer_and_steady_states_are_right) {
  const LayeredSlab slab({{2.0, 1.0, 1.0, 5.0}}, 1.0, 3.0);
  EXPECT_DOUBLE_EQ(slab.temperature(1.5, 1e9), 2.5);
  // Resistances 1 and 3: a quarter of the difference lies over the first layer.
  // After 30 s what is left has decayed by exp(−30).
  const LayeredSlab thin({{0.3, 2.0, 5.0, 10.0}, {0.02, 40.0, 0.5, -30.0}, {1.0, 0.1, 1.0, 60.0}}, 100.0, -20.0);
  EXPECT_NEAR(thin.temperature(0.3, 30.0), 100.0 - 120.0 * 0.15 / (0.15 + 0.0005 + 10.0),
              100.0 * std::exp(-30.0) + 1e-13);
  const LayeredSlab layered({{1.0, 1.0, 1.0, 0.0}, {1.5, 0.5, 1.0, 0.0}}, 0.0, 8.0);
  EXPECT_DOUBLE_EQ(layered.steady_temperature(1.0), 2.0);
  EXPECT_DOUBLE_EQ(layered.temperature(1.75, 1e9), 5.0);
}

TEST(LayeredSlab, interfaces_keep_temperature_and_flux) {
  const LayeredSlab layered(four_segments, 0.0, 50.0);
  const double step = 1e-4;
  for (const double place : {2.5, 3.75, 7.5}) {
    const double ratio = place == 3.75 ? 0.1 : 10.0;  // conductivity on the left over that on the right
    const auto t = [&layered](double x) { return layered.temperature(x, 0.7); };
    const double left = (3.0 * t(place) - 4.0 * t(place - step) + t(place - 2.0 * step)) / (2.0 * step);
    const double right = (-3.0 * t(place) + 4.0 * t(place + step) - t(place + 2.0 * step)) / (2.0 * step);
    // One-sided differences of second order: a third of the third derivative, below 100, times the square of the step.
    EXPECT_NEAR(ratio * left, right, 400.0 * step * step + 1e-11 / step) << place;
  }
}

}  // namespace
}  // namespace peritherm
