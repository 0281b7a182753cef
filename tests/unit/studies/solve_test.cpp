#include "peritherm/studies/solve.hpp"

#include <gtest/gtest.h>

#include "peritherm/solutions/exact_solution.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

TEST(Solve, reaches_the_classical_solution_with_order_two) {
  const ExactSolution exact = HeldEnds{.length = 1.0, .diffusivity = 1.0, .start = 1.0};
  std::vector<double> spacings, errors;
  for (const int cells : {20, 40, 80}) {
    Problem problem = unit_body(1, cells, 3.0);
    problem.initial.temperature = 1.0;
    set_all_faces(problem, held_at(0.0));
    const Solution solution = solve(problem, std::vector{0.0, 0.05, 0.1});
    ASSERT_EQ(solution.times.size(), 3U);
    EXPECT_EQ(solution.temperatures[0][0], 1.0);
    spacings.push_back(solution.grid.spacing);
    errors.push_back(std::abs(solution.at(2, {0.5, 0, 0}) - temperature(exact, {0.5, 0, 0}, 0.1)));
  }
  EXPECT_NEAR(order_of_convergence(spacings, errors), 2.0, 0.1);
}

TEST(Solve, keeps_what_it_has_when_it_is_stopped) {
  Problem problem = unit_body(1, 20, 3.0);
  problem.time.integrator = RungeKuttaLegendre{};
  int asked = 0;
  const Solution solution = solve(problem, std::vector{0.1, 0.2}, [&asked] { return ++asked > 1; });
  EXPECT_LT(solution.times.size(), 2U);
}

}  // namespace
}  // namespace peritherm
