#include <algorithm>
#include <cmath>

#include "check_property.hpp"
#include "measured_body.hpp"

namespace peritherm {
namespace {

/// A random body with a crack at least, whose cracks stand still and have faces that mirror.
Problem draw_mirrored(const BodyRequest& request) {
  Problem problem = *random_problem(request);
  RC_PRE(!problem.cracks.empty() && problem.nonlocality.scheme == Scheme::peritherm);
  for (Crack& crack : problem.cracks) {
    crack.tip_speed.reset();
    crack.start_time = 0.0;
    crack.faces = Faces::mirror;
  }
  RC_PRE(find_faults(problem).empty());
  return problem;
}

TEST(MirroredCracks, conduct_alike_by_stencil_and_bonds_and_keep_all_heat) {
  check_for_every_kernel({6, 1, 1}, [](const BodyRequest& request) {
    Problem problem = draw_mirrored(request);
    problem.boundaries.clear();
    problem.sources.clear();
    const MeasuredBody stencil = measure(problem, BackendName::stencil);
    const MeasuredBody bonds = measure(problem, BackendName::bond);
    std::vector<double> state = random_state(stencil.system().size(), draw(0, 1000));
    const std::vector<double> first = rates(stencil, state), second = rates(bonds, state);
    double sum = 0.0;
    for (std::size_t k = 0; k < first.size(); ++k) {
      RC_ASSERT(std::abs(first[k] - second[k]) <= 2.0 * stencil.rate_rounding(k, 1.0));
      sum += stencil.capacities[k] * first[k];
    }
    RC_ASSERT(std::abs(sum) <= stencil.heat_rounding(1.0));
    const ConductionOperator& conduction = stencil.system().conduction();
    double capacity = 0.0;
    for (const double own : stencil.capacities) capacity += own;
    RC_ASSERT(std::abs(conduction.heat_capacity() - capacity) <= 1e-12 * capacity);
    RC_ASSERT(std::abs(bonds.system().conduction().heat_capacity() - capacity) <= 1e-12 * capacity);
  });
}

TEST(MirroredCracks, make_no_point_cool_because_another_warms) {
  check_for_every_kernel({6, 1, 1}, [](const BodyRequest& request) {
    Problem problem = draw_mirrored(request);
    const MeasuredBody body = measure(problem, BackendName::stencil);
    for (std::size_t k = 0; k < body.entries.size(); ++k) {
      std::vector<double> found(body.system().size(), 0.0);
      body.system().conduction().visit_bonds(body.entries[k], [&](std::size_t j, double g) { found[j] += g; });
      for (const double g : found) RC_ASSERT(g >= -body.capacities[k] * body.rate_rounding(k, 1.0));
    }
  });
}

}  // namespace
}  // namespace peritherm
