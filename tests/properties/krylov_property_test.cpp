#include "check_property.hpp"
#include "peritherm/reduction/krylov_search.hpp"
#include "support/assembled_case.hpp"

namespace peritherm {
namespace {

std::unique_ptr<AssembledCase> random_reduced_case(BodyRequest request, bool closed) {
  request.expressions = false;
  request.most_cells = 8;
  Problem problem = *random_problem(request);
  for (Crack& crack : problem.cracks) {
    crack.tip_speed.reset();
    crack.start_time = 0.0;
  }
  if (closed) {
    std::erase_if(problem.boundaries, [](const BoundaryOptions& boundary) {
      return std::holds_alternative<HeldTemperature>(boundary.condition) ||
             std::holds_alternative<Convection>(boundary.condition);
    });
    problem.initial.temperature = Profile(std::string("sin(37*x)"));
  }
  problem.numerics.backend = draw_chance(50) ? BackendName::stencil : BackendName::bond;
  RC_PRE(find_faults(problem).empty());
  auto body = std::make_unique<AssembledCase>(problem, closed ? 0.1 : 0.0);
  RC_PRE(body->system().is_symmetric());
  RC_PRE(body->system().fastest_rate() > 0.0);
  RC_PRE(!body->system().body_changes_within(0.0, body->full().longest_time));
  return body;
}

TEST(KrylovProperty, rates_lie_above_those_of_the_full_system) {
  check_for_every_kernel({3, 2, 0}, [](const BodyRequest& request) {
    const auto body = random_reduced_case(request, false);
    ReductionCost cost;
    KrylovAim aim;
    aim.tolerance = 1e-4;
    aim.must_reach = false;
    const ReductionProgress unseen;
    KrylovSearch search(body->full(), aim, cost, unseen);
    search.run();
    const HeatBasis& basis = search.basis();
    HeatBasis all(body->system());
    std::vector<FieldStorage> states;
    for (std::size_t n = 0; n < all.capacities().size(); ++n) {
      if (all.capacities()[n] == 0.0) continue;
      states.emplace_back(all.capacities().size());
      states.back()[n] = 1.0;
    }
    all.add(std::move(states));
    const auto rates = [](const HeatBasis& of) {
      std::vector<double> values = project_equations(of, of.size(), Matrix(of.size(), 0)).equations.rates;
      std::sort(values.begin(), values.end());
      return values;
    };
    const std::vector<double> reduced = rates(basis), full = rates(all);
    RC_ASSERT(reduced.size() <= full.size());
    // Cauchy's interlacing, but for the rounding of the products and of the eigenvalue problem. Where cracks cut every
    // bond the rates are what is left of the stencil's after these were taken off, far below its own.
    const double scale = std::max(full.back(), body->system().fastest_rate());
    const double rounding = 1e-13 * static_cast<double>(full.size()) * scale;
    for (std::size_t k = 0; k < reduced.size(); ++k) {
      RC_ASSERT(reduced[k] >= full[k] - rounding);
      RC_ASSERT(reduced[k] <= full[full.size() - reduced.size() + k] + rounding);
    }
  });
}

TEST(KrylovProperty, closed_bodies_keep_their_heat) {
  check_for_every_kernel({3, 2, 0}, [](const BodyRequest& request) {
    const auto body = random_reduced_case(request, true);
    ReductionCost cost;
    KrylovAim aim;
    aim.tolerance = 1e-3;
    aim.must_reach = false;
    const ReductionProgress unseen;
    KrylovSearch search(body->full(), aim, cost, unseen);
    search.run();
    RC_PRE(search.basis().conserved() > 0 && search.basis().conserved() < 16);
    ReducedModel model;
    fill_model(search.basis(), search.inputs(), body->full(), 0, model);
    const ModalEquations& equations = model.stages.front().equations;
    const std::vector<double> unknowns = random_state(equations.size(), 5);
    double stored_rate = 0.0, entering = 0.0, scale = 0.0;
    for (std::size_t k = 0; k < equations.size(); ++k) {
      double slope = -equations.rates[k] * unknowns[k];
      for (std::size_t m = 0; m < body->inputs().size(); ++m) slope += equations.gains(k, m) * body->inputs()[m];
      stored_rate += model.heat.stored_modes[k] * slope;
      scale += std::sqrt(model.heat.heat_capacity) * std::abs(equations.rates[k] * unknowns[k]);
      for (std::size_t a = 0; a < model.heat.names.size(); ++a) entering += model.heat.modes(a, k) * unknowns[k];
    }
    for (std::size_t m = 0; m < body->inputs().size(); ++m) {
      for (std::size_t a = 0; a < model.heat.names.size(); ++a) {
        const double heat = model.heat.inputs(a, m) * body->inputs()[m];
        entering += heat;
        scale += std::abs(heat);
      }
    }
    // Sums over at most 64 points of products that cancel.
    RC_ASSERT(std::abs(stored_rate - entering) <= 1e-13 * 64.0 * scale);
  });
}

}  // namespace
}  // namespace peritherm
