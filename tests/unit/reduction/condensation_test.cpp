#include "peritherm/reduction/condensation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "peritherm/reduction/symmetric_modes.hpp"
#include "support/assembled_case.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

/// 9 x 9 points with a crack, heated within; nothing passes its faces.
Problem heated_plate() {
  Problem problem = unit_body(2, 9, 2.5);
  set_all_faces(problem, Insulated{Outside::natural});
  problem.cracks.emplace_back().points = {{0.2, 0.5}, {0.7, 0.5}};
  problem.sources.push_back({Profile(3.0), Box{{0.5, 0.0}, {1.0, 0.5}}});
  problem.time.end = 0.1;
  return problem;
}

/// The same plate between a held layer, a mirrored wall, a stream and a flux.
Problem cooled_plate() {
  Problem problem = heated_plate();
  problem.boundaries.clear();
  HeldTemperature held = held_at(2.0, Imposed::inner);
  held.thickness = 1.0 / 9.0;
  set_face(problem, Face::y_max, held);
  set_face(problem, Face::x_min, held_at(2.0));
  set_face(problem, Face::x_max, Convection{4.0, 2.0});
  set_face(problem, Face::y_min, PrescribedFlux{1.5});
  return problem;
}

StaticCondensation condense_every(int every) {
  StaticCondensation method;
  method.retained.every = std::vector<int>{every};
  return method;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
  return largest;
}

double heat_of(const std::vector<double>& capacities) {
  return std::accumulate(capacities.begin(), capacities.end(), 0.0);
}

TEST(Condensation, shares_are_positive_and_pass_on_constants) {
  AssembledCase plate(heated_plate());
  std::vector<std::string> notes;
  const SplitHeat split = split_heat(plate.full(), condense_every(3).retained, notes);
  for (const double drop : {0.0, 1e-10, 1e-3}) {
    const SparseMatrix shapes = condensed_shapes(split, drop, {}, 0);
    EXPECT_GE(*std::min_element(shapes.values.begin(), shapes.values.end()), 0.0);
    for (const double sum : product(shapes, std::vector<double>(shapes.columns, 1.0))) EXPECT_NEAR(sum, 1.0, 1e-14);
  }
  const Matrix conductances = condensed_conductances(split, condensed_shapes(split, 1e-3, {}, 0));
  double largest = 0.0;
  for (const double value : conductances.values) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < conductances.rows; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < conductances.rows; ++j) sum += conductances(std::max(i, j), std::min(i, j));
    EXPECT_NEAR(sum, 0.0, rounding(500, largest));
  }
}

TEST(Condensation, keeps_the_heat_capacity_of_the_body) {
  AssembledCase plate(heated_plate());
  StaticCondensation method = condense_every(2);
  method.capacity = CondensedCapacity::lumped;
  const ReducedModel lumped = reduce(method, plate.full()).model;
  const double heat = heat_of(plate.capacities());
  EXPECT_NEAR(heat_of(lumped.lumped_capacities), heat, rounding(200, heat));
  const ReducedModel model = reduce(condense_every(2), plate.full()).model;
  // The heat of a constant is what the modes make of it: Σ stored² = 1ᵀ M 1.
  double sum = 0.0;
  for (const double stored : model.heat.stored_modes) sum += stored * stored;
  EXPECT_NEAR(sum, heat, rounding(2000, heat));
  EXPECT_NEAR(model.heat.heat_capacity, heat, rounding(200, heat));
}

void expect_heat_kept(const ReducedModel& model) {
  const ModalEquations& equations = model.stages.front().equations;
  double entered = 0.0, stored = 0.0, fastest = 0.0;
  for (std::size_t a = 0; a < model.heat.names.size(); ++a) entered += model.heat.inputs(a, 0);
  for (std::size_t k = 0; k < equations.size(); ++k) {
    stored += model.heat.stored_modes[k] * equations.gains(k, 0);
    fastest = std::max(fastest, equations.rates[k]);
  }
  EXPECT_NEAR(stored, entered, rounding(3000, entered));
  EXPECT_LE(equations.rates.front(), rounding(100, fastest));
}

TEST(Condensation, loses_and_gains_no_heat) {
  AssembledCase plate(heated_plate());
  expect_heat_kept(reduce(condense_every(2), plate.full()).model);
  CraigBampton modes;
  modes.retained.every = std::vector<int>{4};
  modes.modes = 6;
  expect_heat_kept(reduce(modes, plate.full()).model);
}

TEST(Condensation, leaves_a_body_at_the_temperature_of_its_surroundings_as_it_is) {
  Problem problem = cooled_plate();
  problem.sources.clear();
  problem.boundaries.pop_back();
  problem.initial.temperature = Profile(2.0);
  AssembledCase plate(problem);
  for (const CondensedCapacity capacity : {CondensedCapacity::consistent, CondensedCapacity::lumped}) {
    for (const ModelStart start : {ModelStart::projected, ModelStart::sampled}) {
      StaticCondensation method = condense_every(3);
      method.capacity = capacity;
      method.start = start;
      const ReducedModel model = reduce(method, plate.full()).model;
      for (const double time : {0.0, 1e-3, 0.1, 10.0}) {
        for (const double value : model_temperatures(model, plate.inputs(), plate.start(), time))
          EXPECT_NEAR(value, 2.0, 1e-12);
      }
    }
  }
}

TEST(Condensation, with_every_point_retained_is_the_body_itself) {
  Problem problem = cooled_plate();
  problem.initial.temperature = Profile("x + y^2");
  problem.time.integrator = Chebyshev{1e-12};
  March run(problem);
  run.advance_to(0.02);
  AssembledCase plate(problem);
  const ReducedModel model = reduce(condense_every(1), plate.full()).model;
  const std::vector<double> found = model_temperatures(model, plate.inputs(), plate.start(), 0.02);
  EXPECT_LT(largest_difference(found, run.temperatures()), 1e-10);
}

TEST(Condensation, ends_where_the_body_ends) {
  AssembledCase plate(cooled_plate());
  const ReducedModel full = reduce(condense_every(1), plate.full()).model;
  const ReducedModel model = reduce(condense_every(3), plate.full()).model;
  const double late = 50.0 / full.stages.front().equations.rates.front();
  const std::vector<double> right = model_temperatures(full, plate.inputs(), plate.start(), late);
  const std::vector<double> found = model_temperatures(model, plate.inputs(), plate.start(), late);
  // Retained points are exact in steady states, whatever heats the others; those miss their own response.
  for (const std::int64_t point : model.retained)
    EXPECT_NEAR(found[static_cast<std::size_t>(point)], right[static_cast<std::size_t>(point)], 1e-9);
  EXPECT_GT(largest_difference(found, right), 1e-4);
  CraigBampton modes;
  modes.retained.every = std::vector<int>{3};
  modes.modes = 1;
  const ReducedModel with_response = reduce(modes, plate.full()).model;
  EXPECT_LT(largest_difference(model_temperatures(with_response, plate.inputs(), plate.start(), late), right), 1e-9);
}

TEST(CraigBamptonModes, make_the_model_exact_when_there_are_all_of_them) {
  Problem problem = cooled_plate();
  problem.initial.temperature = Profile("x + y^2");
  AssembledCase plate(problem);
  const ReducedModel full = reduce(condense_every(1), plate.full()).model;
  CraigBampton method;
  method.retained.every = std::vector<int>{4};
  method.modes = 1000;
  const Reduction reduction = reduce(method, plate.full());
  EXPECT_EQ(reduction.model.unknowns(), full.unknowns());
  EXPECT_NE(reduction.notes.back().find("only "), std::string::npos);
  for (const double time : {0.0, 1e-3, 0.1}) {
    EXPECT_LT(largest_difference(model_temperatures(reduction.model, plate.inputs(), plate.start(), time),
                                 model_temperatures(full, plate.inputs(), plate.start(), time)),
              1e-10);
  }
}

TEST(CraigBamptonModes, are_the_slowest_of_the_truncated_points) {
  AssembledCase plate(heated_plate());
  std::vector<std::string> notes;
  const SplitHeat split = split_heat(plate.full(), condense_every(4).retained, notes);
  const std::size_t size = split.truncated.size();
  const SparseMatrix part = part_of(split.heat.conductances, split.truncated, split.truncated);
  Matrix conductances(size, size), capacities(size, size);
  std::vector<double> diagonal(size);
  for (std::size_t i = 0; i < size; ++i) {
    diagonal[i] = capacities(i, i) = split.heat.capacities[static_cast<std::size_t>(split.truncated[i])];
    for (auto n = static_cast<std::size_t>(part.begin[i]); n < static_cast<std::size_t>(part.begin[i + 1]); ++n)
      conductances(i, static_cast<std::size_t>(part.column_of[n])) = part.values[n];
  }
  const SymmetricModes all = all_modes(conductances, capacities);
  const SymmetricModes few = slowest_modes(split.factor, diagonal, 12);
  ASSERT_EQ(few.rates.size(), 12U);
  for (std::size_t k = 0; k < few.rates.size(); ++k) {
    // The square of the residual asked for, over gaps of a hundredth.
    EXPECT_NEAR(few.rates[k], all.rates[k], 1e-10 * all.rates[k]) << k;
    double size_of_mode = 0.0;
    for (std::size_t i = 0; i < size; ++i) size_of_mode += diagonal[i] * few.shapes(i, k) * few.shapes(i, k);
    EXPECT_NEAR(size_of_mode, 1.0, 1e-10);
  }
}

TEST(Condensation, refuses_what_it_cannot_hold) {
  AssembledCase plate(heated_plate());
  StaticCondensation method = condense_every(4);
  method.drop = 0.01;
  method.retained.every.reset();
  method.retained.points = {{0.05, 0.05}, {0.95, 0.95}};
  EXPECT_NO_THROW(reduce(method, plate.full()));
  EXPECT_THROW(require_few_unknowns(5000), Error);
  std::vector<std::string> notes;
  const SplitHeat split = split_heat(plate.full(), condense_every(2).retained, notes);
  EXPECT_THROW(condensed_shapes(split, 0.9, {}, 0), Error);
  EXPECT_THROW(condensed_shapes(split, 0.0, {}, 100), Error);
  EXPECT_THROW(SparseFactor(part_of(split.heat.conductances, split.truncated, split.truncated), 100), Error);
}

TEST(Condensation, stops_when_told_to) {
  AssembledCase plate(heated_plate());
  const auto stop = [](const std::string&, double share) { return share < 0.1; };
  EXPECT_THROW(reduce(condense_every(2), plate.full(), stop), Error);
}

TEST(Condensation, of_a_body_whose_cracks_grow_is_refused) {
  Problem problem = heated_plate();
  problem.cracks.front().tip_speed = 10.0;
  problem.cracks.front().start_time = 0.01;
  AssembledCase plate(problem);
  EXPECT_THROW(reduce(condense_every(2), plate.full()), Error);
}

}  // namespace
}  // namespace peritherm
