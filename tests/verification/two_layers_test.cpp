#include "support/two_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/sparse_factor.hpp"
#include "peritherm/two_field/two_field_gs4.hpp"
#include "support/differences.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

/// Values at x = 1/4, both sides of 1/2, 3/4, and the multiplier of the contact, at a time.
struct LayerValues {
  const char* name;
  double time;
  double first, before, behind, second, flux;
};

/// Of the prototype: 100 cells per layer, horizon 3 cells, midpoint with steps of 1e-3 s.
const LayerValues prototype_values[] = {
    {"I-perfect", 0.1, 0.09348289, 0.02474161, 0.02474161, 0.00010335, 0.11186254},
    {"I-perfect", 0.5, 0.79344686, 0.61601433, 0.61601433, 0.16806474, 0.63371816},
    {"I-kapitza", 0.1, 0.09537444, 0.03491346, 0.01034554, 0.00003501, 0.04913585},
    {"I-kapitza", 0.5, 0.83502507, 0.69499920, 0.44576830, 0.11165869, 0.49846180},
    {"II-perfect", 0.2, 0.33007275, 0.11806459, 0.11806459, -0.00000289, 0.20031089},
    {"II-kapitza", 0.2, 0.33394543, 0.13988354, 0.07523814, -0.00000101, 0.12929080},
    {"II-kapitza", 0.6, 0.89301550, 0.78007008, 0.53547021, 0.11576879, 0.48919974},
    {"III-perfect", 0.5, 0.85933284, 0.84885081, 0.84885081, -0.00883120, 0.30696111},
    {"III-perfect", 1.0, 0.99065836, 0.98426389, 0.98426389, 0.46562680, 0.25181698},
    {"III-kapitza", 0.5, 0.85983546, 0.84985581, 0.79248058, -0.00828562, 0.28687614}};

constexpr int layer_cells = 100;

LayerValues values_of(const TwoFieldSystem& system, const char* name, double time, const TwoFieldState& state) {
  const ConstField all(state.temperature);
  const ContactRow& row = system.rows()[1];
  const auto trace_of = [](const Trace& trace, ConstField values) {
    double sum = 0.0;
    for (std::size_t k = 0; k < trace.points.size(); ++k) sum += trace.weights[k] * values[trace.points[k]];
    return sum;
  };
  const ConstField left = all.first(layer_cells), right = all.subspan(layer_cells);
  return {name,
          time,
          value_in_the_middle(left),
          trace_of(row.first_trace, left),
          trace_of(row.second_trace, right),
          value_in_the_middle(right),
          state.multipliers[1]};
}

const TwoLayers& layers_named(const std::string& name) {
  for (const TwoLayers& layers : two_layers) {
    if (name == layers.name) return layers;
  }
  throw std::invalid_argument(name);
}

class TwoLayersTest : public testing::TestWithParam<LayerValues> {};

TEST_P(TwoLayersTest, have_the_values_of_the_prototype) {
  const LayerValues& expected = GetParam();
  const TwoLayers& layers = layers_named(expected.name);
  const TwoFieldSystem system = make_two_layers(layers, layer_cells, 3.0, ramp(layers.ramp_time));
  GeneralisedSingleStep options;
  options.step = 1e-3;
  options.start = SingleStepStart::consistent;
  TwoFieldGs4 integrator(options, system);
  TwoFieldState state = system.make_state();
  const double times[] = {expected.time};
  integrator.march(0.0, times, state, {});
  const LayerValues found = values_of(system, expected.name, expected.time, state);
  constexpr double printed = 0.51e-8;
  EXPECT_NEAR(found.first, expected.first, printed);
  EXPECT_NEAR(found.before, expected.before, printed);
  EXPECT_NEAR(found.behind, expected.behind, printed);
  EXPECT_NEAR(found.second, expected.second, printed);
  EXPECT_NEAR(found.flux, expected.flux, printed);
  EXPECT_LT(integrator.count().largest_residual, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Prototype, TwoLayersTest, testing::ValuesIn(prototype_values),
                         [](const auto& tested) { return "case_" + std::to_string(tested.index); });

TEST(TwoLayersMarch, keeps_the_heat_of_an_insulated_body) {
  for (const TwoLayers& layers : two_layers) {
    const TwoFieldSystem system = make_two_layers(layers, 24, 3.0, nullptr);
    for (const std::optional<double> step : {std::optional<double>(0.005), std::optional<double>()}) {
      GeneralisedSingleStep options;
      options.step = step;
      TwoFieldState state = system.make_state();
      for (std::size_t n = 0; n < system.size(); ++n) state.temperature[n] = n < 12 ? 1.0 : 0.2;
      TwoFieldGs4 integrator(options, system);
      const double before = system.stored_heat(state.temperature), times[] = {0.3, 1.0};
      integrator.march(0.0, times, state, {});
      EXPECT_NEAR(system.stored_heat(state.temperature), before, 1e-11 * before) << layers.name;
      EXPECT_LT(integrator.count().largest_residual, 1e-12);
    }
  }
}

TEST(TwoLayersMarch, keeps_the_heat_of_insulated_plates_by_iterations_too) {
  for (const TwoLayers& layers : two_layers) {
    const TwoFieldSystem system = make_two_plates(layers, 12, 3.0, nullptr);
    GeneralisedSingleStep options;
    options.relative_tolerance = 1e-4;
    TwoFieldState state = system.make_state();
    for (std::size_t n = 0; n < system.size(); ++n) state.temperature[n] = n % 12 < 5 ? 1.0 : 0.2;
    TwoFieldGs4 integrator(options, system, StageMethod::iterative);
    const double before = system.stored_heat(state.temperature), times[] = {0.1, 1.0};
    integrator.march(0.0, times, state, {});
    EXPECT_NEAR(system.stored_heat(state.temperature), before, 1e-11 * before) << layers.name;
    EXPECT_LT(integrator.count().largest_residual, 1e-12);
    EXPECT_GT(integrator.count().iterations, 0);
  }
}

/// Crank-Nicolson for points joined by bonds of conductance V_i (1/K_i + 1/K_j) ω V_j, K = Σ ω ξ² V_j.
std::vector<double> march_bonds(std::vector<double> temperature, double spacing, int reach, double step, int steps) {
  const auto size = static_cast<int>(temperature.size());
  const auto neighbours = [&](int i, const auto& visit) {
    for (int j = std::max(0, i - reach); j <= std::min(size - 1, i + reach); ++j) {
      if (j != i) visit(j, std::abs(i - j) * spacing);
    }
  };
  std::vector<double> spread(temperature.size(), 0.0);
  for (int i = 0; i < size; ++i) neighbours(i, [&](int, double distance) { spread[i] += distance * spacing; });
  SparseMatrix left;
  std::vector<std::vector<double>> right(temperature.size(), std::vector<double>(temperature.size(), 0.0));
  for (int i = 0; i < size; ++i) {
    neighbours(i, [&](int j, double distance) {
      const double conductance = spacing * spacing * (1.0 / spread[i] + 1.0 / spread[j]) / distance;
      right[i][j] += 0.5 * step * conductance;
      right[i][i] -= 0.5 * step * conductance;
    });
    for (int j = 0; j < size; ++j) {
      left.column_of.push_back(j);
      left.values.push_back((i == j ? spacing : 0.0) - right[i][j]);
    }
    left.begin.push_back(static_cast<std::int64_t>(left.values.size()));
    right[i][i] += spacing;
  }
  left.columns = temperature.size();
  const SparseFactor factor(left, 0);
  for (int n = 0; n < steps; ++n) {
    Matrix sums(temperature.size(), 1);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) sums.values[i] += right[i][j] * temperature[j];
    }
    factor.solve(sums);
    temperature = sums.values;
  }
  return temperature;
}

TEST(TwoLayersMarch, of_one_layer_of_fouriers_law_is_the_bond_based_model) {
  constexpr int cells = 30, reach = 3, steps = 50;
  constexpr double spacing = 0.5 / cells, step = 0.01;
  const ClosedPart layer = box_part(1, {cells, 1, 1}, spacing, reach * spacing);
  std::vector<NonlocalOperators> parts;
  parts.emplace_back(1, layer.part, layer.surface, Kernel{ConstantKernel{}, 1});
  const TwoFieldSystem system(std::move(parts), {law_of(fourier_1, 1.0)}, {}, {});
  GeneralisedSingleStep options;
  options.method = SingleStepMethod::crank_nicolson;
  options.step = step;
  options.start = SingleStepStart::consistent;
  TwoFieldState state = system.make_state();
  for (int n = 0; n < cells; ++n) state.temperature[n] = std::cos(7.0 * n * n);
  const std::vector<double> start = state.temperature;
  const double times[] = {steps * step};
  TwoFieldGs4(options, system).march(0.0, times, state, {});
  EXPECT_LT(largest_difference(state.temperature, march_bonds(start, spacing, reach, step, steps)), 1e-12);
}

TEST(TwoLayersMarch, with_error_control_follows_the_tolerance) {
  for (const char* name : {"I-perfect", "II-kapitza", "III-kapitza"}) {
    const TwoLayers& layers = layers_named(name);
    const TwoFieldSystem system = make_two_layers(layers, 24, 3.0, ramp(layers.ramp_time));
    const double times[] = {0.05, 0.17, 0.4};
    GeneralisedSingleStep fine;
    fine.step = 2e-4;
    TwoFieldState exact = system.make_state();
    TwoFieldGs4(fine, system).march(0.0, times, exact, {});
    for (const double tolerance : {1e-3, 1e-5}) {
      GeneralisedSingleStep options;
      options.relative_tolerance = tolerance;
      TwoFieldGs4 integrator(options, system);
      TwoFieldState state = system.make_state();
      integrator.march(0.0, times, state, {});
      const auto steps = static_cast<double>(integrator.count().steps.accepted);
      // Errors per step add up at most, and some of the steps are used well.
      const double error = rms_difference(state.temperature, exact.temperature);
      EXPECT_LT(error, tolerance * steps) << layers.name;
      EXPECT_GT(error, 0.01 * tolerance) << layers.name;
    }
  }
}

TEST(TwoLayersMarch, starts_with_backward_euler_where_start_values_jump) {
  const TwoLayers& layers = layers_named("I-perfect");
  const TwoFieldSystem system = make_two_layers(layers, 200, 3.0, [](double) { return 1.0; });
  ASSERT_TRUE(find_start_fault(system, 0.0, system.make_state().temperature));
  GeneralisedSingleStep options;
  options.rho_infinity = 0.5;
  options.rho_infinity_rate = 0.0;
  options.step = 5e-4;
  TwoFieldGs4 integrator(options, system);
  TwoFieldState state = system.make_state();
  const double times[] = {0.1};
  integrator.march(0.0, times, state, {});
  const ConstField all(state.temperature);
  // Of the series with both layers' modes.
  EXPECT_NEAR(value_in_the_middle(all.first(200)), 0.59130487, 1e-4);
  EXPECT_NEAR(value_in_the_middle(all.subspan(200)), 0.00814368, 1e-4);
  options.step.reset();
  TwoFieldGs4 controlled(options, system);
  state = system.make_state();
  controlled.march(0.0, times, state, {});
  EXPECT_NEAR(value_in_the_middle(ConstField(state.temperature).first(200)), 0.59130487, 1e-4);
  EXPECT_LT(controlled.count().steps.accepted, 400);
  options.start = SingleStepStart::consistent;
  TwoFieldGs4 strict(options, system);
  state = system.make_state();
  try {
    strict.march(0.0, times, state, {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("(0, 0, 0)"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("-1 K"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace peritherm
