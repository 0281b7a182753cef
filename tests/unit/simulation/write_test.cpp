#include "peritherm/simulation/write.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/option_kinds.hpp"
#include "valid_case.hpp"

namespace peritherm {
namespace {

double positive_number() {
  return *rc::gen::map(rc::gen::inRange(1, 1'000'000), [](int n) { return n / 7e3; });
}

Profile any_profile() {
  const bool number = *rc::gen::arbitrary<bool>();
  return number ? Profile(positive_number()) : Profile(*rc::gen::elementOf(std::vector<std::string>{"x + y", "2*x^2"}));
}

/// A random alternative of a list, with default options.
template <class Choice>
Choice any_alternative() {
  std::vector<Choice> all;
  for_each_alternative<Choice>([&all](const auto& alternative) { all.emplace_back(alternative); });
  return all[*rc::gen::inRange<std::size_t>(0, all.size())];
}

template <NamedEnum Enum>
Enum any_value() {
  const auto& values = EnumNames<Enum>::values;
  return values[*rc::gen::inRange<std::size_t>(0, values.size())].first;
}

/// A case without fault on a square with 16 cells along each axis.
Problem any_problem() {
  Problem problem;
  problem.title = *rc::gen::string<std::string>();
  for (char& letter : problem.title) letter = static_cast<char>(letter & 0x7f);
  const double side = positive_number();
  problem.body.size = {side, side};
  if (*rc::gen::arbitrary<bool>()) problem.body.origin = Coordinates{-positive_number(), positive_number()};
  if (*rc::gen::arbitrary<bool>()) {
    problem.body.cells = std::vector<int>{16, 16};
  } else {
    problem.body.spacing = side / 16;
  }
  problem.body.points = any_value<PointPlacement>();
  problem.body.material = "a material with blanks";
  problem.materials["a material with blanks"] = {positive_number(), positive_number(), positive_number()};
  problem.materials["b"] = {positive_number(), positive_number(), positive_number()};
  problem.nonlocality.horizon_ratio = 1.5 + *rc::gen::inRange(0, 1000) / 77.0;
  problem.nonlocality.kernel = {any_alternative<KernelForm>(), *rc::gen::inRange(0, 3)};
  problem.nonlocality.calibration = any_value<Calibration>();
  problem.nonlocality.partial_volumes = any_value<PartialVolumes>();
  if (problem.nonlocality.kernel.exponent == 2) problem.nonlocality.self_term = any_value<SelfTerm>();
  problem.nonlocality.interface = any_value<InterfaceRule>();
  problem.initial.temperature = any_profile();
  problem.time = {positive_number(), any_alternative<TimeStepping>()};
  // Of two fields only, like the tables of contacts below.
  if (std::holds_alternative<DifferentialAlgebraic>(problem.time.integrator)) problem.time.integrator = Chebyshev{};
  return problem;
}

void add_lists(Problem& problem) {
  const Coordinates origin = problem.body.origin.value_or(Coordinates{0.0, 0.0});
  const double side = problem.body.size[0];
  const Coordinates middle{origin[0] + side / 2, origin[1] + side / 2};
  if (*rc::gen::arbitrary<bool>()) problem.body.regions.push_back({"b", Ball{middle, side / 4}});
  if (*rc::gen::arbitrary<bool>()) problem.sources.push_back({any_profile(), HalfSpace{{1.0, 0.0}, middle[0]}});
  BoundaryCondition condition = any_alternative<BoundaryCondition>();
  if (auto* held = std::get_if<HeldTemperature>(&condition)) *held = {any_profile(), Imposed::inner, side / 5};
  if (auto* convection = std::get_if<Convection>(&condition)) *convection = {positive_number(), any_profile()};
  problem.boundaries.push_back({make_face(*rc::gen::inRange(0, 2), *rc::gen::arbitrary<bool>()), {}, condition});
  Crack crack;
  crack.points = {origin, middle};
  crack.transmission = *rc::gen::inRange(0, 11) / 10.0;
  const TimeStepping& stepping = problem.time.integrator;
  const bool may_grow = !std::holds_alternative<BackwardDifferences>(stepping) &&
                        !std::holds_alternative<ImplicitRungeKutta>(stepping) &&
                        !std::holds_alternative<GeneralisedSingleStep>(stepping);
  if (may_grow && *rc::gen::arbitrary<bool>()) crack.tip_speed = positive_number();
  problem.cracks.push_back(crack);
  OutputKind kind = any_alternative<OutputKind>();
  if (std::holds_alternative<ContactOutput>(kind)) kind = EnergyOutput{};
  if (auto* probe = std::get_if<ProbeOutput>(&kind)) *probe = {"a \"quoted\"\tname", middle};
  if (auto* picture = std::get_if<PictureOutput>(&kind)) picture->range = Coordinates{0.0, 1.0 / 3.0};
  if (auto* line = std::get_if<LineOutput>(&kind)) line->exact = LumpedBody{1.0, -1.0, positive_number()};
  if (auto* vtk = std::get_if<VtkOutput>(&kind)) vtk->fields = {FieldName::damage};
  problem.outputs.push_back({{}, std::vector<double>{0.0, problem.time.end / 3}, kind});
}

RC_GTEST_PROP(Write, what_was_written_reads_back_as_the_same_problem, ()) {
  Problem problem = any_problem();
  add_lists(problem);
  // What the schemes' boundaries rule out.
  if (!is_symmetric(resolved(problem))) problem.time.integrator = RungeKuttaLegendre{};
  if (needs_bond_backend(resolved(problem))) problem.numerics.backend = BackendName::bond;
  RC_ASSERT(read_case(write_problem(problem), "written.toml").problem == resolved(problem));
}

TEST(Write, the_valid_case_reads_back_as_the_same_problem) {
  const Problem problem = read_case(valid_case, "case.toml").problem;
  EXPECT_EQ(read_case(write_problem(problem), "written.toml").problem, resolved(problem));
}

TEST(Write, every_default_is_filled_in) {
  const std::string text = write_problem(read_case(valid_case, "case.toml").problem);
  for (const char* line : {"calibration = \"discrete\"", "partial_volumes = \"partial_area\"", "threads = 0",
                           "integrator = { type = \"rkl2\", relative_tolerance = 1e-05 }", "transmission = 0",
                           "imposed = \"mirror\"", "[[body.region]]", "[materials.plate]"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  }
}

TEST(Write, a_disc_in_three_dimensions_reads_back) {
  Problem problem = read_case(valid_case, "case.toml").problem;
  problem.body.size = {0.02, 0.02, 0.02};
  problem.body.origin.reset();
  problem.body.cells = std::vector<int>{8, 8, 8};
  problem.body.regions = {{"void", Polygon{{{0.0, 0.0}, {0.01, 0.0}, {0.0, 0.01}}}},
                          {"fibre", Cylinder{{0.015, 0.015, 0.0}, {0.015, 0.015, 0.02}, 0.004}}};
  problem.nonlocality.horizon = 0.006;
  problem.cracks[0].points.clear();
  problem.cracks[0].disc = Disc{{0.01, 0.01, 0.01}, {0.0, 0.0, 1.0}, 0.005};
  problem.outputs[0].kind = EnergyOutput{};
  EXPECT_EQ(read_case(write_problem(problem), "written.toml").problem, resolved(problem));
}

}  // namespace
}  // namespace peritherm
