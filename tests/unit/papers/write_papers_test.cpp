#include "peritherm/papers/write_papers.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <set>

#include "peritherm/base/error.hpp"
#include "peritherm/papers/bobaru_2010_bars.hpp"
#include "peritherm/papers/bobaru_2012_plates.hpp"
#include "peritherm/papers/paper.hpp"

namespace peritherm {
namespace {

namespace fs = std::filesystem;

fs::path empty_papers_folder(const std::string& name) {
  const fs::path path = fs::path(::testing::TempDir()) / ("peritherm_papers_" + name);
  fs::remove_all(path);
  return path;
}

TEST(Papers, have_distinct_names_and_examples_that_can_be_told_apart) {
  std::set<std::string> names;
  for (const Paper& paper : all_papers()) {
    EXPECT_TRUE(names.insert(paper.name).second) << paper.name;
    EXPECT_FALSE(paper.citation.empty()) << paper.name;
    std::set<std::string> titles;
    for (const PaperExample& example : paper.examples)
      EXPECT_TRUE(titles.insert(example.title).second) << example.title;
  }
}

TEST(WritePapers, refuses_unknown_names_with_a_suggestion) {
  PapersSettings settings;
  settings.names = {"bobaru_2011", "nobody"};
  settings.folder = empty_papers_folder("unknown");
  try {
    write_papers(settings);
    FAIL() << "unknown names were accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.issues().size(), 2U);
    EXPECT_NE(error.issues()[0].hint.find("bobaru_201"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(settings.folder));
}

TEST(WritePapers, keeps_a_folder_that_holds_something) {
  PapersSettings settings;
  settings.folder = empty_papers_folder("kept");
  fs::create_directories(settings.folder);
  std::ofstream(settings.folder / "notes.txt") << "mine";
  EXPECT_THROW(write_papers(settings), Error);
  EXPECT_FALSE(fs::exists(settings.folder / "report.html"));
}

TEST(WritePapers, leaves_a_report_when_it_is_stopped) {
  PapersSettings settings;
  settings.names = {"mei_2021"};
  settings.quick = true;
  settings.threads = 1;
  settings.folder = empty_papers_folder("stopped");
  std::atomic<bool> stop = false;
  // The first example needs no runs, so it is finished; the second one is stopped at its first run.
  settings.on_progress = [&stop](const PapersProgress& progress) { stop = progress.finished >= 1; };
  settings.stop_requested = [&stop] { return stop.load(); };
  const PapersSummary summary = write_papers(settings);
  EXPECT_TRUE(summary.stopped);
  EXPECT_EQ(summary.verdict.missing, 3U);
  EXPECT_GT(summary.verdict.judged, 0U);
  EXPECT_EQ(summary.verdict.failed, 0U) << (summary.failed.empty() ? "" : summary.failed.front());
  std::ifstream file(settings.folder / "report.html");
  const std::string html((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(html.find("Not finished: Section 3"), std::string::npos);
  EXPECT_NE(html.find("Section 2"), std::string::npos);
}

TEST(WritePapers, replaces_all_of_an_older_report_and_nothing_else) {
  PapersSettings settings;
  settings.names = {"mei_2021"};
  settings.quick = true;
  settings.threads = 1;
  settings.overwrite = true;
  settings.folder = empty_papers_folder("replaced");
  fs::create_directories(settings.folder / "pictures");
  const std::vector<std::string> old{"bobaru_2010.md", "pictures/2012_figure_09.png", "pictures/2021_figure_99.png"};
  const std::vector<std::string> others{"notes.md", "pictures/temperature_0000.png", "pictures/2012_notes.txt"};
  for (const std::string& name : old) std::ofstream(settings.folder / name) << "old";
  for (const std::string& name : others) std::ofstream(settings.folder / name) << "mine";
  settings.stop_requested = [] { return true; };
  EXPECT_TRUE(write_papers(settings).stopped);
  EXPECT_TRUE(fs::exists(settings.folder / "mei_2021.md"));
  for (const std::string& name : old) EXPECT_FALSE(fs::exists(settings.folder / name)) << name;
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(settings.folder / name)) << name;
}

TEST(PaperRuns, give_solutions_in_the_order_of_the_runs) {
  PaperRuns runs({.quick = true, .threads = 2, .folder = {}, .stop_requested = {}, .on_done = {}});
  const std::vector<Solution> solutions =
      runs.solve({scheme_run_of_2010({1, true, 100, 2}, {8.0}), default_run_of_2010({1, true, 100, 4}, {8.0})});
  EXPECT_EQ(solutions[0].grid.cells[0], 67);
  EXPECT_EQ(solutions[1].grid.cells[0], 134);
}

TEST(PaperRuns, hand_on_what_goes_wrong_in_a_run) {
  PaperRuns runs({.quick = true, .threads = 2, .folder = {}, .stop_requested = {}, .on_done = {}});
  PaperRun wrong = scheme_run_of_2010({1, true, 100, 2}, {8.0});
  wrong.problem.materials.clear();
  EXPECT_THROW(runs.solve({scheme_run_of_2010({1, true, 100, 2}, {8.0}), wrong}), Error);
}

TEST(BarFluxOf2010, is_exact_for_a_linear_temperature) {
  for (const bool constant : {true, false}) {
    const BarOf2010 bar{1, constant, 100, 4};
    PaperRuns runs({.quick = true, .threads = 1, .folder = {}, .stop_requested = {}, .on_done = {}});
    Solution solution = runs.solve(scheme_run_of_2010(bar, {0.0}));
    for (std::size_t n = 0; n < solution.temperatures[0].size(); ++n) {
      solution.temperatures[0][n] = 3.0 * solution.grid.position({static_cast<int>(n), 0, 0})[0] / centimetre;
    }
    for (const double flux : flux_of_2010(bar, solution, 0).flux) EXPECT_NEAR(flux, -3.0, 1e-11);
  }
}

TEST(ProbeTables, are_read_line_by_line) {
  const std::vector<ProbeLine> lines = probe_lines("\n60 0.5 scheme 1.5 - -2\n120 3 defaults 4 5 6");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].cells, 60);
  EXPECT_FALSE(lines[0].defaults);
  EXPECT_TRUE(std::isnan(lines[0].values[1]));
  EXPECT_EQ(lines[1].values[2], 6.0);
  EXPECT_TRUE(lines[1].defaults);
}

}  // namespace
}  // namespace peritherm
