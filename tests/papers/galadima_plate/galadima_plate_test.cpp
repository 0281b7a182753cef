#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "peritherm/papers/galadima_cases.hpp"
#include "support/published.hpp"

namespace peritherm {
namespace {

constexpr double galadima_plate_times[] = {7e-5, 7e-4, 7e-3};

Solution solve_galadima_plate(const std::string& load, double step) {
  Problem problem = galadima_plate(load == "held" ? PlateLoad::held : PlateLoad::heated);
  problem.numerics.threads = 1;
  if (step > 0.0) problem.time.integrator = ForwardEuler{step};
  return solve(problem, galadima_plate_times);
}

/// Half of the last digit that a reference is written with.
double half_digit(const std::string& text) {
  const std::size_t exponent = text.find('e');
  const std::string mantissa = text.substr(0, exponent);
  const std::size_t point = mantissa.find('.');
  const double power = exponent == std::string::npos ? 0.0 : std::stod(text.substr(exponent + 1));
  return 0.5 * std::pow(10.0, power - static_cast<double>(mantissa.size() - point - 1));
}

TEST(GaladimaPlate, has_the_reference_temperatures_for_both_loads_and_both_ways_in_time) {
  const Published published("galadima_plate");
  std::map<std::pair<std::string, double>, Solution> solutions;
  for (std::size_t row = 0; row < published.size(); ++row) {
    const std::pair run{published.text(row, "load"), published.number(row, "step")};
    if (!solutions.contains(run)) solutions[run] = solve_galadima_plate(run.first, run.second);
    const std::size_t point =
        plate_point(static_cast<int>(published.number(row, "row")), static_cast<int>(published.number(row, "column")));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string column = "t" + std::to_string(k + 1);
      // The march leaves 1e-12 of the span of temperatures per output.
      const double span = run.first == "held" ? 1.0 : 1100.0;
      EXPECT_NEAR(solutions[run].temperatures[k][point], published.number(row, column),
                  half_digit(published.text(row, column)) + 3e-12 * span)
          << run.first << ' ' << run.second << " row " << row << ' ' << column;
    }
  }
}

TEST(GaladimaPlate, heats_on_average_as_its_source_says) {
  const Solution solution = solve_galadima_plate("heated", 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double>& values = solution.temperatures[k];
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    EXPECT_NEAR(mean, plate_heating * galadima_plate_times[k] / plate_points, 1e-9 * mean);
  }
}

/// λ_max without held points, to all digits that the reference gives.
TEST(GaladimaPlate, has_the_bonds_and_the_fastest_rate_of_the_reference) {
  const BondFacts facts = bond_facts(galadima_plate(PlateLoad::heated));
  EXPECT_EQ(facts.bonds, 110178.0);
  EXPECT_EQ(facts.cut_bonds, 262.0);
  EXPECT_NEAR(facts.effective_conductivity, 1.0254, 5.1e-7);
  EXPECT_NEAR(facts.fastest_rate, 1436361.58, 0.0051);
}

}  // namespace
}  // namespace peritherm
