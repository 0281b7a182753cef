#include <algorithm>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/two_field/constraint_preconditioner.hpp"
#include "peritherm/two_field/stage_matrix.hpp"
#include "peritherm/two_field/stage_solver.hpp"

namespace peritherm {
namespace {

constexpr long most_stage_iterations = 2000;
/// Of what the right side brings: below, rounding moves the residual; up to the second, iterations that rounding ends
/// have done what they can.
constexpr double rounding_share = 1e-15, enough_share = 1e-11;

/// The same bits for any number of threads.
double sum_of_products(ConstField a, ConstField b) {
  constexpr std::size_t chunk = 4096;
  std::vector<double> sums((a.size() + chunk - 1) / chunk, 0.0);
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < sums.size(); ++c) {
    double sum = 0.0;
    const std::size_t end = std::min(a.size(), (c + 1) * chunk);
    for (std::size_t n = c * chunk; n < end; ++n) sum += a[n] * b[n];
    sums[c] = sum;
  }
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum;
}

/// values += factor · other.
void add_multiple(double factor, ConstField other, Field values) {
  const auto count = static_cast<std::ptrdiff_t>(values.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) values[n] += factor * other[n];
}

/// values = other + factor · values.
void turn_towards(ConstField other, double factor, Field values) {
  const auto count = static_cast<std::ptrdiff_t>(values.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) values[n] = other[n] + factor * values[n];
}

/// Conjugate gradients among what keeps the rows: with (z, w) from the preconditioner and r = heat − A x − Φᵀ λ, zᵀ r
/// is positive, and so is pᵀ (A p + Φᵀ v) = pᵀ A p + vᵀ A R v along each direction (p, v).
class IterativeStage final : public StageSolver {
 public:
  IterativeStage(const TwoFieldSystem& system, double shift)
      : StageSolver(shift),
        matrix_(system, shift),
        preconditioner_(matrix_),
        residual_(system.size()),
        z_(system.size()),
        direction_(system.size()),
        image_(system.size()),
        left_(system.multipliers()),
        w_(system.multipliers()),
        turn_(system.multipliers()) {
    for (const double value : system.capacities()) capacity_ += value;
  }

  void set_resistance(const std::vector<double>& resistance) override {
    if (ready_ && resistance == resistance_) return;
    resistance_ = resistance;
    ready_ = true;
    preconditioner_.set_resistance(resistance);
    find_level();
  }

  void solve(ConstField heat, ConstField rows, double tolerance, Field x, Field multipliers) override {
    const auto measure = [&] {
      std::copy(heat.begin(), heat.end(), residual_.begin());
      std::copy(rows.begin(), rows.end(), left_.begin());
      matrix_.subtract(x, multipliers, resistance_, residual_, left_);
    };
    preconditioner_.solve(heat, rows, z_, w_);
    const double brought = std::abs(sum_of_products(heat, z_)) + std::abs(sum_of_products(rows, w_));
    measure();
    preconditioner_.solve(residual_, left_, z_, w_);
    add_multiple(1.0, z_, x);
    add_multiple(1.0, w_, multipliers);
    measure();
    iterate(tolerance, brought, x, multipliers);
    measure();
    preconditioner_.mend_rows(left_, z_, w_);
    add_multiple(1.0, z_, x);
    add_multiple(1.0, w_, multipliers);
    balance(heat, x, multipliers);
  }

  long iterations() const override { return iterations_; }
  long factorisations() const override { return preconditioner_.factorisations(); }

 private:
  void iterate(double tolerance, double brought, Field x, Field multipliers) {
    const std::vector<double> nothing(left_.size(), 0.0);
    preconditioner_.solve(residual_, nothing, z_, w_);
    direction_ = z_;
    turn_ = w_;
    // The error in the energy of A, which is above that of σ ρ c V.
    const double least =
        std::max(tolerance * tolerance * shift() * capacity_, rounding_share * rounding_share * brought);
    double square = sum_of_products(residual_, z_);
    for (long k = 0; square > least; ++k) {
      matrix_.product(direction_, image_);
      matrix_.system().contacts().add_adjoint(1.0, turn_, image_);
      const double curvature = sum_of_products(direction_, image_);
      if (!(curvature > 0.0) || k == most_stage_iterations) {
        if (square <= enough_share * enough_share * brought) return;
        give_up();
      }
      const double length = square / curvature;
      add_multiple(length, direction_, x);
      add_multiple(length, turn_, multipliers);
      add_multiple(-length, image_, residual_);
      preconditioner_.solve(residual_, nothing, z_, w_);
      const double before = square;
      square = sum_of_products(residual_, z_);
      turn_towards(z_, square / before, direction_);
      turn_towards(w_, square / before, turn_);
      ++iterations_;
    }
    if (!std::isfinite(square)) give_up();
  }

  /// A change that keeps the rows and takes heat in.
  void find_level() {
    const ConstField capacities = matrix_.system().capacities();
    level_.assign(capacities.size(), 0.0);
    level_turn_.assign(left_.size(), 0.0);
    const std::vector<double> nothing(left_.size(), 0.0);
    preconditioner_.solve(capacities, nothing, level_, level_turn_);
    matrix_.product(level_, image_);
    matrix_.system().contacts().add_adjoint(1.0, level_turn_, image_);
    level_heat_ = 0.0;
    for (const double value : image_) level_heat_ += value;
  }

  /// What the residual holds of heat goes into that change, so that heat balances to rounding.
  void balance(ConstField heat, Field x, Field multipliers) {
    matrix_.product(x, image_);
    matrix_.system().contacts().add_adjoint(1.0, multipliers, image_);
    double missing = 0.0;
    for (std::size_t n = 0; n < image_.size(); ++n) missing += heat[n] - image_[n];
    add_multiple(missing / level_heat_, level_, x);
    add_multiple(missing / level_heat_, level_turn_, multipliers);
  }

  [[noreturn]] static void give_up() {
    throw Error(
        "the temperatures of a step were not found: they, or loads, are not finite, or materials differ too much",
        "Look for expressions that jump or are not finite", Fault::numerics);
  }

  StageMatrix matrix_;
  ConstraintPreconditioner preconditioner_;
  std::vector<double> residual_, z_, direction_, image_;
  std::vector<double> left_, w_, turn_;
  std::vector<double> level_, level_turn_;
  std::vector<double> resistance_;
  double level_heat_ = 1.0;
  double capacity_ = 0.0;  ///< Σ ρ c V [J/K]
  long iterations_ = 0;
  bool ready_ = false;
};

}  // namespace

std::unique_ptr<StageSolver> make_iterative_stage(const TwoFieldSystem& system, double shift) {
  return std::make_unique<IterativeStage>(system, shift);
}

}  // namespace peritherm
