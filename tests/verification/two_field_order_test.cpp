#include <gtest/gtest.h>

#include <cmath>

#include "peritherm/two_field/two_field_gs4.hpp"
#include "support/differences.hpp"
#include "support/order_of_convergence.hpp"
#include "support/two_layers.hpp"

namespace peritherm {
namespace {

struct EndOfMarch {
  TwoFieldState state;
  FieldPair raw_rate;
  TwoFieldCount count;
};

EndOfMarch march_with_steps(const TwoFieldSystem& system, double rho, double rho_rate, int steps, double end) {
  GeneralisedSingleStep options;
  options.rho_infinity = rho;
  options.rho_infinity_rate = rho_rate;
  options.step = end / steps;
  options.start = SingleStepStart::consistent;
  TwoFieldGs4 integrator(options, system);
  EndOfMarch result{system.make_state(), {}, {}};
  const double times[] = {end};
  integrator.march(0.0, times, result.state, {});
  result.raw_rate = integrator.raw_rate();
  result.count = integrator.count();
  return result;
}

double flux_difference(const TwoFieldState& a, const TwoFieldState& b) {
  return a.flux.empty() ? 0.0 : largest_difference(a.flux[0], b.flux[0]);
}

constexpr double end_of_ramp = 0.2;
const std::vector<int> order_steps{40, 80, 160};

/// Members of the family whose orders are looked at: what is left of fast decays, and of their rates.
const std::pair<double, double> order_members[] = {{1.0, 1.0}, {1.0, 0.5}, {1.0, 0.0},
                                                   {0.5, 0.5}, {0.5, 0.0}, {0.0, 0.0}};

class TwoFieldOrder : public testing::TestWithParam<TwoLayers> {};

TEST_P(TwoFieldOrder, is_two_in_everything_but_the_raw_rate) {
  const TwoLayers& layers = GetParam();
  const TwoFieldSystem system = make_two_layers(layers, 24, 3.0, ramp(layers.ramp_time));
  const TwoFieldState exact = march_with_steps(system, 0.5, 0.5, 2560, end_of_ramp).state;
  for (const auto& [rho, rho_rate] : order_members) {
    std::vector<double> steps, temperatures, fluxes, multipliers, corrected, raw;
    for (const int count : order_steps) {
      const EndOfMarch found = march_with_steps(system, rho, rho_rate, count, end_of_ramp);
      steps.push_back(end_of_ramp / count);
      temperatures.push_back(largest_difference(found.state.temperature, exact.temperature));
      fluxes.push_back(flux_difference(found.state, exact));
      multipliers.push_back(largest_difference(found.state.multipliers, exact.multipliers));
      corrected.push_back(largest_difference(found.state.temperature_rate, exact.temperature_rate));
      raw.push_back(largest_difference(found.raw_rate.temperature, exact.temperature_rate));
      EXPECT_LT(found.count.largest_residual, 1e-12);
    }
    const auto expect_order = [&](const std::vector<double>& errors, double order, const char* what) {
      EXPECT_NEAR(order_of_convergence(steps, errors), order, 0.1) << what << " of " << rho << ", " << rho_rate;
    };
    expect_order(temperatures, 2.0, "temperature");
    if (system.has_fluxes()) expect_order(fluxes, 2.0, "flux");
    expect_order(multipliers, 2.0, "multipliers");
    expect_order(corrected, 2.0, "corrected rate");
    expect_order(raw, rho_rate < 1.0 ? 1.0 : 2.0, "raw rate");
  }
}

INSTANTIATE_TEST_SUITE_P(OfTwoLayers, TwoFieldOrder, testing::ValuesIn(two_layers));

}  // namespace
}  // namespace peritherm
