#include <algorithm>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/krylov_search.hpp"
#include "peritherm/reduction/model_products.hpp"

namespace peritherm {
namespace {

/// Of the judge; far below what condensed models reach.
constexpr double judge_tolerance = 1e-6;
constexpr double judge_over_snapshots = 0.1;  ///< its tolerance over that of a model from snapshots
constexpr std::size_t most_judge_unknowns = 200;

double tolerance_of_judge(const ReductionMethod& method) {
  const auto* snapshots = std::get_if<ProperOrthogonal>(&method);
  return snapshots == nullptr ? judge_tolerance
                              : std::clamp(judge_over_snapshots * snapshots->tolerance, 1e-9, judge_tolerance);
}

std::vector<double> weighted(const std::vector<double>& capacities, ConstField values) {
  std::vector<double> result(values.size());
  for (std::size_t n = 0; n < values.size(); ++n) result[n] = capacities[n] * values[n];
  return result;
}

double product_of(ConstField a, ConstField b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[n];
  return sum;
}

/// Σ C (judge's basis) · (basis, direct).
Matrix cross_products(const ReducedModel& model, const Matrix& judge) {
  const std::size_t unknowns = model.unknowns(), inputs = model.inputs();
  Matrix cross(judge.columns, unknowns + inputs);
  for (std::size_t j = 0; j < judge.columns; ++j) {
    const std::vector<double> heat = weighted(model.capacities, judge.column(j));
    const std::vector<double> shares = basis_product(model.basis, heat);
    for (std::size_t k = 0; k < unknowns; ++k) cross(j, k) = shares[k];
    for (std::size_t m = 0; m < inputs; ++m) cross(j, unknowns + m) = product_of(heat, model.direct.column(m));
  }
  return cross;
}

/// Σ C (basis, direct) · (basis, direct); empty if inputs move no free point and the basis is orthonormal.
Matrix own_products(const ReducedModel& model) {
  const std::size_t unknowns = model.unknowns(), inputs = model.inputs();
  Matrix products(unknowns + inputs, unknowns + inputs);
  bool plain = model.lumped_capacities.empty();
  for (std::size_t k = 0; k < unknowns; ++k) {
    products(k, k) = 1.0;
    // Modes of lumped capacities are orthonormal in those only.
    if (model.lumped_capacities.empty()) continue;
    std::vector<double> unit(unknowns, 0.0), column(model.capacities.size(), 0.0);
    unit[k] = 1.0;
    add_lifted(model.basis, unit, column);
    const std::vector<double> shares = basis_product(model.basis, weighted(model.capacities, column));
    std::copy(shares.begin(), shares.end(), products.column(k).begin());
  }
  for (std::size_t m = 0; m < inputs; ++m) {
    const std::vector<double> heat = weighted(model.capacities, model.direct.column(m));
    plain = plain && std::all_of(heat.begin(), heat.end(), [](double value) { return value == 0.0; });
    const std::vector<double> shares = basis_product(model.basis, heat);
    for (std::size_t k = 0; k < unknowns; ++k) {
      products(k, unknowns + m) = products(unknowns + m, k) = shares[k];
    }
    for (std::size_t i = 0; i < inputs; ++i) {
      products(unknowns + i, unknowns + m) = product_of(heat, model.direct.column(i));
    }
  }
  return plain ? Matrix{} : products;
}

}  // namespace

void add_judge(ReducedModel& model, FullSystem& full, ReductionCost& cost) {
  // Where Krylov subspaces do not apply, the model stays without a judge.
  if (!full.system.is_symmetric() || full.system.body_changes_within(0.0, full.longest_time)) return;
  KrylovAim aim;
  aim.tolerance = tolerance_of_judge(model.method);
  aim.most_unknowns = most_judge_unknowns;
  aim.must_reach = false;
  const ReductionProgress unseen;
  KrylovSearch search(full, aim, cost, unseen);
  search.run();
  const HeatBasis& basis = search.basis();
  if (basis.size() == 0) return;
  ProjectedEquations projected = project_equations(basis, basis.size(), input_gains(basis, search.inputs()));
  ErrorJudge judge;
  judge.start = gather_columns(full.layout, basis.states(), projected.modes);
  judge.cross = cross_products(model, judge.start);
  judge.products = own_products(model);
  judge.equations = std::move(projected.equations);
  model.judge = std::move(judge);
}

}  // namespace peritherm
