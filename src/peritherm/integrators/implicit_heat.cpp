#include "peritherm/integrators/implicit_heat.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/integrators/loss_rates.hpp"

namespace peritherm {
namespace {

constexpr long most_implicit_iterations = 100000;

Field whole(FieldStorage& storage) { return {storage.data(), storage.size()}; }

/// values += weight · other, within the body.
void add_within(ConstField body, double weight, ConstField other, Field values) {
  const auto count = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) values[n] += weight * body[n] * other[n];
}

}  // namespace

ImplicitHeat::ImplicitHeat(ThermalSystem& system, bool preconditions)
    : system_(system),
      body_(system.size()),
      direction_(system.size()),
      image_(system.size()),
      preconditioned_(preconditions ? system.size() : 0) {
  std::vector<double> ones(system.size(), 1.0);
  if (preconditions) {
    std::vector<double> scratch(system.size());
    loss_rates_.assign(system.size(), 0.0);
    estimate_loss_rates(system, loss_rates_, ones, scratch);
    evaluations_ += loss_rate_probes;
    std::fill(ones.begin(), ones.end(), 1.0);
  }
  // Combining without the rate leaves everything but the points of the body as it was.
  const Term terms[] = {{1.0, ones.data()}};
  std::vector<double> other(system.size(), 0.0);
  system.combine_linear(-1, other, 0.0, terms, whole(body_));
  std::fill(body_.begin() + system.field_size(), body_.end(), 0.0);
  capacity_ = system.heat_product(ones, ones);
}

/// preconditioned = residual / (1 + γ · loss rate).
void ImplicitHeat::precondition(double gamma, ConstField residual) {
  const auto count = static_cast<std::ptrdiff_t>(residual.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) preconditioned_[n] = residual[n] / (1.0 + gamma * loss_rates_[n]);
}

/// image = (I − γ A) direction.
void ImplicitHeat::apply(double gamma) {
  const Term itself[] = {{1.0, direction_.data()}};
  system_.combine_linear(-1, whole(direction_), -gamma, itself, whole(image_));
  ++evaluations_;
}

void ImplicitHeat::spread_residual(Field residual, Field solution) const {
  const ConstField ones = body();
  const double left = system_.heat_product(residual, ones) / capacity_;
  for (std::size_t n = 0; n < system_.field_size(); ++n) solution[n] += left * body_[n];
  // Accounts stand in their own rows as 1, so what is left of their residual is what they lack.
  for (std::size_t n = system_.field_size(); n < solution.size(); ++n) solution[n] = residual[n];
}

void ImplicitHeat::solve(double gamma, double tolerance, Field right, Field solution) {
  for (std::size_t n = system_.field_size(); n < solution.size(); ++n) solution[n] = 0.0;
  std::copy(solution.begin(), solution.end(), direction_.begin());
  apply(gamma);
  const Field residual = right;
  const auto count = static_cast<std::ptrdiff_t>(right.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) residual[n] -= image_[n];
  const double least = tolerance * tolerance * capacity_;
  double before = 0.0;
  for (long k = 0;; ++k) {
    const double plain = system_.heat_product(residual, residual);
    if (plain <= least) break;
    const bool preconditions = !loss_rates_.empty();
    if (preconditions) precondition(gamma, residual);
    const ConstField values = preconditions ? ConstField(whole(preconditioned_)) : ConstField(residual);
    const double square = preconditions ? system_.heat_product(residual, values) : plain;
    const double share = k == 0 ? 0.0 : square / before;
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t n = 0; n < count; ++n) direction_[n] = body_[n] * (values[n] + share * direction_[n]);
    apply(gamma);
    const double curvature = system_.heat_product(whole(direction_), whole(image_));
    if (!(curvature > 0.0) || k == most_implicit_iterations) {
      throw Error("the integrator gs4 cannot solve for a step: temperatures or loads are not finite", {},
                  Fault::numerics);
    }
    before = square;
    add_within(body(), square / curvature, {direction_.data(), direction_.size()}, solution);
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t n = 0; n < count; ++n) residual[n] -= square / curvature * image_[n];
  }
  spread_residual(residual, solution);
}

}  // namespace peritherm
