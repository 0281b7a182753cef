#include "peritherm/two_field/two_field_ida.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/two_field/two_field_gs4.hpp"
#include "support/differences.hpp"
#include "support/two_layers.hpp"

namespace peritherm {
namespace {

/// Skipped in builds without SUNDIALS.
class TwoFieldIda : public testing::Test {
 protected:
  void SetUp() override {
    try {
      make_two_field_ida({}, make_two_layers(two_layers[0], 12, 2.0, nullptr));
    } catch (const Error& error) {
      ASSERT_NE(std::string(error.what()).find("needs SUNDIALS"), std::string::npos);
      GTEST_SKIP() << "sundials";
    }
  }
};

constexpr double end_of_ida = 0.2;

TEST_F(TwoFieldIda, keeps_its_tolerance_whatever_the_index) {
  for (const int number : {0, 3, 5}) {
    const TwoLayers& layers = two_layers[number];
    const TwoFieldSystem system = make_two_layers(layers, 24, 3.0, ramp(layers.ramp_time));
    GeneralisedSingleStep fine;
    fine.step = end_of_ida / 4000;
    TwoFieldState exact = system.make_state();
    const double times[] = {0.07, end_of_ida};
    TwoFieldGs4(fine, system).march(0.0, times, exact, {});
    double before = 0.0;
    for (const double tolerance : {1e-5, 1e-7}) {
      DifferentialAlgebraic options;
      options.relative_tolerance = tolerance;
      const auto integrator = make_two_field_ida(options, system);
      TwoFieldState state = system.make_state();
      int seen = 0;
      TwoFieldFollower follower;
      follower.at_time = [&](double time, const TwoFieldState&) { return time == times[seen++]; };
      EXPECT_EQ(integrator->march(0.0, times, state, follower), end_of_ida);
      const TwoFieldCount count = integrator->count();
      const double error = largest_difference(state.temperature, exact.temperature);
      // Errors per step add up at most.
      EXPECT_LT(error, tolerance * static_cast<double>(count.steps.accepted)) << layers.name;
      EXPECT_LT(largest_difference(state.multipliers, exact.multipliers), 100.0 * tolerance) << layers.name;
      EXPECT_LT(count.largest_residual, 1e-12) << layers.name;
      EXPECT_EQ(seen, 2);
      if (before > 0.0) {
        EXPECT_LT(error, 0.2 * before) << layers.name;
      }
      before = error;
    }
  }
}

TEST_F(TwoFieldIda, keeps_the_heat_of_an_insulated_body) {
  const TwoFieldSystem system = make_two_layers(two_layers[3], 24, 3.0, nullptr);
  TwoFieldState state = system.make_state();
  for (std::size_t n = 0; n < system.size(); ++n) state.temperature[n] = n < 12 ? 1.0 : 0.2;
  const double before = system.stored_heat(state.temperature), times[] = {1.0};
  make_two_field_ida({}, system)->march(0.0, times, state, {});
  EXPECT_NEAR(system.stored_heat(state.temperature), before, 1e-11 * before);
}

TEST_F(TwoFieldIda, refuses_start_values_that_jump) {
  const TwoFieldSystem system = make_two_layers(two_layers[0], 24, 3.0, [](double) { return 1.0; });
  TwoFieldState state = system.make_state();
  const double times[] = {1.0};
  EXPECT_THROW(make_two_field_ida({}, system)->march(0.0, times, state, {}), Error);
}

}  // namespace
}  // namespace peritherm
