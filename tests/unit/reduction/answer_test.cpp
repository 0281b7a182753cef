#include "peritherm/reduction/answer.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "peritherm/base/error.hpp"
#include "unit/reduction/model_maker.hpp"

namespace peritherm {
namespace {

constexpr BarModel bar{12, 3.0};

/// T' = −K T + loads of the bar by the classical Runge-Kutta method, at the end.
template <class Wall, class Heat>
std::vector<double> march_bar(std::vector<double> state, const Wall& wall, const Heat& heat, double from, double to,
                              int steps) {
  const auto rate = [&](const std::vector<double>& values, double time) {
    std::vector<double> result(values.size());
    for (std::size_t n = 0; n < values.size(); ++n) {
      const double left = n == 0 ? wall(time) : values[n - 1];
      const double right = n + 1 == values.size() ? wall(time) : values[n + 1];
      result[n] = bar.conductance * (left + right - 2.0 * values[n]) + heat(time);
    }
    return result;
  };
  const auto moved = [](const std::vector<double>& values, double step, const std::vector<double>& slope) {
    std::vector<double> result(values);
    for (std::size_t n = 0; n < result.size(); ++n) result[n] += step * slope[n];
    return result;
  };
  const double step = (to - from) / steps;
  for (int i = 0; i < steps; ++i) {
    const double time = from + i * step;
    const auto k1 = rate(state, time);
    const auto k2 = rate(moved(state, 0.5 * step, k1), time + 0.5 * step);
    const auto k3 = rate(moved(state, 0.5 * step, k2), time + 0.5 * step);
    const auto k4 = rate(moved(state, step, k3), time + step);
    for (std::size_t n = 0; n < state.size(); ++n) {
      state[n] += step / 6.0 * (k1[n] + 2.0 * k2[n] + 2.0 * k3[n] + k4[n]);
    }
  }
  return state;
}

std::vector<double> lifted(const ReducedModel& model, const ModelState& state, double level) {
  std::vector<double> temperatures(model.capacities.size());
  lift(model, state, level, temperatures);
  return temperatures;
}

double energy_error(const ReducedModel& model, const ModelState& first, const ModelState& last) {
  double sum = 0.0;
  for (const double heat : last.heats) sum += heat;
  for (const double heat : first.heats) sum -= heat;
  return std::abs(stored_heat(model, last, 0.0) - stored_heat(model, first, 0.0) - sum);
}

TEST(Answer, follows_smooth_loads_exactly) {
  const ReducedModel model = bar.model(bar.points);
  std::vector<double> start(bar.points + 2, 0.0);
  for (std::size_t n = 0; n < bar.points; ++n) start[n] = std::cos(static_cast<double>(n));
  const ModelQuestion question{
      {Profile("280 + 5*t + sin(3*t)"), Profile("2*t^3")}, 280.0, start, {0.0, 0.7, 2.0}, 1e-10};
  const auto states = answer(model, question);
  const std::vector<double> right = march_bar(
      {start.begin(), start.begin() + bar.points}, [](double t) { return 5.0 * t + std::sin(3.0 * t); },
      [](double t) { return 2.0 * t * t * t; }, 0.0, 2.0, 4000);
  const std::vector<double> first = lifted(model, states[0], 280.0), last = lifted(model, states[2], 280.0);
  for (std::size_t n = 0; n < bar.points; ++n) {
    EXPECT_NEAR(first[n], 280.0 + start[n], 1e-12);
    // The fit is within 1e-10 of the largest load, 16; RK4 with λh = 6e-3 leaves less.
    EXPECT_NEAR(last[n], 280.0 + right[n], 2e-9);
  }
  EXPECT_DOUBLE_EQ(last[bar.points], 290.0 + std::sin(6.0));
  EXPECT_EQ(last[bar.points + 1], 0.0);
  EXPECT_LE(energy_error(model, states[0], states[2]), 1e-11);
}

TEST(Answer, is_exact_for_polynomials_whatever_the_times) {
  const ReducedModel model = bar.model(bar.points);
  const ModelQuestion whole{{Profile("t^8 - t^3"), Profile("1 - t")}, 0.0, {}, {1.0}, 1e-3};
  ModelQuestion parts = whole;
  parts.times.clear();
  for (int n = 0; n <= 37; ++n) parts.times.push_back(n == 37 ? 1.0 : std::pow(n / 37.0, 2));
  const auto once = answer(model, whole).back(), often = answer(model, parts).back();
  for (std::size_t k = 0; k < bar.points; ++k) EXPECT_NEAR(once.unknowns[k], often.unknowns[k], 1e-13);
  for (std::size_t a = 0; a < 2; ++a) EXPECT_NEAR(once.heats[a], often.heats[a], 1e-12);
}

TEST(Answer, finds_jumps_and_kinks) {
  const ReducedModel model = bar.model(bar.points);
  const double jump = std::numbers::inv_pi;
  const ModelQuestion question{
      {Profile("t < 1/pi ? 1 : 3"), Profile("abs(t - 0.5)")}, 0.0, {}, {0.25, jump, 1.0}, 1e-9};
  const auto states = answer(model, question);
  std::vector<double> right(bar.points, 0.0);
  const auto heat = [](double t) { return std::abs(t - 0.5); };
  right = march_bar(
      right, [](double) { return 1.0; }, heat, 0.0, jump, 2000);
  right = march_bar(
      right, [](double) { return 3.0; }, heat, jump, 0.5, 2000);
  right = march_bar(
      right, [](double) { return 3.0; }, heat, 0.5, 1.0, 2000);
  const std::vector<double> values = lifted(model, states.back(), 0.0);
  for (std::size_t n = 0; n < bar.points; ++n) EXPECT_NEAR(values[n], right[n], 1e-9);
  EXPECT_LE(energy_error(model, states.front(), states.back()), 1e-12);
}

TEST(Answer, sees_a_jump_right_behind_a_bisection) {
  const ReducedModel model = bar.model(bar.points);
  ModelQuestion question{{Profile("t < 0.5 ? 0 : 1"), 0.0}, 0.0, {}, {1.0}, 1e-9};
  const auto at_half = answer(model, question).back();
  question.loads[0] = Profile("t < 0.500000001 ? 0 : 1");
  const auto later = answer(model, question).back();
  // The heat let in late: at most the rate at the jump, 2 g, for a nanosecond.
  EXPECT_NE(later.heats[0], at_half.heats[0]);
  EXPECT_NEAR(later.heats[0], at_half.heats[0], 1e-8);
}

TEST(Answer, stays_stable_for_modes_of_any_rate) {
  ReducedModel model = bar.model(2);
  model.stages[0].equations.rates = {0.0, 1e12};
  model.stages[0].equations.gains = Matrix(2, 2);
  model.stages[0].equations.gains(0, 1) = 1.0;
  model.stages[0].equations.gains(1, 0) = 1e12;
  const auto state = answer(model, {{Profile("sin(t)"), Profile("cos(t)")}, 0.0, {}, {1.0}, 1e-12}).back();
  EXPECT_NEAR(state.unknowns[0], std::sin(1.0), 1e-12);
  EXPECT_NEAR(state.unknowns[1], std::sin(1.0), 3e-12);
}

TEST(Answer, changes_equations_at_the_end_of_a_stage) {
  // The bar conducts twice as well after 0.3 s: same modes, twice the rates.
  ReducedModel model = bar.model(bar.points);
  model.stages.push_back(model.stages[0]);
  model.stages[0].end = 0.3;
  for (double& rate : model.stages[1].equations.rates) rate *= 2.0;
  model.stages[1].modes = Matrix(bar.points, bar.points);  // numbered backwards
  ModalEquations& second = model.stages[1].equations;
  std::reverse(second.rates.begin(), second.rates.end());
  Matrix gains(bar.points, 2);
  for (std::size_t k = 0; k < bar.points; ++k) {
    model.stages[1].modes(bar.points - 1 - k, k) = 1.0;
    gains(k, 0) = 2.0 * second.gains(bar.points - 1 - k, 0);
    gains(k, 1) = second.gains(bar.points - 1 - k, 1);
  }
  second.gains = gains;
  model.stages[1].heats = Matrix(2, bar.points + 2);
  for (std::size_t k = 0; k < bar.points; ++k) model.stages[1].heats(0, k) = 2.0 * model.heat.modes(0, k);
  model.stages[1].heats(0, bar.points) = 2.0 * model.heat.inputs(0, 0);
  model.stages[1].heats(1, bar.points + 1) = model.heat.inputs(1, 1);
  const auto states = answer(model, {{Profile(1.0), Profile(2.0)}, 0.0, {}, {0.0, 0.3, 0.8}, 1e-8});
  const auto wall = [](double) { return 1.0; };
  std::vector<double> right = march_bar(
      std::vector<double>(bar.points, 0.0), wall, [](double) { return 2.0; }, 0.0, 0.3, 2000);
  // Twice as well for half a second is once for a second, at half the heating.
  right = march_bar(
      right, wall, [](double) { return 1.0; }, 0.0, 1.0, 4000);
  const std::vector<double> values = lifted(model, states.back(), 0.0);
  for (std::size_t n = 0; n < bar.points; ++n) EXPECT_NEAR(values[n], right[n], 1e-11);
  EXPECT_LE(energy_error(model, states.front(), states.back()), 1e-12);
  EXPECT_DOUBLE_EQ(heat_rates(model, states[1])[1], 2.0 * bar.points);
}

TEST(Answer, estimates_what_left_out_modes_would_add) {
  // The judge is a coarser model within; the estimate is the distance between both.
  ReducedModel model = bar.model(bar.points);
  const ReducedModel coarse = bar.model(5);
  model.judge.equations = coarse.stages[0].equations;
  model.judge.cross = Matrix(5, bar.points + 2);
  for (std::size_t k = 0; k < 5; ++k) model.judge.cross(k, k) = 1.0;
  const ModelQuestion question{{Profile("1 - cos(t)"), Profile(1.0)}, 0.0, {}, {0.05, 1.0}, 1e-10};
  for (const ModelState& state : answer(model, question)) {
    const ModelState other = answer(coarse, {question.loads, 0.0, {}, {state.time}, 1e-10}).back();
    const std::vector<double> fine_values = lifted(model, state, 0.0), values = lifted(coarse, other, 0.0);
    double sum = 0.0;
    for (std::size_t n = 0; n < bar.points; ++n) sum += std::pow(fine_values[n] - values[n], 2);
    EXPECT_NEAR(estimated_error(model, state), std::sqrt(sum / bar.points), 1e-13);
    const PointWeight weights[] = {{3, 0.25}, {4, 0.75}};
    const ModelProbe probe = make_probe(model, weights);
    EXPECT_NEAR(probe.temperature(state, 7.0), 7.0 + 0.25 * fine_values[3] + 0.75 * fine_values[4], 1e-13);
    const double difference = 0.25 * (fine_values[3] - values[3]) + 0.75 * (fine_values[4] - values[4]);
    EXPECT_NEAR(probe.estimated_error(state), std::abs(difference), 1e-13);
  }
}

TEST(Answer, is_judged_by_a_finer_model) {
  // The other way round: the model is the coarse one, the judge has all modes.
  ReducedModel model = bar.model(5);
  const ReducedModel fine = bar.model(bar.points);
  model.judge.equations = fine.stages[0].equations;
  model.judge.start = fine.basis.dense;
  model.judge.cross = Matrix(bar.points, 5 + 2);
  for (std::size_t k = 0; k < 5; ++k) model.judge.cross(k, k) = 1.0;
  std::vector<double> start(bar.points + 2, 0.0);
  for (std::size_t n = 0; n < bar.points; ++n) start[n] = std::cos(static_cast<double>(n));
  const ModelQuestion question{{Profile("t"), Profile(1.0)}, 0.0, start, {0.0, 0.02, 1.0}, 1e-10};
  const auto coarse_states = answer(model, question), fine_states = answer(fine, question);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double> values = lifted(model, coarse_states[i], 0.0), right = lifted(fine, fine_states[i], 0.0);
    double sum = 0.0;
    for (std::size_t n = 0; n < bar.points; ++n) sum += std::pow(right[n] - values[n], 2);
    EXPECT_NEAR(estimated_error(model, coarse_states[i]), std::sqrt(sum / bar.points), 1e-8);
  }
}

TEST(Answer, is_the_same_for_sparse_shapes_and_their_modes) {
  const ReducedModel dense = bar.model(5);
  std::vector<double> start(bar.points + 2, 0.0);
  for (std::size_t n = 0; n < bar.points; ++n) start[n] = std::cos(static_cast<double>(n));
  const ModelQuestion question{{Profile("t"), Profile(1.0)}, 0.0, start, {0.0, 0.02, 1.0}, 1e-10};
  const auto expected = answer(dense, question);
  for (const ModelStart kind : {ModelStart::projected, ModelStart::sampled}) {
    for (const bool lumped : {false, true}) {
      // Every free point is retained, so sampling loses nothing, nor do capacities of 1 change when they are lumped.
      ReducedModel model = dense;
      model.basis = {};
      model.basis.shapes.columns = bar.points;
      model.basis.modes = Matrix(bar.points, 5);
      for (std::size_t n = 0; n < bar.points + 2; ++n) {
        if (n < bar.points) {
          model.basis.shapes.column_of.push_back(static_cast<std::int32_t>(n));
          model.basis.shapes.values.push_back(1.0);
          model.retained.push_back(static_cast<std::int64_t>(n));
          for (std::size_t k = 0; k < 5; ++k) model.basis.modes(n, k) = bar.mode(n, k);
        }
        model.basis.shapes.begin.push_back(static_cast<std::int64_t>(model.basis.shapes.values.size()));
      }
      if (lumped) model.lumped_capacities.assign(bar.points, 1.0);
      model.start = kind;
      const auto states = answer(model, question);
      const PointWeight weights[] = {{3, 0.25}, {4, 0.75}};
      const ModelProbe probe = make_probe(model, weights);
      for (std::size_t i = 0; i < states.size(); ++i) {
        const std::vector<double> values = lifted(model, states[i], 0.0), right = lifted(dense, expected[i], 0.0);
        for (std::size_t n = 0; n < values.size(); ++n) EXPECT_NEAR(values[n], right[n], 1e-14);
        EXPECT_NEAR(probe.temperature(states[i], 0.0), 0.25 * right[3] + 0.75 * right[4], 1e-14);
      }
    }
  }
}

TEST(Answer, takes_inputs_off_the_start_where_they_act_at_once) {
  // y(0) = −Σ mode · u(0): the start of unknowns that are counted from the temperature of the walls.
  ReducedModel model = bar.model(bar.points);
  ModalEquations& equations = model.stages[0].equations;
  equations.start_gains = Matrix(bar.points, 2);
  for (std::size_t k = 0; k < bar.points; ++k) equations.start_gains(k, 0) = model.heat.stored_modes[k];
  const auto state = answer(model, {{Profile(2.0), Profile(0.0)}, 0.0, {}, {0.0}, 1e-8}).back();
  for (std::size_t n = 0; n < bar.points; ++n) EXPECT_NEAR(lifted(model, state, 0.0)[n], -2.0, 1e-13);
}

TEST(Answer, counts_what_of_the_start_is_left_out) {
  ReducedModel model = bar.model(5);
  model.judge.equations = bar.model(4).stages[0].equations;
  model.judge.cross = Matrix(4, 5 + 2);
  for (std::size_t k = 0; k < 4; ++k) model.judge.cross(k, k) = 1.0;
  std::vector<double> start(bar.points + 2, 0.0);
  for (std::size_t n = 0; n < bar.points; ++n) start[n] = bar.mode(n, 1) + 0.5 * bar.mode(n, 7);
  const auto state = answer(model, {{Profile(0.0), Profile(0.0)}, 0.0, start, {0.0}, 1e-8}).back();
  EXPECT_NEAR(estimated_error(model, state), 0.5 / std::sqrt(bar.points), 1e-12);
}

TEST(Answer, refuses_questions_that_do_not_fit) {
  const ReducedModel model = bar.model(3);
  const auto refused = [&](const ModelQuestion& question, const std::string& part) {
    try {
      answer(model, question);
      ADD_FAILURE() << "no error: " << part;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused({{Profile(1.0)}, 0.0, {}, {1.0}, 1e-8}, "the model has 2 loads, but 1 are given");
  refused({{Profile(1.0), Profile(1.0)}, 0.0, {1.0}, {1.0}, 1e-8}, "14 points");
  refused({{Profile(1.0), Profile(1.0)}, 0.0, {}, {1.0, 0.5}, 1e-8}, "times must ascend");
  refused({{Profile(1.0), Profile(1.0)}, std::nan(""), {}, {1.0}, 1e-8}, "level");
  refused({{Profile("x"), Profile("sin(")}, 0.0, {}, {1.0}, 1e-8}, "boundary.0.value: depends on place");
  refused({{Profile("x"), Profile("sin(")}, 0.0, {}, {1.0}, 1e-8}, "source.0.value: expression 'sin('");
  refused({{Profile("1/t"), Profile(1.0)}, 0.0, {}, {0.5}, 1e-8}, "is not finite");
}

}  // namespace
}  // namespace peritherm
