#include <map>

#include "check_property.hpp"
#include "measured_body.hpp"

namespace peritherm {
namespace {

using Conductances = std::map<std::pair<std::size_t, std::size_t>, double>;

/// What every point gives each place of the padded grid [W/K].
Conductances conductances(const MeasuredBody& body) {
  Conductances found;
  for (const std::size_t entry : body.entries) {
    body.system().conduction().visit_bonds(entry, [&](std::size_t j, double g) { found[{entry, j}] += g; });
  }
  return found;
}

TEST(Cracks, a_crack_only_lowers_exchange_and_a_conducting_one_does_so_less) {
  check_for_every_kernel({16, 12, 2}, [](BodyRequest request) {
    // A point on a crack is moved to one side, which would also change how other cracks and regions meet its bonds.
    request.ties = false;
    Problem problem = *random_problem(request);
    RC_PRE(!problem.cracks.empty());
    Crack crack = problem.cracks.back();
    problem.cracks.pop_back();
    crack.tip_speed.reset();
    problem.nonlocality.faces = Faces::cut;
    crack.start_time = 0.0;
    for (const BackendName backend : both_backends) {
      const MeasuredBody body = measure(problem, backend);
      const Conductances whole = conductances(body);
      Problem cracked = problem;
      cracked.cracks.push_back(crack);
      cracked.cracks.back().transmission = 0.0;
      Conductances cut = conductances(measure(cracked, backend));
      cracked.cracks.back().transmission = draw_real(0.0, 1.0);
      Conductances part = conductances(measure(cracked, backend));
      double largest = 0.0;
      for (const auto& [bond, g] : whole) largest = std::max(largest, g);
      for (const auto& [bond, g] : whole) {
        const double tolerance = rounding(8, largest);
        RC_ASSERT(cut[bond] >= -tolerance);
        RC_ASSERT(cut[bond] <= part[bond] + tolerance);
        RC_ASSERT(part[bond] <= g + tolerance);
      }
    }
  });
}

}  // namespace
}  // namespace peritherm
