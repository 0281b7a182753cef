#include "peritherm/studies/solve.hpp"

#include <gtest/gtest.h>
#include <omp.h>

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

TEST(Solve, takes_the_threads_that_a_prepared_problem_was_given_later) {
  const int before = omp_get_max_threads();
  Problem problem = unit_body(1, 20, 3.0);
  problem.numerics.threads = 1;
  Prepared prepared = prepare_to_solve(problem, std::vector{0.1});
  EXPECT_NE(prepared.problem.numerics.backend, BackendName::automatic);
  prepared.threads = 3;
  const Solution solution = solve(prepared, std::vector{0.1});
  EXPECT_EQ(omp_get_max_threads(), 3);
  EXPECT_EQ(solution.temperatures, solve(problem, std::vector{0.1}).temperatures);
  omp_set_num_threads(before);
}

TEST(Solve, refuses_temperatures_that_are_not_finite_with_place_and_time) {
  Problem problem = unit_body(2, 10, 2.0);
  // Passes the largest number, 1.8e308, between the two times.
  HeatSource source;
  source.value = 1e308;
  problem.sources.push_back(source);
  problem.time.integrator = RungeKutta4{};
  try {
    solve(problem, std::vector{0.5, 4.0});
    ADD_FAILURE() << "nothing was said";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::numerics) << error.what();
    EXPECT_NE(std::string(error.what()).find("not finite at t = 4 s, first at (0.05, 0.05) m"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace peritherm
