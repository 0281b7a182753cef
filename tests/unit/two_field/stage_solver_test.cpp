#include "peritherm/two_field/stage_solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "peritherm/two_field/stage_matrix.hpp"
#include "support/differences.hpp"
#include "support/two_layers.hpp"

namespace peritherm {
namespace {

std::vector<double> random_values(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(size);
  for (double& value : values) value = uniform(random);
  return values;
}

struct StageSolution {
  std::vector<double> x, multipliers, heat, rows;  ///< with what is left of the right sides
  long iterations = 0;
};

StageSolution solve_stage(const TwoFieldSystem& system, StageMethod method, double shift, double tolerance) {
  StageSolution result{std::vector<double>(system.size(), 0.0), std::vector<double>(system.multipliers(), 0.0),
                       random_values(system.size(), 1), random_values(system.multipliers(), 2)};
  for (std::size_t n = 0; n < system.size(); ++n) result.heat[n] *= shift * system.capacities()[n];
  for (std::size_t r = 0; r < system.multipliers(); ++r) result.rows[r] *= system.rows()[r].area;
  const auto solver = make_stage_solver(method, system, shift);
  const std::vector<double> resistance = system.resistances(0.0);
  solver->set_resistance(resistance);
  solver->solve(result.heat, result.rows, tolerance, result.x, result.multipliers);
  StageMatrix(system, shift).subtract(result.x, result.multipliers, resistance, result.heat, result.rows);
  for (std::size_t r = 0; r < system.multipliers(); ++r) result.rows[r] /= system.rows()[r].area;
  result.iterations = solver->iterations();
  return result;
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

const auto zero_outside = [](double) { return 0.0; };

TEST(StageSolver, directly_leaves_nothing) {
  for (const TwoLayers& layers : two_layers) {
    const TwoFieldSystem system = make_two_layers(layers, 20, 3.0, zero_outside);
    const StageSolution found = solve_stage(system, StageMethod::direct, 50.0, 0.0);
    EXPECT_LT(largest(found.rows), 1e-14) << layers.name;
    EXPECT_LT(largest(found.heat), 1e-12) << layers.name;
  }
}

TEST(StageSolver, by_iterations_finds_what_it_finds_directly) {
  for (const TwoLayers& layers : two_layers) {
    const TwoFieldSystem system = make_two_plates(layers, 10, 3.0, zero_outside);
    for (const double shift : {1.0, 1000.0}) {
      const StageSolution direct = solve_stage(system, StageMethod::direct, shift, 0.0);
      const StageSolution found = solve_stage(system, StageMethod::iterative, shift, 1e-12);
      // The energy holds all errors; one point may hold them all.
      const double most = 1e-12 * std::sqrt(static_cast<double>(system.size()) * 4.0);
      EXPECT_LT(largest_difference(found.x, direct.x), most) << layers.name << ", " << shift;
      EXPECT_LT(largest(found.rows), 1e-14) << layers.name << ", " << shift;
      EXPECT_LT(found.iterations, 80) << layers.name << ", " << shift;
    }
  }
}

TEST(StageSolver, by_iterations_balances_heat_whatever_the_tolerance) {
  for (const TwoLayers& layers : two_layers) {
    const TwoFieldSystem system = make_two_plates(layers, 10, 3.0, zero_outside);
    const StageSolution found = solve_stage(system, StageMethod::iterative, 100.0, 1e-2);
    // Rows of the matrix sum to what is stored but for the rounding of their terms.
    const std::vector<double> diagonal = StageMatrix(system, 100.0).diagonal();
    double terms = 0.0;
    for (std::size_t n = 0; n < diagonal.size(); ++n) terms += 2.0 * diagonal[n] * std::abs(found.x[n]);
    const double rounding = std::numeric_limits<double>::epsilon() * terms;
    EXPECT_NEAR(std::accumulate(found.heat.begin(), found.heat.end(), 0.0), 0.0, rounding) << layers.name;
  }
}

}  // namespace
}  // namespace peritherm
