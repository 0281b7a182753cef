#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/displacement_series.hpp"
#include "peritherm/simulation/scheme.hpp"
#include "peritherm/simulation/write.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"
#include "valid_case.hpp"

namespace peritherm {
namespace {

std::string with_damage(std::string_view lines) {
  return changed("[numerics]", "[damage]\n" + std::string(lines) + "\n[numerics]");
}

/// A file that is removed at the end.
class TableFile {
 public:
  explicit TableFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() / ("peritherm_table_" + std::to_string(getpid()) + ".csv")) {
    std::ofstream(path_) << text;
  }
  ~TableFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// A bar of four points that is stretched until the end, 1 s.
Problem bar_with_table(const std::string& path) {
  Problem problem = unit_body(1, 4, 1.5);
  DamageOptions& damage = problem.damage.emplace();
  damage.critical_elongation = 0.1;
  damage.table = path;
  return problem;
}

std::string whole_table() {
  return "# four points\nt,x,ux\n0,0.125,0\n0,0.375,0\n0,0.625,0\n0,0.875,0\n\n"
         "1,0.125,0.05\r\n1, 0.375, 0.15\n1,0.6250001,+0.25\n1,0.875,0.35\n";
}

std::string replaced(std::string text, std::string_view piece, std::string_view replacement) {
  return text.replace(text.find(piece), piece.size(), replacement);
}

/// What `check` says of a table, one line each.
std::vector<std::string> faults_of_table(const std::string& text) {
  const TableFile file(text);
  std::vector<std::string> lines;
  for (const Issue& issue : find_faults(bar_with_table(file.path()))) {
    EXPECT_EQ(issue.where.key, "damage.table");
    lines.push_back(replaced(to_string(issue), file.path(), "FILE"));
  }
  return lines;
}

void expect_table_fault(const std::string& text, const std::string& words) {
  const std::vector<std::string> lines = faults_of_table(text);
  ASSERT_EQ(lines.size(), 1U) << words << '\n' << join(lines, "\n");
  EXPECT_NE(lines[0].find(words), std::string::npos) << lines[0];
}

TEST(DamageInput, every_mistake_is_reported_at_once) {
  const auto issues = issues_of(
      with_damage("critical_elongation = -0.1\ntransmission = 2\ndisplacement = [\"x +\", \"1/(x - x)\", \"t\"]"));
  std::string all;
  for (const Issue& issue : issues) all += to_string(issue) + '\n';
  for (const char* part :
       {"damage.critical_elongation: must be positive", "damage.transmission: must lie between",
        "damage.displacement: has 3 entries, but the body is 2-D", "damage.displacement.0: expression",
        "damage.displacement.1: expression '1/(x - x)' is not finite"}) {
    EXPECT_NE(all.find(part), std::string::npos) << part << '\n' << all;
  }
  EXPECT_EQ(issues.size(), 5U) << all;
}

TEST(DamageInput, what_is_missing_or_too_much_is_named) {
  const auto only = [](std::string_view lines, const std::string& words) {
    const auto issues = issues_of(with_damage("critical_elongation = 0.1\n" + std::string(lines)));
    ASSERT_EQ(issues.size(), 1U) << words;
    EXPECT_NE(to_string(issues[0]).find(words), std::string::npos) << to_string(issues[0]);
  };
  only("", "damage: has neither displacement nor table. Give one of them");
  only("displacement = [0, 0]\ntable = \"a.csv\"", "damage: has both displacement and table. Leave one of them out");
  only("displacement = [\"t*x\", 0]", "damage: displacement depends on t, and every is missing. Say how often");
  only("displacement = [\"t*x\", 0]\nevery = \"1 ns\"", "damage.every: makes more than 1e6 looks");
  only("displacement = [\"x\", 0]\nevery = 1", "damage.every: displacement does not depend on t, one look is all");
  only("displacement = [\"x +\", 0]\nevery = 1", "damage.displacement.0: expression");
  only("displacement = [\"1 K\", 0]", "damage.displacement.0: unit 'K' does not measure this quantity");
  const TableFile file("t,x,y,ux,uy\n");
  const auto both = issues_of(with_damage("critical_elongation = 0.1\nevery = 1\ntable = \"" + file.path() + "\""));
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].where.key, "damage.every") << to_string(both[0]);
  only("table = \"/dev/zero\"", "cannot read '/dev/zero'");
  only("table = \"none.csv\"", "none.csv'. Check that the file exists and may be read; its name is relative to");
  const auto missing = issues_of(with_damage("displacement = [0, 0]"));
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_EQ(missing[0].where.key, "damage.critical_elongation");
}

TEST(DamageInput, reads_back_what_was_written) {
  const Problem problem = read_case(with_damage("critical_elongation = 0.01\ntransmission = 0.5\n"
                                                "displacement = [\"1e-4*t*x\", \"2 mm\"]\nevery = \"0.5 s\""),
                                    "case.toml")
                              .problem;
  ASSERT_TRUE(problem.damage.has_value());
  EXPECT_EQ((*problem.damage->displacement)[1], Profile(0.002));
  const std::string text = write_problem(problem);
  EXPECT_NE(text.find("\n[damage]\ncritical_elongation = 0.01\n"), std::string::npos) << text;
  EXPECT_EQ(read_case(text, "written.toml").problem, resolved(problem));
}

TEST(DamageInput, a_table_stands_beside_its_case) {
  const auto issues = issues_of(with_damage("critical_elongation = 0.1\ntable = \"sub/none.csv\""));
  ASSERT_EQ(issues.size(), 1U);
  const std::string path = (std::filesystem::current_path() / "sub/none.csv").string();
  EXPECT_NE(issues[0].problem.find("'" + path + "'"), std::string::npos) << issues[0].problem;
}

TEST(DamageInput, tables_say_what_is_wrong_and_where) {
  EXPECT_EQ(faults_of_table(whole_table()), std::vector<std::string>{});
  expect_table_fault("", "'FILE' is empty. Begin with the line t,x,ux");
  expect_table_fault("t,x,y,ux,uy\n", "'FILE' line 1: is no heading for a 1-D body. Begin with the line t,x,ux");
  expect_table_fault("t,x,ux\n", "'FILE' has no rows");
  const std::string table = whole_table();
  expect_table_fault(replaced(table, "1,0.875,0.35\n", ""), "'FILE' misses 1 point at t = 1 s, the first at (0.875) m");
  expect_table_fault(replaced(table, "0,0.625,0\n", "0,0.625,0\n0,0.625,0\n"),
                     "line 6: the point at (0.625) m stands twice at t = 0 s");
  EXPECT_NE(faults_of_table(replaced(table, "0,0.625,0", "0,0.63,0"))[0].find(
                "line 5: no point of the body stands at (0.63) m. The nearest is at (0.625) m"),
            std::string::npos);
  expect_table_fault(replaced(table, "1,0.125", "-1,0.125"), "line 8: t = -1 s comes after t = 0 s. Sort the rows");
  expect_table_fault(table.substr(0, table.find("\n\n")),
                     "ends at t = 0 s, before the run does. Let it reach time.end");
  expect_table_fault("t,x,ux\n" + table.substr(table.find("1,0.125")), "begins at t = 1 s, after the run does");
  const std::vector<std::string> rows =
      faults_of_table(replaced(replaced(table, "0,0.375,0", "0,0.375"), "+0.25", "inf"));
  ASSERT_EQ(rows.size(), 4U) << join(rows, "\n");
  EXPECT_NE(rows[0].find("line 4: has 2 columns instead of 3. Write t,x,ux"), std::string::npos);
  EXPECT_NE(rows[2].find("line 10: 'inf' is no finite number"), std::string::npos) << rows[2];
}

TEST(DamageInput, a_long_list_of_faults_is_cut_short) {
  std::string text = "t,x,ux\n";
  for (int row = 0; row < 1000; ++row) text += "0,nothing,0\n";
  const std::vector<std::string> lines = faults_of_table(text);
  ASSERT_EQ(lines.size(), 11U);
  EXPECT_NE(lines.back().find("further faults"), std::string::npos);
}

TEST(DamageInput, a_table_breaks_what_its_expression_breaks) {
  Problem problem = unit_body(2, 10, 2.5);
  problem.body.regions.push_back({"void", Box{{0.4, 0.4}, {0.6, 0.6}}});
  DamageOptions& damage = problem.damage.emplace();
  damage.critical_elongation = 0.02;
  damage.displacement = {Profile("0.05*x*t^2 + 0.02*y"), Profile("0.03*(x - y)*t")};
  damage.every = 0.25;
  const Geometry expected = make_geometry(problem);
  std::ostringstream text;
  text.precision(17);
  text << "t,x,y,ux,uy\n";
  for (int look = 0; look <= 4; ++look) {
    const double t = 0.25 * look;
    for (std::size_t n = 0; n < expected.body.grid.size(); ++n) {
      if (expected.body.material_of[n] == no_material) continue;
      const Point p = expected.body.grid.position(expected.body.grid.index(n));
      text << t << ',' << p[0] << ',' << p[1] << ',' << 0.05 * p[0] * t * t + 0.02 * p[1] << ','
           << 0.03 * (p[0] - p[1]) * t << '\n';
    }
  }
  const TableFile file(text.str());
  damage.displacement.reset();
  damage.every.reset();
  damage.table = file.path();
  check(problem);
  const Geometry found = make_geometry(problem);
  ASSERT_GT(expected.body.broken.size(), 100U);
  ASSERT_EQ(found.body.broken.size(), expected.body.broken.size());
  for (const std::int64_t point : expected.body.broken.points()) {
    const auto first = expected.body.broken.row(static_cast<std::size_t>(point));
    const auto second = found.body.broken.row(static_cast<std::size_t>(point));
    ASSERT_TRUE(std::equal(first.bonds.begin(), first.bonds.end(), second.bonds.begin(), second.bonds.end()));
    for (std::size_t k = 0; k < first.times.size(); ++k) {
      // Coordinates hold ten spacings, and the slowest bonds grow by a fifth of the critical elongation in a second.
      EXPECT_NEAR(first.times[k], second.times[k], rounding(10 * 8, 1.0));
    }
  }
}

TEST(DamageInput, a_table_that_changed_since_it_was_checked_is_refused) {
  const TableFile file(replaced(whole_table(), "1,0.875,0.35\n", ""));
  EXPECT_THROW(make_geometry(bar_with_table(file.path())), Error);
}

}  // namespace
}  // namespace peritherm
