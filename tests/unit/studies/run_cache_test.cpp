#include "peritherm/studies/run_cache.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "peritherm/base/version.hpp"
#include "support/run_problem.hpp"
#include "support/study_folder.hpp"

namespace peritherm {
namespace {

Solution small_solution() {
  Problem problem = unit_body(2, 6, 2.0);
  problem.initial.temperature = Profile{std::string("x + 2*y")};
  Solution solution = solve(problem, std::vector{0.0, 0.01});
  solution.temperatures[0][3] = std::numeric_limits<double>::quiet_NaN();
  return solution;
}

TEST(RunCache, gives_back_what_it_was_given) {
  const StudyFolder folder("cache");
  const RunCache cache(folder.path());
  const Solution given = small_solution();
  EXPECT_FALSE(cache.find("a key").has_value());
  cache.keep("a key", given);
  const auto found = cache.find("a key");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->grid, given.grid);
  EXPECT_EQ(found->times, given.times);
  EXPECT_EQ(found->count.evaluations, given.count.evaluations);
  EXPECT_EQ(found->temperatures[1], given.temperatures[1]);
  EXPECT_TRUE(std::isnan(found->temperatures[0][3]));
}

TEST(RunCache, passes_over_damaged_files_and_those_of_other_keys) {
  const StudyFolder folder("damaged");
  const RunCache cache(folder.path());
  cache.keep("a key", small_solution());
  const std::filesystem::path file = cache.file_of("a key");
  std::filesystem::copy_file(file, cache.file_of("another key"));
  EXPECT_FALSE(cache.find("another key").has_value());
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 8);
  EXPECT_FALSE(cache.find("a key").has_value());
  std::ofstream(file, std::ios::binary) << "peritherm run 1\n{ \"key\": ";
  EXPECT_FALSE(cache.find("a key").has_value());
}

TEST(RunKey, knows_what_decides_the_temperatures_and_nothing_else) {
  const Problem problem = unit_body(1, 10, 3.0);
  const std::vector<double> times{0.5, 1.0};
  const std::string key = run_key(problem, times);
  Problem other = problem;
  other.title = "another title";
  other.numerics.threads = 3;
  EXPECT_EQ(run_key(other, times), key);
  other.nonlocality.horizon_ratio = 3.5;
  EXPECT_NE(run_key(other, times), key);
  EXPECT_NE(run_key(problem, std::vector{0.25, 1.0}), key);
}

TEST(RunKey, knows_the_version_and_the_content_of_the_files_that_a_problem_names) {
  const StudyFolder folder("key_of_files");
  Problem problem = unit_body(1, 10, 3.0);
  const std::vector<double> times{1.0};
  // With the commit, as the program tells it.
  EXPECT_EQ(run_key(problem, times).find("peritherm " + std::string(version()) + "\n"), 0U);
  problem.damage.emplace();
  problem.damage->table = folder.file("moves.csv");
  const std::string missing = run_key(problem, times);
  folder.write("moves.csv", "x,u\n0,1\n");
  const std::string first = run_key(problem, times);
  EXPECT_NE(first, missing);
  EXPECT_EQ(run_key(problem, times), first);
  folder.write("moves.csv", "x,u\n0,2\n");
  EXPECT_NE(run_key(problem, times), first);
}

}  // namespace
}  // namespace peritherm
