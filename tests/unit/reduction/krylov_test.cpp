#include <gtest/gtest.h>

#include <random>

#include "peritherm/integrators/integrator.hpp"
#include "peritherm/reduction/answer.hpp"
#include "peritherm/reduction/krylov_search.hpp"
#include "support/assembled_case.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// A cracked plate of 8 x 8 points with a load of every kind.
Problem loaded_plate() {
  Problem problem = unit_body(2, 8, 3.0);
  problem.boundaries.push_back({Face::y_max, std::nullopt, held_at(3.0)});
  problem.boundaries.push_back({Face::x_min, std::nullopt, PrescribedFlux{Profile(2.0)}});
  problem.boundaries.push_back({Face::y_min, std::nullopt, Convection{5.0, Profile(7.0)}});
  problem.sources.push_back({Profile(11.0), std::nullopt});
  problem.cracks.emplace_back().points = {{0.2, 0.5}, {0.6, 0.5}};
  return problem;
}

Profile& value_of(Problem& problem, const Load& load) {
  if (load.source >= 0) return problem.sources[static_cast<std::size_t>(load.source)].value;
  BoundaryCondition& condition = problem.boundaries[static_cast<std::size_t>(load.boundary)].condition;
  if (auto* held = std::get_if<HeldTemperature>(&condition)) return held->value;
  if (auto* flux = std::get_if<PrescribedFlux>(&condition)) return flux->value;
  return std::get<Convection>(condition).ambient;
}

FieldStorage random_field(std::size_t size, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  FieldStorage field(size);
  for (double& value : field) value = uniform(engine);
  return field;
}

FieldStorage rate_of(HeatSystem& system, FieldStorage state) {
  FieldStorage rate(system.size());
  system.combine(0.0, state, 1.0, {}, rate);
  return rate;
}

TEST(LoadRate, is_the_difference_that_one_load_makes) {
  const Problem problem = loaded_plate();
  AssembledCase with(problem);
  const FieldStorage state = random_field(with.system().size(), 1);
  const FieldStorage all = rate_of(with.system(), state);
  for (const Load& load : with.full().loads) {
    Problem less = problem;
    const Profile value = value_of(less, load);
    value_of(less, load) = Profile(0.0);
    AssembledCase without(less);
    const FieldStorage rest = rate_of(without.system(), state);
    FieldStorage held(with.system().size()), rate(with.system().size());
    with.system().load_rate({load.boundary, load.source}, value, 0.0, held, rate);
    double largest = 0.0;
    for (const double entry : all) largest = std::max(largest, std::abs(entry));
    for (std::size_t n = 0; n < rate.size(); ++n) {
      // Each rate is a sum over some forty bonds and fictitious points.
      EXPECT_NEAR(rate[n], all[n] - rest[n], 100.0 * 0x1p-52 * largest) << load.key << ", entry " << n;
    }
  }
}

TEST(LoadRate, refuses_a_shape_that_the_case_has_no_room_for) {
  AssembledCase plate(loaded_plate());
  FieldStorage held(plate.system().size()), rate(plate.system().size());
  EXPECT_THROW(plate.system().load_rate({0, -1}, Profile(std::string("x")), 0.0, held, rate), Error);
  EXPECT_THROW(plate.system().load_rate({-1, 5}, Profile(1.0), 0.0, held, rate), Error);
  EXPECT_THROW(plate.system().load_rate({}, Profile(1.0), 0.0, held, rate), Error);
}

TEST(ShiftedSolver, reaches_the_error_that_it_estimates) {
  AssembledCase plate(loaded_plate());
  const HeatBasis empty(plate.system());
  ShiftedSolver solver(plate.system(), empty.capacities());
  FieldStorage load = random_field(plate.system().size(), 2);
  for (std::size_t n = 0; n < load.size(); ++n) load[n] = empty.capacities()[n] > 0.0 ? load[n] : 0.0;
  for (const double shift : {1.0, 100.0, 1e4}) {
    FieldStorage left = load, exact(load.size()), solution(load.size());
    solver.solve(shift, 1e-13, 10000, left, exact);
    left = load;
    const ShiftedSolution found = solver.solve(shift, 1e-4, 10000, left, solution);
    EXPECT_TRUE(found.converged);
    FieldStorage difference(load.size()), image(load.size());
    for (std::size_t n = 0; n < load.size(); ++n) difference[n] = solution[n] - exact[n];
    const Term shifted[] = {{shift, difference.data()}};
    plate.system().combine_linear(-1, difference, -1.0, shifted, image);
    EXPECT_LE(std::sqrt(solver.product(difference, image)), 1e-4 * found.energy) << shift;
  }
}

/// All temperatures of a plate as its own basis.
void add_every_point(HeatBasis& basis) {
  std::vector<FieldStorage> states;
  for (std::size_t n = 0; n < basis.capacities().size(); ++n) {
    if (basis.capacities()[n] == 0.0) continue;
    states.emplace_back(basis.capacities().size());
    states.back()[n] = 1.0;
  }
  basis.add(std::move(states));
}

/// Largest difference (rms) from the full system over a few times; all inputs as the case has them.
double error_of_model(AssembledCase& body, const ReducedModel& model) {
  const std::vector<double> times{0.03 * body.full().longest_time, 0.3 * body.full().longest_time,
                                  body.full().longest_time};
  ModelQuestion question;
  question.level = body.full().level;
  for (const double input : body.inputs()) question.loads.emplace_back(input + body.full().level);
  for (std::size_t m = 0; m < question.loads.size(); ++m) {
    if (model.loads[m].kind == LoadKind::heat) question.loads[m] = Profile(body.inputs()[m]);
  }
  question.start = body.start();
  question.times = times;
  const std::vector<ModelState> states = answer(model, question);
  FieldStorage state = body.full().start;
  std::vector<double> full(body.grid().size()), reduced(body.grid().size());
  double worst = 0.0;
  std::size_t next = 0;
  Chebyshev exact;
  exact.relative_tolerance = 1e-12;
  const auto compare = [&](double, Field temperature) {
    body.full().layout.gather(temperature, full);
    lift(model, states[next++], question.level, reduced);
    double square = 0.0;
    for (std::size_t n = 0; n < full.size(); ++n) {
      square += model.capacities[n] * (full[n] - reduced[n]) * (full[n] - reduced[n]);
    }
    worst = std::max(worst, std::sqrt(square / model.heat.heat_capacity));
    return true;
  };
  make_integrator(exact, body.system())
      ->march(0.0, times, state, {[](double, ConstField) { return true; }, compare, [](double) { return true; }});
  return worst;
}

TEST(Galerkin, is_exact_on_the_space_of_all_temperatures) {
  AssembledCase plate(loaded_plate(), 0.5);
  HeatBasis basis(plate.system());
  add_every_point(basis);
  ASSERT_EQ(basis.size(), 64U);
  ReducedModel model;
  fill_model(basis, make_input_states(plate.full()), plate.full(), 0, model);
  // The reference stops at 1e-12 of the temperatures, which are below 10.
  EXPECT_LE(error_of_model(plate, model), 2e-11);
}

TEST(HeatBasis, drops_what_it_has_already) {
  AssembledCase plate(loaded_plate());
  HeatBasis basis(plate.system());
  std::vector<FieldStorage> states;
  for (const unsigned seed : {1U, 2U, 1U}) states.push_back(random_field(plate.system().size(), seed));
  EXPECT_EQ(basis.add(std::move(states)), 2U);
  const Matrix products = weighted_products(basis.capacities(), basis.states(), basis.states());
  EXPECT_NEAR(products(0, 0), 1.0, 1e-14);
  EXPECT_NEAR(products(1, 1), 1.0, 1e-14);
  EXPECT_NEAR(products(0, 1), 0.0, 1e-14);
}

TEST(RationalKrylov, is_as_accurate_as_was_asked_for_with_every_kind_of_load) {
  Problem problem = loaded_plate();
  problem.initial.temperature = Profile(std::string("sin(3*x) + y"));
  AssembledCase plate(problem, 0.5);
  RationalKrylov method;
  method.tolerance = 1e-6;
  const Reduction reduction = reduce(method, plate.full());
  EXPECT_LE(reduction.model.estimated_error, 1e-6);
  // Five drives may add up, each relative to its own temperatures, which are below 12 together.
  EXPECT_LE(error_of_model(plate, reduction.model), 5.0 * 12.0 * 1e-6);
  EXPECT_GT(reduction.cost.evaluations, 0);
}

TEST(RationalKrylov, takes_given_shifts_in_turn) {
  AssembledCase plate(loaded_plate());
  RationalKrylov method;
  method.tolerance = 1e-4;
  method.shifts = {2.0, 20.0, 200.0};
  const Reduction reduction = reduce(method, plate.full());
  EXPECT_LE(error_of_model(plate, reduction.model), 4.0 * 12.0 * 1e-4);
  ASSERT_FALSE(reduction.notes.empty());
  EXPECT_NE(reduction.notes[0].find("2 2 2 2 20 20 20 20 200"), std::string::npos) << reduction.notes[0];
}

TEST(RationalKrylov, says_how_far_it_came_when_it_gives_up) {
  AssembledCase plate(loaded_plate());
  RationalKrylov method;
  method.most_unknowns = 8;
  try {
    reduce(method, plate.full());
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("8 unknowns leave an estimated error of"), std::string::npos) << text;
    EXPECT_NE(text.find("most_unknowns"), std::string::npos) << text;
  }
}

TEST(RationalKrylov, refuses_what_changes_or_conducts_one_way) {
  Problem growing = loaded_plate();
  growing.cracks[0].tip_speed = 1.0;
  AssembledCase grows(growing);
  EXPECT_THROW(reduce(RationalKrylov{}, grows.full()), Error);
  Problem tied = unit_body(2, 8, 3.0);
  tied.boundaries.push_back({Face::y_max, std::nullopt, held_at(3.0)});
  tied.boundaries.push_back({Face::x_min, std::nullopt, Insulated{Outside::slaved}});
  AssembledCase follows(tied);
  EXPECT_THROW(reduce(RationalKrylov{}, follows.full()), Error);
}

TEST(RationalKrylov, keeps_the_heat_of_closed_bodies_exactly) {
  Problem problem = unit_body(2, 8, 3.0);
  problem.sources.push_back({Profile(11.0), std::nullopt});
  problem.initial.temperature = Profile(std::string("x"));
  AssembledCase plate(problem, 0.5);
  const ReducedModel model = reduce(RationalKrylov{}, plate.full()).model;
  ModelQuestion question;
  question.level = 0.5;
  question.loads = {Profile(11.0)};
  question.start = plate.start();
  question.times = {1e6};
  const ModelState state = answer(model, question)[0];
  // Everywhere 0.5 K at first, and 11 W/m³ into 1 J/(m³ K); some sums of 64 points.
  EXPECT_NEAR(stored_heat(model, state, 0.5) / (0.5 + 11e6), 1.0, 1e-13);
}

TEST(RationalKrylov, ends_where_nothing_is_left_to_add) {
  Problem heated = unit_body(2, 8, 3.0);
  heated.sources.push_back({Profile(11.0), std::nullopt});
  Problem rod = unit_body(1, 6, 3.0);
  rod.boundaries.push_back({Face::x_min, std::nullopt, held_at(3.0)});
  rod.sources.push_back({Profile(11.0), std::nullopt});
  for (const Problem& problem : {heated, rod}) {
    AssembledCase body(problem);
    RationalKrylov method;
    for (int given = 0; given < 2; ++given) {
      const ReducedModel model = reduce(method, body.full()).model;
      EXPECT_LE(model.unknowns(), 6U);
      EXPECT_TRUE(std::isfinite(model.estimated_error));
      // Two loads at most, with temperatures below 14.
      EXPECT_LE(error_of_model(body, model), 2.0 * 14.0 * 1e-6);
      method.shifts = {2.0, 20.0};
    }
  }
}

TEST(RationalKrylov, tells_that_only_the_estimate_needs_more_unknowns) {
  Problem heated = unit_body(2, 8, 3.0);
  heated.sources.push_back({Profile(11.0), std::nullopt});
  AssembledCase plate(heated);
  RationalKrylov method;
  method.most_unknowns = 1;
  try {
    reduce(method, plate.full());
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("1 unknowns may be enough"), std::string::npos) << text;
  }
}

TEST(Judge, estimates_the_error_of_a_condensed_model) {
  AssembledCase plate(loaded_plate());
  StaticCondensation method;
  Reduction reduction = reduce(method, plate.full());
  add_judge(reduction.model, plate.full(), reduction.cost);
  ASSERT_FALSE(reduction.model.judge.equations.rates.empty());
  ModelQuestion question;
  for (const double input : plate.inputs()) question.loads.emplace_back(input);
  question.times = {0.03, 0.3, 1.0};
  double estimated = 0.0;
  for (const ModelState& state : answer(reduction.model, question)) {
    estimated = std::max(estimated, estimated_error(reduction.model, state));
  }
  const double error = error_of_model(plate, reduction.model);
  // The judge is off by 1e-6 of temperatures up to 12.
  EXPECT_NEAR(estimated, error, 4.0 * 12.0 * 1e-6);
  EXPECT_GT(error, 1e-3);
}

}  // namespace
}  // namespace peritherm
