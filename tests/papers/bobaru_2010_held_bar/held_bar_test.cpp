#include <gtest/gtest.h>

#include "peritherm/solutions/classical.hpp"
#include "peritherm/studies/solve.hpp"
#include "support/published.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

constexpr double held_bar_end = 8.0;
constexpr Slab held_bar{10.0, 1.14};

/// Example 1 of the 2010 paper as its authors solved it, in centimetres.
Problem published_held_bar(const Published& published, std::size_t row) {
  Problem problem = unit_body(1, static_cast<int>(published.number(row, "cells")), published.number(row, "ratio"));
  problem.body.size = {held_bar.length};
  problem.materials["body"].conductivity = held_bar.diffusivity;
  problem.nonlocality.scheme = Scheme::bobaru_2010;
  if (published.text(row, "kernel") == "constant") problem.nonlocality.kernel.form = ConstantKernel{};
  problem.initial.temperature = 100.0;
  problem.time.integrator = Chebyshev{1e-11};
  set_all_faces(problem, HeldTemperature{0.0, std::nullopt, std::nullopt});
  return problem;
}

/// The norm that the 2010 paper plots.
double plotted_norm(const Solution& solution) {
  double sum = 0.0;
  const std::vector<double>& values = solution.temperatures.front();
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double x = solution.grid.position(solution.grid.index(n))[0];
    const double classical = 100.0 * slab_with_held_ends(held_bar, x, held_bar_end);
    sum += std::pow((classical - values[n]) / classical, 2);
  }
  return std::sqrt(sum) / static_cast<double>(values.size());
}

TEST(HeldBar, has_the_reference_temperatures_in_the_scheme_of_2010) {
  const Published published("bobaru_2010_held_bar");
  for (std::size_t row = 0; row < published.size(); ++row) {
    const Solution solution = solve(published_held_bar(published, row), std::vector{held_bar_end});
    EXPECT_NEAR(solution.at(0, {5.0, 0.0, 0.0}), published.number(row, "middle"), published.number(row, "half_digit"))
        << row;
    if (published.number(row, "half_digit") > 1e-6) continue;
    const double norm = published.number(row, "norm");
    EXPECT_NEAR(plotted_norm(solution), norm, 1e-6 * norm) << row;
  }
}

}  // namespace
}  // namespace peritherm
