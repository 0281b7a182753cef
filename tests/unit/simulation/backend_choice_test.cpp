#include "peritherm/simulation/backend_choice.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <ctime>

#include "peritherm/operators/fourier_sum.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/plan.hpp"
#include "peritherm/simulation/read.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

constexpr double few = 100.0, very_many = 1e7;

/// One thread, so that the figures do not depend on what else runs.
class BackendChoiceTest : public testing::Test {
 protected:
  BackendChoiceTest() : threads_before_(omp_get_max_threads()) { omp_set_num_threads(1); }
  ~BackendChoiceTest() override { omp_set_num_threads(threads_before_); }

  static BackendChoice choose(const Problem& problem, double evaluations) {
    return choose_backend(problem, make_geometry(problem).stencil, 1, evaluations);
  }

 private:
  int threads_before_;
};

TEST_F(BackendChoiceTest, short_runs_are_not_measured_and_always_choose_alike) {
  const Problem problem = unit_body(2, 64, 4.0);
  const BackendChoice choice = choose(problem, few);
  EXPECT_FALSE(choice.measured);
  EXPECT_EQ(choice.backend, BackendName::stencil);
  EXPECT_NE(choice.reason.find("(estimated)"), std::string::npos) << choice.reason;
  EXPECT_EQ(choose(problem, few).reason, choice.reason);
  EXPECT_EQ(assemble(problem).backend, choice.backend);
}

TEST_F(BackendChoiceTest, a_backend_that_is_named_is_taken) {
  for (const BackendName name : {BackendName::stencil, BackendName::fourier, BackendName::bond}) {
    if (name == BackendName::fourier && !fourier_sum_available()) continue;
    Problem problem = unit_body(2, 40, 6.5);
    problem.numerics.backend = name;
    EXPECT_EQ(choose(problem, few).backend, name);
    EXPECT_EQ(choose(problem, very_many).backend, name);
    EXPECT_EQ(assemble(problem).backend, name);
  }
}

TEST_F(BackendChoiceTest, large_horizons_choose_the_transforms_and_small_ones_the_stencil) {
  if (!fourier_sum_available()) GTEST_SKIP() << "this build has no FFTW";
  EXPECT_EQ(choose(unit_body(2, 256, 40.0), few).backend, BackendName::fourier);
  EXPECT_EQ(choose(unit_body(2, 256, 40.0), very_many).backend, BackendName::fourier);
  EXPECT_EQ(choose(unit_body(3, 48, 2.0), few).backend, BackendName::stencil);
  EXPECT_EQ(choose(unit_body(2, 128, 2.0), very_many).backend, BackendName::stencil);
  EXPECT_EQ(choose(unit_body(1, 10000, 3.0), very_many).backend, BackendName::stencil);
}

TEST_F(BackendChoiceTest, long_runs_are_measured_quickly) {
  for (const double ratio : {3.0, 10.0, 13.0}) {
    const Problem problem = unit_body(2, 1024, ratio);
    const Stencil stencil = make_geometry(problem).stencil;
    const std::clock_t start = std::clock();
    const BackendChoice choice = choose_backend(problem, stencil, 1, very_many);
    EXPECT_TRUE(choice.measured);
    EXPECT_NE(choice.reason.find("(measured)"), std::string::npos) << choice.reason;
    EXPECT_GT(choice.evaluation_seconds, 0.0);
    // 0.3 s of the processor by intention; the rest is for slower ones and for sanitizers.
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 5.0);
  }
}

TEST_F(BackendChoiceTest, the_plan_counts_the_memory_of_the_transforms) {
  if (!fourier_sum_available()) GTEST_SKIP() << "this build has no FFTW";
  Problem problem = unit_body(2, 512, 20.0);
  problem.numerics.threads = 1;
  const int radius = make_geometry(problem).stencil.radius;
  EXPECT_EQ(backend_bytes(problem, BackendName::stencil, radius, 1), 0.0);
  const PaddedGrid layout(make_geometry(problem).body.grid, radius);
  const auto sum = make_fourier_sum(layout, make_geometry(problem).stencil, Precision::full);
  EXPECT_EQ(backend_bytes(problem, BackendName::fourier, radius, 1), static_cast<double>(sum->bytes()));
}

TEST_F(BackendChoiceTest, asking_for_transforms_without_fftw_is_a_fault_of_the_case) {
  Problem problem = unit_body(2, 20, 3.0);
  problem.numerics.backend = BackendName::fourier;
  const std::vector<Issue> faults = find_faults(problem);
  if (fourier_sum_available()) {
    EXPECT_TRUE(faults.empty());
    return;
  }
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].where.key, "numerics.backend");
  EXPECT_NE(faults[0].hint.find("PERITHERM_FFTW"), std::string::npos) << faults[0].hint;
}

TEST_F(BackendChoiceTest, what_was_chosen_is_prepared_for_the_run) {
  Problem problem = unit_body(2, 32, 3.0);
  problem.numerics.threads = 1;
  problem.numerics.precision = Precision::single;
  const Prepared prepared = prepare(problem);
  EXPECT_EQ(prepared.problem.numerics.backend, BackendName::stencil);
  const Plan found = plan(problem);
  EXPECT_EQ(found.backend, "stencil");
  EXPECT_EQ(found.precision, "single");
  EXPECT_EQ(found.backend_reason, prepared.choice.reason);
}

}  // namespace
}  // namespace peritherm
