#include <gtest/gtest.h>

#include <numbers>

#include "peritherm/system/spectral_estimate.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// Bonds of a chain with nothing outside: λ = 4 G/C sin²(kπ/2n), k = n − 1 the fastest.
TEST(LanczosRate, keeps_all_digits_however_many_steps_it_takes_beside_open_faces) {
  constexpr int count = 40;
  Problem problem = unit_body(1, count, 1.0);
  problem.nonlocality.kernel = {ConstantKernel{}, 0};
  problem.nonlocality.partial_volumes = PartialVolumes::whole;
  Insulated open;
  open.imposed = Outside::natural;
  set_all_faces(problem, open);
  March march(problem);
  const double sine = std::sin(std::numbers::pi * (count - 1) / (2.0 * count));
  const double fastest = 4.0 * count * count * sine * sine;
  for (const std::size_t steps : {count, 2 * count, 4 * count}) {
    const double found = fastest_rate_after(*march.assembly().system, steps);
    EXPECT_NEAR(found, fastest, 1e-12 * fastest) << steps;
  }
}

}  // namespace
}  // namespace peritherm
