#include "peritherm/two_field/two_field_system.hpp"

#include <gtest/gtest.h>

#include <string>

#include "peritherm/base/error.hpp"
#include "peritherm/two_field/two_field_gs4.hpp"
#include "support/two_layers.hpp"

namespace peritherm {
namespace {

/// Two layers whose contact is said so many times.
TwoFieldSystem make_repeated_contact(int times, double resistance) {
  constexpr double spacing = 0.05;
  const Kernel kernel{ConstantKernel{}, 1};
  const ClosedPart left = box_part(1, {10, 1, 1}, spacing, 2.0 * spacing);
  const ClosedPart right = box_part(1, {10, 1, 1}, spacing, 2.0 * spacing, {0.5, 0.0, 0.0});
  std::vector<NonlocalOperators> parts;
  parts.emplace_back(1, left.part, left.surface, kernel);
  parts.emplace_back(1, right.part, right.surface, kernel);
  const ContactRow row{0, parts[0].traces()[1], 1, parts[1].traces()[0], 1.0, {0.5, 0.0, 0.0}};
  TwoFieldLoads loads;
  loads.resistance = [resistance](double, Field values) { std::fill(values.begin(), values.end(), resistance); };
  return TwoFieldSystem(std::move(parts), {law_of(fourier_1, 1.0), law_of(fourier_2, 1.0)},
                        std::vector<ContactRow>(static_cast<std::size_t>(times), row), std::move(loads));
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(TwoFieldSystem, refuses_perfect_rows_that_follow_from_others_and_names_their_place) {
  EXPECT_EQ(message_of([] { make_repeated_contact(1, 0.0); }), "");
  const std::string message = message_of([] { make_repeated_contact(2, 0.0); });
  EXPECT_NE(message.find("1 of the rows of contacts and held temperatures follow from others: those at (0.5, 0, 0)"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("Let no two contacts or boundaries hold the same place"), std::string::npos) << message;
}

TEST(TwoFieldSystem, takes_rows_with_a_resistance_side_by_side) {
  EXPECT_EQ(message_of([] { make_repeated_contact(2, 0.5); }), "");
}

TEST(TwoFieldSystem, finds_where_start_temperatures_miss_the_perfect_rows) {
  const TwoFieldSystem system = make_two_layers(two_layers[0], 20, 3.0, [](double) { return 0.0; });
  TwoFieldState state = system.make_state();
  EXPECT_FALSE(find_start_fault(system, 0.0, state.temperature));
  for (std::size_t n = 0; n < 20; ++n) state.temperature[n] = 2.0;
  const auto fault = find_start_fault(system, 0.0, state.temperature);
  ASSERT_TRUE(fault);
  EXPECT_NEAR(std::abs(fault->jump), 2.0, 1e-14);
  // A linear temperature fits its traces; the other side is held as it is.
  for (std::size_t n = 0; n < 20; ++n) state.temperature[n] = 0.5 - (static_cast<double>(n) + 0.5) * 0.025;
  const auto at_start = find_start_fault(system, 0.0, state.temperature);
  ASSERT_TRUE(at_start);
  EXPECT_EQ(at_start->row, 0U);
  EXPECT_NEAR(at_start->jump, 0.5, 1e-14);
}

TEST(TwoFieldSystem, consistent_starts_refuse_a_jump_at_a_perfect_contact_and_say_where) {
  const TwoFieldSystem system = make_two_layers(two_layers[0], 20, 3.0, nullptr);
  TwoFieldState state = system.make_state();
  for (std::size_t n = 0; n < 20; ++n) state.temperature[n] = 2.0;
  GeneralisedSingleStep options;
  options.step = 0.01;
  options.start = SingleStepStart::consistent;
  const double times[] = {0.1};
  const std::string message = message_of([&] { TwoFieldGs4(options, system).march(0.0, times, state, {}); });
  EXPECT_NE(message.find("start temperatures do not fit the perfect contact at (0.5, 0, 0): they are off by 2 K"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("starts with backward Euler"), std::string::npos) << message;
}

TEST(TwoFieldSystem, consistent_starts_take_a_jump_at_a_resistance) {
  const TwoFieldSystem system = make_two_layers(two_layers[1], 20, 3.0, nullptr);
  TwoFieldState state = system.make_state();
  for (std::size_t n = 0; n < 20; ++n) state.temperature[n] = 2.0;
  EXPECT_FALSE(find_start_fault(system, 0.0, state.temperature));
  make_consistent(system, 0.0, state);
  EXPECT_NEAR(state.multipliers[0], 2.0 / two_layers[1].resistance, 1e-13);
}

}  // namespace
}  // namespace peritherm
