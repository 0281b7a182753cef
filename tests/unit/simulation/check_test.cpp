#include "peritherm/simulation/check.hpp"

#include <gtest/gtest.h>

#include "valid_case.hpp"

namespace peritherm {
namespace {

struct Mistake {
  std::string_view piece;
  std::string replacement;
  std::string key;
  int line;
  std::string words;
};

void expect_fault(const Mistake& fault) {
  const std::vector<Issue> issues = issues_of(changed(fault.piece, fault.replacement));
  ASSERT_EQ(issues.size(), 1u) << fault.replacement << "\n" << (issues.empty() ? "" : Error(issues).what());
  EXPECT_EQ(issues[0].where.key, fault.key) << to_string(issues[0]);
  EXPECT_EQ(issues[0].where.line, fault.line) << to_string(issues[0]);
  EXPECT_NE(to_string(issues[0]).find(fault.words), std::string::npos) << to_string(issues[0]);
}

std::string boundary(std::string_view text) { return "[[boundary]]\n" + std::string(text) + "\n[[crack]]"; }

TEST(Check, the_valid_case_has_no_fault) { EXPECT_TRUE(find_faults(read_case(valid_case, "").problem).empty()); }

TEST(Check, bodies_that_cannot_be_cut_into_cubes_name_what_would_fit) {
  expect_fault({"cells = [20, 20]", "cells = [20, 21]", "body.cells", 6,
                "cells are not cubes: their edges are [0.001, 0.000952380952] m. Choose cells = [20, 20], or size = "
                "[0.02, 0.021] m"});
  expect_fault(
      {"cells = [20, 20]", "spacing = \"3 mm\"", "body.spacing", 6,
       "3 mm does not divide the size [0.02, 0.02] m. Choose spacing = 2.85714286 mm (cells = [7, 7]), or size "
       "= [0.021, 0.021] m"});
  expect_fault({"cells = [20, 20]", "spacing = \"1e-20 m\"", "body.spacing", 6, "more than 1e9 cells"});
  expect_fault({"cells = [20, 20]", "cells = [1000000, 1000000]", "body.cells", 6, "points, more than 2147483647"});
  expect_fault({"cells = [20, 20]", "cells = [9223372036854775807, 20]", "body.cells.0", 6, "is too large"});
}

TEST(Check, entries_of_the_body_agree_in_number) {
  expect_fault({"cells = [20, 20]", "cells = [20]", "body.cells", 6, "has 1 entry, but size has 2"});
  expect_fault({"[\"-1 cm\", \"-1 cm\"]", "[\"-1 cm\"]", "body.origin", 4, "has 1 entry, but size has 2"});
  expect_fault({"size = [\"2 cm\", \"2 cm\"]", "size = [1, 1, 1, 1]", "body.size", 5, "Give 1, 2 or 3 lengths"});
}

TEST(Check, exactly_one_of_two_ways_is_given) {
  expect_fault({"cells = [20, 20]", "", "body", 3, "has neither cells nor spacing"});
  expect_fault({"points = \"boundary\"", "spacing = \"1 mm\"", "body", 3, "has both cells and spacing"});
  expect_fault({"horizon = \"3.5 mm\"", "", "nonlocality", 20, "has neither horizon nor horizon_ratio"});
  expect_fault({"kernel =", "horizon_ratio = 3\nkernel =", "nonlocality", 20, "has both horizon and horizon_ratio"});
  expect_fault({"every = \"0.1 s\"", "", "output.0", 44, "has neither every nor times"});
  expect_fault({"every = \"0.1 s\"", "every = 1\ntimes = [1]", "output.0", 44, "has both every and times"});
}

TEST(Check, a_single_point_along_an_axis_is_refused) {
  const std::string text =
      "format = 1\n[body]\nsize = [1]\ncells = [1]\nmaterial = \"a\"\n[materials.a]\nconductivity = 1\ndensity = "
      "1\nspecific_heat = 1\n[nonlocality]\nhorizon = 1\n[time]\nend = 1\n";
  const std::vector<Issue> issues = issues_of(text);
  ASSERT_EQ(issues.size(), 1u) << Error(issues).what();
  EXPECT_EQ(issues[0].problem, "leaves a single point along x");
  EXPECT_EQ(issues[0].where.line, 4);
}

TEST(Check, pictures_stay_in_the_folder_of_the_results) {
  expect_fault({"type = \"picture\"", "type = \"picture\"\nname = \"../evil\"", "output.1.name", 51,
                "'../evil' is no plain name of a file"});
}

TEST(Check, mistakes_of_all_parts_are_named_beside_cells_that_are_no_cubes) {
  const std::vector<Issue> issues =
      issues_of(changed("cells = [20, 20]", "cells = [20, 21]"), {"crack=[{points=[[0, 0]]}]", "output.0.at=[1, 1]"});
  std::vector<std::string> keys;
  for (const Issue& issue : issues) keys.push_back(issue.where.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"crack.0.points", "output.0.at", "body.cells"})) << Error(issues).what();
}

TEST(Check, the_horizon_reaches_neighbours_and_fits_the_body) {
  expect_fault({"\"3.5 mm\"", "\"3.5 Gm\"", "nonlocality.horizon", 21, "is too large for the body"});
  expect_fault({"\"3.5 mm\"", "\"0.4 mm\"", "nonlocality.horizon", 21,
                "horizon 400 um reaches no neighbour. Choose at least the spacing, 1 mm"});
  expect_fault({"horizon = \"3.5 mm\"", "horizon_ratio = 0.9", "nonlocality.horizon_ratio", 21, "Choose at least 1"});
  expect_fault({"\"3.5 mm\"", "\"2 cm\"", "nonlocality.horizon", 21, "Choose at most 19.5 mm"});
}

TEST(Check, the_shortest_and_the_longest_horizon_are_accepted) {
  EXPECT_TRUE(issues_of(changed("\"3.5 mm\"", "\"1 mm\"")).empty());
  EXPECT_TRUE(issues_of(changed("\"3.5 mm\"", "\"19.5 mm\"")).empty());
}

TEST(Check, materials_exist_and_are_not_void) {
  expect_fault({"material = \"plate\"", "material = \"plat\"", "body.material", 8,
                "material 'plat' does not exist. Did you mean 'plate'?"});
  expect_fault({"material = \"plate\"", "material = \"void\"", "body.material", 8, "cannot be void"});
  expect_fault({"material = \"fibre\"", "material = \"gold\"", "body.region.0.material", 10,
                "material 'gold' does not exist. Choose one of: fibre, plate"});
  expect_fault({"[initial]", "[materials.void]\nconductivity = 1\ndensity = 1\nspecific_heat = 1\n[initial]",
                "materials.void", 23, "Choose another name"});
  EXPECT_TRUE(issues_of(changed("material = \"fibre\"", "material = \"void\"")).empty());
}

TEST(Check, regions_contain_points_and_leave_some_of_the_body) {
  expect_fault({"[\"-4 mm\", \"-1 cm\"], to = [\"-2 mm\", \"1 cm\"]", "[1, 1], to = [2, 2]", "body.region.0.shape", 11,
                "contains no point of the body"});
  expect_fault({"to = [\"-2 mm\", \"1 cm\"]", "to = [\"-2 mm\"]", "body.region.0.shape", 11, "'to'"});
  std::string text = changed("material = \"fibre\"", "material = \"void\"");
  text.replace(text.find("{ type = \"box\""), text.find("[materials.plate]") - text.find("{ type = \"box\""),
               "{ type = \"ball\", centre = [0, 0], radius = 1 }\n");
  text.erase(text.find("[[output]]"));
  const std::vector<Issue> issues = issues_of(text);
  ASSERT_EQ(issues.size(), 1u) << Error(issues).what();
  EXPECT_EQ(issues[0].problem, "cuts away the whole body");
}

TEST(Check, the_horizon_suffices_for_the_quadrature_and_the_kernel_for_the_self_term) {
  for (const std::string rule : {"trapezoid", "cell_integrated"}) {
    expect_fault({"horizon = \"3.5 mm\"", "horizon_ratio = 1.4\npartial_volumes = \"" + rule + "\"",
                  "nonlocality.horizon_ratio", 21,
                  "horizon_ratio 1.4 is too small for partial_volumes = \"" + rule +
                      "\". Choose at least 1.5, or other partial_volumes"});
  }
  expect_fault({"horizon = \"3.5 mm\"", "horizon = \"1.4 mm\"\npartial_volumes = \"trapezoid\"", "nonlocality.horizon",
                21, "Choose at least 1.5 mm"});
  EXPECT_TRUE(
      issues_of(changed("horizon = \"3.5 mm\"", "horizon_ratio = 1.5\npartial_volumes = \"trapezoid\"")).empty());
  expect_fault({"exponent = 2 }", "exponent = 1 }\nself_term = \"bobaru_2012\"", "nonlocality.self_term", 23,
                "\"bobaru_2012\" belongs to kernels with exponent 2. Choose self_term = \"none\", or exponent = 2"});
}

TEST(Check, cracks_are_surfaces_inside_the_body) {
  expect_fault({"[[\"-5 mm\", \"-4.96 mm\"], [\"5 mm\", \"5.04 mm\"]]", "[[0, 0]]", "crack.0.points", 37,
                "a crack of a single point has no length"});
  expect_fault({"[[\"-5 mm\", \"-4.96 mm\"], [\"5 mm\", \"5.04 mm\"]]", "[[1, 1], [2, 2]]", "crack.0.points", 37,
                "the crack is outside the body. The body reaches in x from -0.01 to 0.01"});
  expect_fault({"[\"5 mm\", \"5.04 mm\"]", "[\"5 mm\"]", "crack.0.points", 37, "point 2"});
}

TEST(Check, faces_that_follow_their_temperatures_are_mirrored_ones_of_cracks_that_stand) {
  Problem problem = read_case(valid_case, "").problem;
  problem.cracks.front().gap = GapRadiation{{0.8, 0.6}, {}, -273.15};
  problem.cracks.front().tip_speed.reset();
  problem.cracks.front().start_time = 0.0;
  problem.cracks.front().faces = Faces::mirror;
  EXPECT_TRUE(find_faults(problem).empty());
  const auto only_fault = [&](CaseUse use = CaseUse::run) {
    const std::vector<Issue> issues = find_faults(problem, {}, use);
    return issues.size() == 1 ? to_string(issues[0]) : std::to_string(issues.size()) + " faults";
  };
  problem.cracks.front().faces = Faces::cut;
  EXPECT_NE(only_fault().find("crack.0.gap: radiates by the faces' own temperatures, which needs mirroring faces"),
            std::string::npos);
  problem.cracks.front().faces = Faces::mirror;
  problem.cracks.push_back(problem.cracks.front());
  problem.cracks.back().gap.reset();
  problem.cracks.back().tip_speed = 1.0;
  EXPECT_NE(only_fault().find("and crack.1 grows, appears or closes"), std::string::npos);
  problem.cracks.pop_back();
  problem.reduction.emplace();
  EXPECT_NE(only_fault(CaseUse::reduce).find("a reduced model is linear in these"), std::string::npos);
}

TEST(Check, faces_that_radiate_know_absolute_zero) {
  const std::string_view radiating = R"(format = 1
body = { size = [1], cells = [20], material = "m" }
materials.m = { conductivity = 1, density = 1, specific_heat = 1 }
nonlocality = { horizon_ratio = 3 }
initial = { temperature = "20 °C" }
crack = [{ points = [[0.5]], gap = { type = "radiation", emissivities = [0.8, 0.6] } }]
time = { end = 1 }
)";
  EXPECT_NO_THROW(read_case(radiating, "", {"initial.temperature=\"300 K\""}));
  EXPECT_NO_THROW(read_case(radiating, "", {"crack.0.gap.absolute_zero=-273.15"}));
  try {
    read_case(radiating, "");
    FAIL() << "0 °C was taken as absolute zero";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("Add absolute_zero = -273.15"), std::string::npos) << error.what();
  }
}

TEST(Check, tips_are_pulled_back_where_faces_mirror) {
  Problem problem = read_case(valid_case, "").problem;
  problem.cracks.resize(1);
  problem.nonlocality.tip_shift = GivenTipShift{0.1};
  problem.nonlocality.faces = Faces::cut;
  problem.cracks[0].tip_shift = GivenTipShift{0.2};
  const std::vector<Issue> issues = find_faults(problem);
  ASSERT_EQ(issues.size(), 2U);
  EXPECT_EQ(issues[0].where.key, "crack.0.tip_shift");
  EXPECT_EQ(issues[1].where.key, "nonlocality.tip_shift");
  problem.cracks.push_back(problem.cracks[0]);
  problem.cracks[0].faces = Faces::mirror;
  problem.cracks[1].tip_shift.reset();
  EXPECT_TRUE(find_faults(problem).empty());
  EXPECT_TRUE(find_faults(resolved(problem)).empty());
}

TEST(Check, expressions_parse_and_are_finite) {
  expect_fault({"\"60*(x < 0.05)\"", "\"60*(x <\"", "initial.temperature", 24, "unexpected end at position 8"});
  expect_fault({"\"60*(x < 0.05)\"", "\"20*t\"", "initial.temperature", 24, "cannot depend on t. Use x, y and z only"});
  expect_fault({"\"60*(x < 0.05)\"", "\"1/x\"", "initial.temperature", 24, "is not finite"});
  expect_fault({"value = 1000", "value = \"ln(x)\"", "source.0.value", 26, "is not finite"});
  expect_fault({"\"100 °C\"", "\"q*x\"", "boundary.0.value", 30, "unknown name or sign 'q' at position 1"});
  EXPECT_TRUE(issues_of(changed("\"100 °C\"", "\"1/y\"")).empty()) << "y is never 0 on y_max";
}

TEST(Check, boundaries_have_a_place_that_exists) {
  expect_fault({"face = \"y_max\"", "", "boundary.0", 27, "has neither face nor where"});
  expect_fault({"face = \"y_max\"", "face = \"z_max\"", "boundary.0.face", 28,
                "a 2-D body has no face 'z_max'. Choose one of: x_min, x_max, y_min, y_max"});
  expect_fault({"face = \"y_max\"", "face = \"y_max\"\nwhere = { type = \"ball\", centre = [0, 0], radius = 0.001 }",
                "boundary.0.where", 29, "selects no point of the face y_max"});
  expect_fault({"face = \"y_max\"", "where = { type = \"ball\", centre = [1, 0], radius = 0.001 }", "boundary.0.where",
                28, "contains no point of the body"});
}

TEST(Check, conditions_fit_their_place) {
  expect_fault({"[[crack]]",
                boundary("type = \"insulated\"\nwhere = { type = \"ball\", centre = [0, 0], radius = 0.001 }"),
                "boundary.2", 36, "needs a face"});
  expect_fault({"face = \"y_max\"", "where = { type = \"ball\", centre = [0, 0], radius = 0.001 }\nimposed = \"inner\"",
                "boundary.0.imposed", 29, "does not belong to a boundary without a face"});
  expect_fault({"face = \"y_max\"", "face = \"y_max\"\nthickness = \"1 mm\"", "boundary.0.thickness", 29,
                "belongs to imposed = \"inner\" only"});
  EXPECT_TRUE(
      issues_of(changed("face = \"y_max\"", "face = \"y_max\"\nimposed = \"inner\"\nthickness = 0.001")).empty());
}

TEST(Check, boundaries_do_not_overlap) {
  expect_fault({"[[crack]]", boundary("type = \"flux\"\nface = \"y_max\"\nvalue = 1"), "boundary.2", 36,
                "overlaps boundary.0 on the face y_max"});
  const std::string left =
      "type = \"flux\"\nface = \"x_max\"\nvalue = 1\nwhere = { type = \"box\", from = [0, -1], to = "
      "[1, 0] }\n[[boundary]]\ntype = \"flux\"\nface = \"x_max\"\nvalue = 1\nwhere = { type = "
      "\"box\", from = [0, ";
  expect_fault({"[[crack]]", boundary(left + "-0.001], to = [1, 1] }"), "boundary.3", 41, "overlaps boundary.2"});
  EXPECT_TRUE(issues_of(changed("[[crack]]", boundary(left + "0.0005], to = [1, 1] }"))).empty());
  const std::string held =
      "type = \"temperature\"\nvalue = 1\nwhere = { type = \"ball\", centre = [0, 0], radius = "
      "0.002 }\n";
  expect_fault({"[[crack]]", boundary(held + "[[boundary]]\n" + held), "boundary.3", 40, "overlaps boundary.2"});
}

TEST(Check, probes_stand_in_the_body) {
  expect_fault({"[0, 0.001]", "[0, 1]", "output.0.at", 47, "the probe is outside the body"});
  expect_fault({"[0, 0.001]", "[0]", "output.0.at", 47, "has 1 entry, but the body is 2-D"});
  std::string text = changed("material = \"fibre\"", "material = \"void\"");
  text.replace(text.find("[0, 0.001]"), 10, "[-0.003, 0]");
  const std::vector<Issue> issues = issues_of(text);
  ASSERT_EQ(issues.size(), 1u) << Error(issues).what();
  EXPECT_NE(issues[0].problem.find("cut away"), std::string::npos);
}

TEST(Check, probe_names_are_their_own) {
  expect_fault({"name = \"centre\"", "name = \"time\"", "output.0.name", 46, "heading of the first column"});
  expect_fault({"type = \"picture\"", "type = \"probe\"\nname = \"centre\"\nat = [0, 0]", "output.1.name", 51,
                "another probe is called 'centre' too"});
}

TEST(Check, outputs_lie_within_the_run) {
  expect_fault({"[\"1 s\", \"3 s\"]", "[\"1 s\", \"9 s\"]", "output.1.times.1", 51, "9 s is after the end of the run"});
  expect_fault({"[\"1 s\", \"3 s\"]", "[]", "output.1.times", 51, "is empty"});
  expect_fault({"\"0.1 s\"", "1e-9", "output.0.every", 48, "more than 1e6 outputs"});
  EXPECT_TRUE(issues_of(changed("\"0.1 s\"", "100")).empty()) << "a period beyond the end is harmless";
}

TEST(Check, pictures_show_something) {
  expect_fault({"type = \"picture\"", "type = \"picture\"\nrange = [3, 1]", "output.1.range", 51,
                "must be the lowest and the highest value"});
  expect_fault({"type = \"picture\"", "type = \"picture\"\nat = 0", "output.1.at", 51, "3-D bodies only"});
  expect_fault({"type = \"picture\"", "type = \"picture\"\nnormal = \"x\"", "output.1.normal", 51, "3-D bodies only"});
  expect_fault({"type = \"picture\"", "type = \"picture\"\nfield = \"material\"\nrange = [0, 1]", "output.1.range", 52,
                "for fields of values"});
}

TEST(Check, numbers_of_threads_and_steps_are_sensible) {
  expect_fault({"backend = \"auto\"", "threads = 2000", "numerics.threads", 40, "must lie between 0 and 1024"});
  expect_fault({"\"rkl2\"", "{ type = \"euler\", safety = 0 }", "time.integrator.safety", 43, "must be positive"});
}

TEST(Check, a_problem_made_by_a_program_is_checked_without_places) {
  Problem problem = read_case(valid_case, "").problem;
  problem.body.material = "gold";
  try {
    check(problem);
    FAIL() << "an unknown material passed";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("body.material: material 'gold' does not exist"), std::string::npos);
  }
}

TEST(Check, grid_and_horizon_follow_from_the_body) {
  Problem problem = read_case(valid_case, "").problem;
  const Grid grid = make_grid(problem);
  EXPECT_EQ(grid.dimension, 2);
  EXPECT_EQ(grid.cells, (GridIndex{20, 20, 1}));
  EXPECT_EQ(grid.origin, (Point{-0.01, -0.01, 0.0}));
  EXPECT_EQ(grid.spacing, 0.02 / 20);
  EXPECT_EQ(horizon_of(problem), 0.0035);
  problem.nonlocality.horizon.reset();
  problem.nonlocality.horizon_ratio = 4.0;
  EXPECT_EQ(horizon_of(problem), 4.0 * grid.spacing);
  problem.body.cells.reset();
  problem.body.spacing = 0.001;
  EXPECT_EQ(make_grid(problem), grid);
}

}  // namespace
}  // namespace peritherm
