#include "peritherm/reduction/condensation.hpp"

#include <algorithm>

#include "check_property.hpp"
#include "support/assembled_case.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

/// Only what no reduction by projection can do without is taken away: growth, and bonds that conduct one way.
void make_reducible(Problem& problem) {
  for (Crack& crack : problem.cracks) {
    crack.tip_speed.reset();
    crack.start_time = 0.0;
  }
  std::erase_if(problem.boundaries, [](const BoundaryOptions& boundary) {
    const auto* flux = std::get_if<PrescribedFlux>(&boundary.condition);
    const auto* insulated = std::get_if<Insulated>(&boundary.condition);
    const auto follows = [](Outside outside) { return outside == Outside::slaved || outside == Outside::flux_formula; };
    return (flux != nullptr && flux->imposed && follows(*flux->imposed)) ||
           (insulated != nullptr && insulated->imposed && follows(*insulated->imposed));
  });
  problem.nonlocality.self_term = SelfTerm::none;
}

/// Those of the body itself: nothing is truncated.
std::vector<double> body_rates(AssembledCase& body) {
  StaticCondensation all;
  all.retained.every = std::vector<int>{1};
  return reduce(all, body.full()).model.stages.front().equations.rates;
}

void expect_no_slower(const std::vector<double>& reduced, const std::vector<double>& full) {
  const double slack = rounding(full.size(), full.back());
  for (std::size_t k = 0; k < reduced.size(); ++k) RC_ASSERT(reduced[k] >= full[k] - slack);
}

// Rayleigh and Ritz: modes of a subspace decay no slower than those of the whole.
TEST(Condensation, never_decays_more_slowly_than_the_body) {
  check_for_every_kernel({4, 4, 1}, [](BodyRequest request) {
    request.expressions = false;
    request.fewest_cells = 4;
    request.most_cells = request.dimension == 3 ? 4 : request.dimension == 2 ? 8 : 14;
    Problem problem = *random_problem(request);
    make_reducible(problem);
    if (!find_faults(problem).empty()) return;
    AssembledCase body(problem);
    if (!body.system().is_symmetric()) return;
    StaticCondensation method;
    method.retained.share = draw_real(0.1, 0.7);
    method.retained.seed = draw(0, 1000);
    method.drop = draw_chance(50) ? 0.0 : 1e-4;
    CraigBampton with_modes{method.retained, draw(1, 5)};
    try {
      const std::vector<double> full = body_rates(body);
      expect_no_slower(reduce(method, body.full()).model.stages.front().equations.rates, full);
      expect_no_slower(reduce(with_modes, body.full()).model.stages.front().equations.rates, full);
    } catch (const Error& error) {
      // Pieces that the random choice has left alone, bodies that are held as a whole, and points that hardly follow
      // any retained one because what is held is so much nearer.
      const std::string message = error.what();
      RC_LOG(message);
      RC_ASSERT(message.find("without any retained point") != std::string::npos ||
                message.find("selects") != std::string::npos ||
                (method.drop > 0.0 && message.find("dropping shares") != std::string::npos));
    }
  });
}

}  // namespace
}  // namespace peritherm
