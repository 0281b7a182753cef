#include <gtest/gtest.h>

#include "peritherm/papers/galadima_cases.hpp"
#include "support/published.hpp"

namespace peritherm {
namespace {

constexpr double galadima_bar_times[] = {10.0, 20.0, 30.0};

Solution solve_galadima_bar(Problem problem) {
  problem.numerics.threads = 1;
  return solve(problem, galadima_bar_times);
}

TEST(GaladimaBar, has_the_reference_temperatures_for_the_three_response_functions) {
  const Published published("galadima_bar");
  for (std::size_t row = 0; row < published.size(); ++row) {
    const BarOfGaladima bar{static_cast<int>(published.number(row, "exponent")), 3.0, Calibration::discrete};
    const Solution solution = solve_galadima_bar(galadima_bar(bar));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string column = "t" + std::to_string(static_cast<int>(galadima_bar_times[k]));
      EXPECT_NEAR(solution.temperatures[k][49], published.number(row, column), 5.1e-9) << row << ' ' << column;
    }
  }
}

/// Step by step with the paper's 0.01 s, horizon 3.015 spacings; the program itself refuses such a step.
TEST(GaladimaBar, grows_without_bound_with_the_step_of_the_paper_for_f1) {
  const Problem problem = galadima_bar({2, 3.015, Calibration::continuum});
  const auto temperatures = euler_regardless(problem, 1e-2, {10.0, 20.0, 30.0});
  const double reference[] = {-1.6e21, -2.6e47, -4.2e73};
  const double half_digits[] = {0.05e21, 0.05e47, 0.05e73};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(temperatures[k][49], reference[k], half_digits[k]) << galadima_bar_times[k];
  }
}

/// Raw constants of the paper, horizon 3 and 3.015 spacings; longest stable steps and conductivities of the reference.
TEST(GaladimaBar, has_the_stability_limits_and_conductivities_of_the_reference) {
  struct Row {
    int exponent;
    double ratio, step, half_digit, conductivity;
  };
  for (const Row& row : {Row{2, 3.0, 9.643e-3, 5e-7, 1.0}, Row{2, 3.015, 9.692e-3, 5e-7, 0.99502},
                         Row{0, 3.015, 1.51e-2, 5e-5, 1.53245}, Row{1, 3.015, 1.22e-2, 5e-5, 1.32010}}) {
    const BondFacts facts = bond_facts(galadima_bar({row.exponent, row.ratio, Calibration::continuum}));
    EXPECT_NEAR(2.0 / facts.fastest_rate, row.step, row.half_digit) << row.exponent << ' ' << row.ratio;
    EXPECT_NEAR(facts.effective_conductivity, row.conductivity, 5.1e-6) << row.exponent << ' ' << row.ratio;
  }
}

TEST(GaladimaBar, is_stable_with_that_step_for_f2_and_f3) {
  for (const int exponent : {0, 1}) {
    Problem problem = galadima_bar({exponent, 3.015, Calibration::continuum});
    problem.time.integrator = ForwardEuler{1e-2};
    for (const std::vector<double>& values : solve_galadima_bar(problem).temperatures) {
      EXPECT_LE(*std::max_element(values.begin(), values.end()), 1.0 + 1e-12);
      EXPECT_GE(*std::min_element(values.begin(), values.end()), 0.0);
    }
  }
}

}  // namespace
}  // namespace peritherm
