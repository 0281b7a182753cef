#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/running_case.hpp"
#include "peritherm/simulation/two_field_display.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// Two layers of equal thickness, the second of another material, marched in equal steps.
Problem two_touching_layers(int dimension, int cells) {
  Problem problem = unit_body(dimension, cells, 3.0);
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  problem.materials["other"] = {0.25, 2.0, 1.0};
  Coordinates from(static_cast<std::size_t>(dimension), 0.0), to(static_cast<std::size_t>(dimension), 1.0);
  from[0] = 0.5;
  problem.body.regions.push_back({"other", Box{from, to}});
  problem.time.end = 0.1;
  GeneralisedSingleStep stepping;
  stepping.step = 0.01;
  problem.time.integrator = stepping;
  return problem;
}

/// The case at its end.
std::unique_ptr<RunningCase> march_to_end(const Problem& problem) {
  check(problem);
  std::unique_ptr<RunningCase> running = make_running_case(problem);
  const auto goes_on = [](double) { return true; };
  const std::vector<double> times{problem.time.end};
  EXPECT_EQ(running->march(times, {goes_on, goes_on, goes_on}), problem.time.end);
  return running;
}

double energy_fault(RunningCase& running, double stored_before) {
  double entered = 0.0;
  for (const double heat : running.account_heats()) entered += heat;
  return running.stored_heat() - stored_before - entered;
}

std::vector<std::string> faults_of(const Problem& problem) {
  std::vector<std::string> texts;
  for (const Issue& issue : find_faults(problem)) texts.push_back(to_string(issue));
  return texts;
}

bool any_has(const std::vector<std::string>& texts, const std::string& part) {
  return std::any_of(texts.begin(), texts.end(),
                     [&part](const std::string& text) { return text.find(part) != std::string::npos; });
}

TEST(TwoFieldCase, balances_energy_with_every_kind_of_load) {
  Problem problem = two_touching_layers(1, 40);
  problem.contacts.push_back({{"body", "other"}, ContactResistance{Profile(0.5)}});
  set_face(problem, Face::x_min, PrescribedFlux{Profile("sin(20*t)")});
  set_face(problem, Face::x_max, Convection{3.0, Profile("t")});
  problem.sources.push_back({Profile("x*t"), std::nullopt});
  const auto running = march_to_end(problem);
  double largest = 0.0;
  for (const double heat : running->account_heats()) largest = std::max(largest, std::abs(heat));
  EXPECT_GT(largest, 0.01);
  // Ten steps, each with the rounding of a solved system of 40 unknowns.
  EXPECT_LT(std::abs(energy_fault(*running, 0.0)), 10 * 40 * 1e-15);
}

TEST(TwoFieldCase, knows_the_index_by_its_resistances) {
  Problem problem = two_touching_layers(1, 40);
  EXPECT_EQ(make_running_case(problem)->plan().two_field->index, 2) << "perfect contact where nothing is said";
  problem.contacts.push_back({{"other", "body"}, ContactConductance{Profile(2.0)}});
  set_face(problem, Face::x_min, Convection{3.0, Profile(1.0)});
  EXPECT_EQ(make_running_case(problem)->plan().two_field->index, 1);
  EXPECT_EQ(make_running_case(problem)->plan().two_field->multipliers, 2u);
  set_face(problem, Face::x_max, held_at(1.0, Imposed::mirror));
  std::get<HeldTemperature>(problem.boundaries.back().condition).imposed.reset();
  EXPECT_EQ(make_running_case(problem)->plan().two_field->index, 2);
}

TEST(TwoFieldCase, a_resistance_may_depend_on_time) {
  Problem problem = two_touching_layers(1, 40);
  problem.contacts.push_back({{"other", "body"}, ContactResistance{Profile("0.1 + 5*t")}});
  problem.initial.temperature = Profile("x < 0.5");
  const auto running = march_to_end(problem);
  const Snapshot snapshot = running->snapshot(problem.time.end);
  ASSERT_EQ(snapshot.interfaces.size(), 1u);
  const InterfaceValues& values = snapshot.interfaces.front();
  EXPECT_EQ(values.name, "other to body");
  EXPECT_LT(values.flux.front(), -0.1) << "from the hot body, the second of the name";
  EXPECT_NEAR(values.first.front() - values.second.front(), 0.6 * values.flux.front(), 1e-14);
}

TEST(TwoFieldCase, a_contact_must_not_open_entirely) {
  Problem problem = two_touching_layers(1, 40);
  problem.contacts.push_back({{"body", "other"}, ContactConductance{Profile("max(0, 1 - 20*t)")}});
  try {
    march_to_end(problem);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a contact's resistance is inf"), std::string::npos) << error.what();
  }
}

TEST(TwoFieldCase, error_control_passes_over_no_pulse) {
  Problem problem = two_touching_layers(1, 40);
  problem.time.end = 0.5;
  problem.sources.push_back({Profile("1000*exp(-((t-0.302)/0.001)^2)"), std::nullopt});
  const double heat = 1000.0 * 0.001 * std::sqrt(std::numbers::pi);
  GeneralisedSingleStep stepping;
  problem.time.integrator = stepping;
  const auto running = march_to_end(problem);
  // Each step may err by the tolerance.
  const auto steps = static_cast<double>(running->count().accepted);
  EXPECT_NEAR(running->stored_heat(), heat, steps * stepping.relative_tolerance * heat);
}

TEST(TwoFieldCase, the_order_of_names_decides_the_sign_even_if_one_stands_for_both_sides) {
  Problem problem = two_touching_layers(1, 40);
  problem.body.regions = {{"body", Box{{0.0}, {0.5}}}};
  problem.body.regions[0].name = "left";
  problem.materials.erase("other");
  problem.initial.temperature = Profile("x < 0.5");
  for (const bool swapped : {false, true}) {
    std::vector<std::string> names{"body", "left"};
    if (swapped) std::swap(names[0], names[1]);
    problem.contacts = {{names, ContactResistance{Profile(0.5)}}};
    const auto running = march_to_end(problem);
    const double flux = running->snapshot(problem.time.end).interfaces.front().flux.front();
    EXPECT_GT(swapped ? flux : -flux, 0.1) << "heat goes from the left to the right";
  }
}

TEST(TwoFieldCase, refuses_what_it_would_ignore) {
  Problem problem = two_touching_layers(2, 24);
  problem.materials["body"].conductivity_tensor = {2.0, 2.0, 0.0};
  GeneralisedSingleStep stepping;
  stepping.preconditioner = ImplicitPreconditioner::jacobi;
  problem.time.integrator = stepping;
  const auto faults = faults_of(problem);
  EXPECT_TRUE(any_has(faults, "materials.body.conductivity: stands beside conductivity_tensor"));
  EXPECT_TRUE(any_has(faults, "time.integrator.preconditioner: is for nonlocality.model"));
  EXPECT_EQ(faults.size(), 2u);
  problem.materials["body"].conductivity = 2.0;
  EXPECT_EQ(faults_of(problem).size(), 1u) << "as resolved.toml has it";
}

TEST(TwoFieldCase, named_regions_of_one_material_touch) {
  Problem problem = two_touching_layers(1, 40);
  problem.materials.erase("other");
  problem.body.regions[0].material = "body";
  problem.body.regions[0].name = "right";
  problem.contacts.push_back({{"body", "right"}, ContactResistance{Profile(1.0)}});
  EXPECT_EQ(faults_of(problem), std::vector<std::string>{});
  const auto plan = make_running_case(problem)->plan();
  EXPECT_EQ(plan.two_field->parts, 2u);
  EXPECT_EQ(plan.two_field->interfaces, 1u);
}

TEST(TwoFieldCase, an_anisotropic_body_keeps_a_linear_temperature) {
  Problem problem = two_touching_layers(2, 14);
  problem.body.regions.clear();
  problem.materials.erase("other");
  problem.materials["body"].conductivity = 0.0;
  problem.materials["body"].conductivity_tensor = {2.0, 1.0, 0.5};
  problem.initial.temperature = Profile("1 + 2*x - y");
  for (const Face face : {Face::x_min, Face::x_max, Face::y_min, Face::y_max}) {
    problem.boundaries.push_back({face, std::nullopt, HeldTemperature{Profile("1 + 2*x - y"), {}, {}}});
  }
  const auto running = march_to_end(problem);
  const Snapshot snapshot = running->snapshot(problem.time.end);
  std::vector<Point> flux(snapshot.grid.size());
  snapshot.heat_flux(0, flux);
  for (std::size_t n = 0; n < flux.size(); ++n) {
    const Point x = snapshot.grid.position(snapshot.grid.index(n));
    EXPECT_NEAR(snapshot.temperature[n], 1.0 + 2.0 * x[0] - x[1], 1e-11);
    EXPECT_NEAR(flux[n][0], -3.5, 1e-9);
    EXPECT_NEAR(flux[n][1], 0.0, 1e-9);
  }
}

TEST(TwoFieldCase, fluxes_at_the_start_belong_to_materials_that_relax) {
  Problem problem = two_touching_layers(1, 40);
  problem.initial.heat_flux = {Profile(1.0)};
  EXPECT_TRUE(any_has(faults_of(problem), "initial.heat_flux: no material relaxes"));
  problem.materials["other"].flux_law = CattaneoLaw{0.5};
  EXPECT_EQ(faults_of(problem), std::vector<std::string>{});
  const auto running = make_running_case(problem);
  const Snapshot snapshot = running->snapshot(0.0);
  std::vector<Point> flux(snapshot.grid.size());
  snapshot.heat_flux(0, flux);
  EXPECT_EQ(flux[5][0], 0.0);
  EXPECT_EQ(flux[30][0], 1.0);
}

TEST(TwoFieldCase, says_everything_that_is_wrong_at_once) {
  Problem problem = two_touching_layers(1, 40);
  problem.contacts.push_back({{"body", "other"}, PerfectContact{}});
  problem.contacts.push_back({{"other", "body"}, ContactResistance{Profile(1.0)}});
  problem.contacts.push_back({{"body", "othr"}, PerfectContact{}});
  problem.cracks.push_back({});
  problem.numerics.backend = BackendName::bond;
  const std::vector<std::string> faults = faults_of(problem);
  EXPECT_TRUE(any_has(faults, "contact.1.between: 'body' and 'other' have a contact already, contact.0"));
  EXPECT_TRUE(any_has(faults, "contact.2.between.1: no material or region is called 'othr'. Did you mean 'other'?"));
  EXPECT_TRUE(any_has(faults, "crack.0: is for nonlocality.model = \"bond\" only"));
  EXPECT_TRUE(any_has(faults, "numerics.backend: is for nonlocality.model = \"bond\" only"));
}

TEST(TwoFieldCase, contacts_whose_files_would_have_one_name_are_refused) {
  Problem problem = two_touching_layers(1, 80);
  problem.body.regions.push_back({"body", Box{{0.75}, {1.0}}, "last"});
  problem.contacts.push_back({{"body", "other"}, ContactResistance{Profile(1.0)}, "X"});
  problem.contacts.push_back({{"other", "last"}, ContactResistance{Profile(1.0)}, "x"});
  problem.contacts[0].between[0] = "first";
  problem.body.regions.insert(problem.body.regions.begin(), {"body", Box{{0.0}, {0.5}}, "first"});
  EXPECT_EQ(faults_of(problem), std::vector<std::string>{}) << "no files are asked for";
  problem.outputs.push_back({std::nullopt, std::vector<double>{0.1}, ContactOutput{}});
  EXPECT_TRUE(any_has(faults_of(problem), "contact.1.name: 'x' and 'X' have the same file, contact_x.csv"));
}

TEST(TwoFieldCase, a_conductivity_tensor_must_let_heat_flow_from_hot_to_cold) {
  Problem problem = two_touching_layers(2, 14);
  problem.materials["body"].conductivity_tensor = {1.0, 1.0, 2.0};
  EXPECT_TRUE(any_has(faults_of(problem), "is not positive definite"));
  problem.materials["body"].conductivity_tensor = {1.0, 1.0};
  EXPECT_TRUE(any_has(faults_of(problem), "Give [xx, yy, xy]"));
}

TEST(ContactJumps, probes_of_both_models_tell_the_temperatures_on_both_sides) {
  for (const Model model : {Model::bond, Model::two_field}) {
    Problem problem = two_touching_layers(1, 40);
    problem.nonlocality.model = model;
    problem.initial.temperature = Profile("x < 0.5 ? 1 - x : 5 + x");
    if (model == Model::bond) problem.time.integrator = AutomaticStepping{};
    problem.contacts.push_back({{"body", "other"}, ContactResistance{Profile(1e12)}});
    check(problem);
    const auto running = make_running_case(problem);
    const Snapshot snapshot = running->snapshot(0.0);
    // Linear on both sides, which a line through two points keeps to rounding.
    EXPECT_NEAR(temperature_at(snapshot, {0.4999, 0.0, 0.0}), 0.5001, 1e-12);
    EXPECT_NEAR(temperature_at(snapshot, {0.5001, 0.0, 0.0}), 5.5001, 1e-12);
    EXPECT_TRUE(snapshot.jumps.between(0, 1, {0.5, 0.0, 0.0}));
  }
}

TEST(ContactJumps, follow_resistances_of_place_and_time) {
  Problem problem = two_touching_layers(2, 16);
  const auto jump_at = [&](double y, double time) {
    const auto running = make_running_case(problem);
    const MaterialJumps jumps = running->snapshot(time).jumps;
    return jumps && jumps.between(1, 0, {0.5, y, 0.0});
  };
  EXPECT_FALSE(jump_at(0.2, 0.0)) << "perfect where nothing is said";
  problem.contacts.push_back({{"body", "other"}, ContactResistance{Profile("y < 0.5 ? 0 : t")}});
  EXPECT_FALSE(jump_at(0.2, 1.0));
  EXPECT_FALSE(jump_at(0.7, 0.0));
  EXPECT_TRUE(jump_at(0.7, 1.0));
  problem.contacts[0].law = ContactResistance{Profile(0.0)};
  EXPECT_FALSE(jump_at(0.2, 1.0));
  problem.contacts[0].law = ContactConductance{Profile(2.0)};
  EXPECT_TRUE(jump_at(0.2, 1.0));
}

TEST(TwoFieldDisplay, shapes_decide_which_part_a_place_beside_an_oblique_interface_is_in) {
  Problem problem = unit_body(2, 16, 2.0);
  problem.nonlocality.model = Model::two_field;
  problem.nonlocality.kernel = {ConstantKernel{}, 1};
  problem.materials["other"] = {0.25, 2.0, 1.0};
  const HalfSpace shape{{1.0, 0.7}, 0.7};
  problem.body.regions.push_back({"other", shape});
  problem.contacts.push_back({{"body", "other"}, ContactResistance{Profile(1.0)}});
  problem.initial.temperature = Profile("x + 0.7*y <= 0.7*sqrt(1.49) ? 100 + x : y");
  check(problem);
  const auto running = make_running_case(problem);
  const Snapshot snapshot = running->snapshot(0.0);
  for (int i = 1; i < 40; ++i) {
    const double x = 0.35 + 0.012 * i, y = (0.7 * std::sqrt(1.49) - x) / 0.7;
    if (y < 0.0 || y > 1.0) continue;
    for (const double height : {-0.03, -1e-3, 1e-3, 0.03}) {
      const Point place{x + height, y, 0.0};
      if (place[0] > 1.0) continue;
      // Linear on both sides: kept to rounding, also where a place is nearer to points of the other part.
      EXPECT_NEAR(snapshot.temperature_at(place), height < 0.0 ? 100.0 + place[0] : place[1], 1e-11);
    }
  }
}

TEST(TwoFieldDisplay, refines_its_raster_and_never_mixes_parts) {
  Grid grid;
  grid.dimension = 1;
  grid.cells = {4, 1, 1};
  grid.spacing = 0.25;
  DividedBody body;
  body.dimension = 1;
  body.parts.resize(2);
  for (int i = 0; i < 2; ++i) {
    body.parts[0].positions.push_back({0.125 + 0.25 * i, 0.0, 0.0});
    body.parts[0].places.push_back({i, 0, 0});
  }
  for (int i = 0; i < 4; ++i) {
    body.parts[1].positions.push_back({0.5625 + 0.125 * i, 0.0, 0.0});
    body.parts[1].places.push_back({i, 0, 0});
  }
  body.parts[0].spacing = 0.25;
  body.parts[1].spacing = 0.125;
  body.parts[1].material = 1;
  const TwoFieldDisplay display(grid, body,
                                [](const Point& place) { return static_cast<MaterialIndex>(place[0] > 0.5); });
  EXPECT_EQ(display.grid().cells[0], 8);
  EXPECT_EQ(display.materials(), (std::vector<MaterialIndex>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(display.point_of(3), 1);
  EXPECT_EQ(display.point_of(4), 2);
  const PlaceValue& between = display.value_at({0.25, 0.0, 0.0});
  ASSERT_EQ(between.points.size(), 2u);
  EXPECT_DOUBLE_EQ(between.points[0].second, 0.5);
  const PlaceValue& beside = display.value_at({0.49, 0.0, 0.0});
  ASSERT_EQ(beside.points.size(), 1u) << "nothing from beyond the interface";
  EXPECT_EQ(beside.points[0].first, 1u);
  EXPECT_NEAR(beside.offset[0], 0.115, 1e-15);
}

}  // namespace
}  // namespace peritherm
