#include "peritherm/simulation/read.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "valid_case.hpp"

namespace peritherm {
namespace {

struct ReadingMistake {
  std::string_view piece;
  std::string_view replacement;
  std::string key;
  int line;
  std::string words;
};

void expect_single_issue(const std::vector<Issue>& issues, const ReadingMistake& mistake) {
  ASSERT_EQ(issues.size(), 1u) << mistake.replacement << "\n" << (issues.empty() ? "" : Error(issues).what());
  EXPECT_EQ(issues[0].where.file, "case.toml");
  EXPECT_EQ(issues[0].where.key, mistake.key) << to_string(issues[0]);
  EXPECT_EQ(issues[0].where.line, mistake.line) << to_string(issues[0]);
  EXPECT_NE(to_string(issues[0]).find(mistake.words), std::string::npos) << to_string(issues[0]);
}

TEST(Read, a_valid_case_becomes_numbers_in_si_units) {
  const Problem problem = read_case(valid_case, "case.toml").problem;
  EXPECT_EQ(problem.title, "Two materials and a crack");
  EXPECT_EQ(problem.body.origin, (Coordinates{-0.01, -0.01}));
  EXPECT_EQ(problem.body.cells, (std::vector<int>{20, 20}));
  EXPECT_EQ(problem.body.points, PointPlacement::boundary);
  EXPECT_EQ(problem.body.regions.at(0).shape, Shape(Box{{-0.004, -0.01}, {-0.002, 0.01}}));
  EXPECT_EQ(problem.materials.at("plate"), (Material{114.0, 1e6, 1.0}));
  EXPECT_EQ(problem.nonlocality.horizon, 0.0035);
  EXPECT_EQ(problem.nonlocality.kernel, (Kernel{LinearKernel{}, 2}));
  EXPECT_EQ(problem.initial.temperature, Profile("60*(x < 0.05)"));
  EXPECT_EQ(problem.boundaries.at(0).face, Face::y_max);
  EXPECT_EQ(problem.boundaries.at(0).condition, BoundaryCondition(HeldTemperature{Profile(100.0), {}, {}}));
  EXPECT_EQ(problem.boundaries.at(1).condition, BoundaryCondition(Convection{5.0, Profile(20.0)}));
  EXPECT_EQ(problem.cracks.at(0).points.at(0), (Coordinates{-0.005, -0.00496}));
  EXPECT_EQ(problem.cracks.at(0).tip_speed, 0.002);
  EXPECT_EQ(problem.time.integrator, TimeStepping(RungeKuttaLegendre{}));
  EXPECT_EQ(problem.outputs.at(0).kind, OutputKind(ProbeOutput{"centre", {0.0, 0.001}}));
  EXPECT_EQ(problem.outputs.at(1).times, (std::vector<double>{1.0, 3.0}));
}

TEST(Read, every_key_knows_where_it_stands) {
  const Locations locations = read_case(valid_case, "case.toml").locations;
  EXPECT_EQ(locations.at("body.size.1").line, 5);
  EXPECT_EQ(locations.at("body.size.1").column, 17);
  EXPECT_EQ(locations.at("crack.0.points").line, 37);
  EXPECT_EQ(locations.at("materials.plate.density").file, "case.toml");
}

TEST(Read, one_mistake_gives_one_issue_with_key_line_and_words) {
  const ReadingMistake mistakes[] = {
      {"conductivity = \"1.14 W/(cm K)\"", "conductivity = -16", "materials.plate.conductivity", 13,
       "must be positive. Got -16 W/(m K)"},
      {"\"1 J/(kg K)\"", "\"3 mm\"", "materials.plate.specific_heat", 15,
       "unit 'mm' does not measure this quantity. Expected a multiple of J/(kg K)"},
      {"\"1 J/(kg K)\"", "true", "materials.plate.specific_heat", 15,
       "expected a number or a text with unit, got a boolean"},
      {"density = 3\n", "", "materials.fibre.density", 16, "is missing. Needed: density [kg/m^3]"},
      {"horizon =", "horzon =", "nonlocality.horzon", 21, "unknown option. Did you mean 'horizon'?"},
      {"[numerics]", "[numerix]", "numerix", 39, "Did you mean 'numerics'?"},
      {"backend", "colour", "numerics.colour", 40, "unknown option. Known here: backend, precision, threads"},
      {"\"linear\"", "\"cubic\"", "nonlocality.kernel.type", 22,
       "unknown type 'cubic'. Choose one of: constant, linear, quadratic, gaussian"},
      {"type = \"linear\", ", "", "nonlocality.kernel.type", 22, "is missing. Choose one of: constant, linear"},
      {"exponent = 2", "exponent = 3", "nonlocality.kernel.exponent", 22, "must be 0, 1 or 2. Got 3"},
      {"exponent = 2", "exponent = 1.5", "nonlocality.kernel.exponent", 22, "must be a whole number. Got 1.5"},
      {"exponent = 2", "sharpness = 2", "nonlocality.kernel.sharpness", 22,
       "does not belong here. It belongs to type gaussian"},
      {"\"boundary\"", "\"corner\"", "body.points", 7, "unknown choice 'corner'. Choose one of: centres, boundary"},
      {"type = \"convection\"", "type = \"conviction\"", "boundary.1.type", 33, "unknown type 'conviction'"},
      {"integrator = \"rkl2\"", "integrator = \"rkl3\"", "time.integrator.type", 43,
       "Choose one of: auto, chebyshev, rkl2, rk4, euler, steady, cvode, arkode"},
      {"integrator = \"rkl2\"", "integrator = 3", "time.integrator", 43, "expected a table with a type"},
      {"[[crack]]", "[crack]", "crack", 36, "expected a list of tables, got a table. Write [[crack]]"},
      {"title = \"Two", "title = 3 #", "title", 2, "expected a text, got a number"},
      {"[0, 0.001]", "0.001", "output.0.at", 47, "expected a list, got a number"},
      {"format = 1", "format = 2", "format", 1, "must be 1"},
      {"ambient = \"20 °C\"", "ambient = \"293 K\"", "boundary.1.ambient", 35,
       "is in K, but boundary.0.value is in °C. Write all temperatures"},
      {"density = 3", "density = inf", "materials.fibre.density", 18, "must be finite. Got inf"},
      {"density = 3", "density = nan", "materials.fibre.density", 18, "must be finite"},
      {"density = 3", "density = \"-inf\"", "materials.fibre.density", 18, "must be finite"},
      {"value = 1000", "value = nan", "source.0.value", 26, "must be finite"},
      {"value = 1000", "value = \"5 W\"", "source.0.value", 26, "Expected a multiple of W/m^3"},
      {"[0, 0.001]", "[0, inf]", "output.0.at.1", 47, "must be finite"},
      {"[20, 20]", "[99999999999, 20]", "body.cells.0", 6, "is too large"},
      {"\"2 mm/s\"", "\"-2 mm/s\"", "crack.0.tip_speed", 38, "must be positive. Got -0.002 m/s"},
      {"tip_speed = \"2 mm/s\"", "transmission = 1.5", "crack.0.transmission", 38, "must lie between 0 and 1. Got 1.5"},
  };
  for (const ReadingMistake& mistake : mistakes) {
    expect_single_issue(issues_of(changed(mistake.piece, mistake.replacement)), mistake);
  }
}

TEST(Read, text_that_is_no_toml_is_reported_with_its_place) {
  expect_single_issue(issues_of("format = 1\n[body\n"), {"", "[body", "", 2, "is no valid TOML"});
  expect_single_issue(issues_of("format = 1\nformat = 1\n"), {"", "format twice", "", 2, "is no valid TOML"});
}

TEST(Read, letters_beyond_ascii_outside_of_a_text_are_reported) {
  expect_single_issue(issues_of("format = 1\né = 2\n"), {"", "a bare key", "", 2, "is no valid TOML"});
  expect_single_issue(issues_of("format = 1 µ\n"), {"", "after a value", "", 1, "is no valid TOML"});
}

TEST(Read, all_mistakes_are_listed_at_once_in_the_order_of_the_file) {
  std::string text = changed("density = 3", "density = -3");
  text.replace(text.find("\"rkl2\""), 6, "\"rkl3\"");
  text.replace(text.find("material = \"fibre\""), 18, "material = \"fiber\"");
  const std::vector<Issue> issues = issues_of(text);
  ASSERT_EQ(issues.size(), 3u);
  EXPECT_EQ(issues[0].where.key, "body.region.0.material");
  EXPECT_EQ(issues[1].where.key, "materials.fibre.density");
  EXPECT_EQ(issues[2].where.key, "time.integrator.type");
}

TEST(Read, a_byte_order_mark_and_windows_line_ends_change_nothing) {
  std::string windows = "\xEF\xBB\xBF";
  for (const char letter : valid_case) {
    if (letter == '\n') windows += '\r';
    windows += letter;
  }
  const ReadCase plain = read_case(valid_case, "case.toml");
  const ReadCase other = read_case(windows, "case.toml");
  EXPECT_EQ(other.problem, plain.problem);
  EXPECT_EQ(other.locations.at("body.size").line, plain.locations.at("body.size").line);
}

TEST(Read, a_quantity_in_a_text_is_a_number_and_anything_else_an_expression) {
  const Problem problem = read_case(changed("value = 1000", "value = \"2 kW/m^3\""), "case.toml").problem;
  EXPECT_EQ(problem.sources[0].value, Profile(2000.0));
  EXPECT_EQ(read_case(changed("value = 1000", "value = \"2*x\""), "case.toml").problem.sources[0].value,
            Profile("2*x"));
}

TEST(Read, a_text_stands_for_a_table_with_that_type) {
  const Problem problem =
      read_case(changed("{ type = \"linear\", exponent = 2 }", "\"gaussian\""), "case.toml").problem;
  EXPECT_EQ(problem.nonlocality.kernel, (Kernel{GaussianKernel{}, Kernel{}.exponent}));
}

TEST(Read, overrides_replace_any_key) {
  const Problem problem =
      read_case(
          valid_case, "case.toml",
          {"crack.0.transmission=0.5", "body.material=fibre", "time.end=10 min", "nonlocality.kernel.exponent = 1",
           "time.integrator={ type = \"rk4\", step = 0.1 }", "numerics.threads=3", "output.1.times.0=2"})
          .problem;
  EXPECT_EQ(problem.cracks[0].transmission, 0.5);
  EXPECT_EQ(problem.body.material, "fibre");
  EXPECT_EQ(problem.time.end, 600.0);
  EXPECT_EQ(problem.nonlocality.kernel.exponent, 1);
  EXPECT_EQ(problem.time.integrator, TimeStepping(RungeKutta4{0.1}));
  EXPECT_EQ(problem.numerics.threads, 3);
  EXPECT_EQ(problem.outputs[1].times, (std::vector<double>{2.0, 3.0}));
}

TEST(Read, overrides_that_cannot_be_applied_are_issues_that_name_them) {
  const std::pair<std::string, std::string> wrong[] = {
      {"crack.3.transmission=1", "crack has no entry 3, it has 1"},
      {"crack.first.transmission=1", "'first' is no number of an entry"},
      {"crack.3=1", "has no entry 3"},
      {"threads", "sets nothing. Write key=value"},
      {"a b=1", "'a b' is no key"},
      {"=1", "is no key"},
      {"time.end.unit=1", "time.end is a single value"},
      {"crack.0.transmission=2", "crack.0.transmission: must lie between 0 and 1. Got 2"},
      {"crack.0.transmision=1", "Did you mean 'transmission'?"},
      {"time.end=inf", "must be finite"},
      {"colour=red", "colour: unknown option"},
      {"material.steel.density=1", "material: unknown option. Did you mean 'materials'?"},
      {"nonlocality.weight.power=1", "nonlocality.weight: unknown option"},
  };
  for (const auto& [text, words] : wrong) {
    const std::vector<Issue> issues = issues_of(std::string(valid_case), {text});
    ASSERT_EQ(issues.size(), 1u) << text;
    EXPECT_EQ(issues[0].where.file, "--set " + text);
    EXPECT_NE(to_string(issues[0]).find(words), std::string::npos) << to_string(issues[0]);
  }
}

TEST(Read, an_empty_case_is_an_error) {
  for (const char* text : {"", "\n\n", "# nothing\n"}) {
    expect_single_issue(issues_of(text), {"", "", "", 1, "is empty"});
  }
}

TEST(Read, missing_sections_are_listed) {
  const std::vector<Issue> issues = issues_of("format = 1\n");
  ASSERT_EQ(issues.size(), 4u) << Error(issues).what();
  EXPECT_EQ(issues[0].where.key, "body");
  EXPECT_EQ(issues[3].where.key, "time");
}

TEST(ReadFile, a_missing_file_and_a_folder_are_faults_of_the_machine) {
  const std::string folder = ::testing::TempDir();
  for (const std::string& path : {folder, folder + "/no_such_case.toml"}) {
    try {
      read_case_file(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::machine);
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
    }
  }
}

TEST(ReadFile, a_file_reads_like_its_text) {
  const std::string path = ::testing::TempDir() + "/peritherm_read_test.toml";
  std::ofstream(path) << valid_case;
  EXPECT_EQ(read_case_file(path).problem, read_case(valid_case, "case.toml").problem);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace peritherm
