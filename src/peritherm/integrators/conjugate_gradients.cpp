#include "peritherm/integrators/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace peritherm {
namespace {

/// Looking at the goal costs about as much as an iteration once there are many of them; this share more is no loss.
constexpr std::size_t iterations_per_look = 50;
/// The slowest rate over the loss rates is above the inverse of this, unless the direction holds nothing but rounding.
constexpr double longest = 1e12;

constexpr double level_rounding = 1e-12;  ///< of the rate of a level that nothing holds

/// Are all eigenvalues above x? They are if no pivot of the factorisation is negative.
bool all_above(double x, const std::vector<double>& lengths, const std::vector<double>& shares) {
  double pivot = 1.0 / lengths[0] - x;
  for (std::size_t k = 1; k < lengths.size() && pivot > 0.0; ++k) {
    const double coupling = shares[k - 1] / (lengths[k - 1] * lengths[k - 1]);
    pivot = 1.0 / lengths[k] + shares[k - 1] / lengths[k - 1] - x - coupling / pivot;
  }
  return pivot > 0.0;
}

}  // namespace

double smallest_ritz_value(const std::vector<double>& lengths, const std::vector<double>& shares) {
  double high = 1.0 / lengths[0];
  double low = high;
  while (low > 0.0 && !all_above(low, lengths, shares)) {
    high = low;
    low *= 0.25;
  }
  while (high > 1.01 * low && low > 0.0) {
    const double middle = std::sqrt(low * high);
    (all_above(middle, lengths, shares) ? low : high) = middle;
  }
  return high;
}

ConjugateGradients::ConjugateGradients(ThermalSystem& system, std::vector<double> loss_rates)
    : system_(system), inverse_(std::move(loss_rates)), direction_(system.size(), 1.0), image_(system.size(), 0.0) {
  weight_ = system_.heat_product(inverse_, direction_);
  for (double& value : inverse_) value = value > 0.0 ? 1.0 / value : 0.0;
}

/// image_ = inverse · residual.
void ConjugateGradients::precondition(ConstField residual) {
  const auto count = static_cast<std::ptrdiff_t>(system_.field_size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) image_[n] = inverse_[n] * residual[n];
}

/// Moves along the direction, whose image is known; then image_ = inverse · residual.
void ConjugateGradients::step(double length, Field temperature, Field residual) {
  const auto count = static_cast<std::ptrdiff_t>(system_.field_size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    temperature[n] += length * direction_[n];
    residual[n] -= length * image_[n];
    image_[n] = inverse_[n] * residual[n];
  }
}

/// direction_ = image_ + share · direction_.
void ConjugateGradients::turn(double share) {
  const auto count = static_cast<std::ptrdiff_t>(system_.field_size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) direction_[n] = image_[n] + share * direction_[n];
}

/// How fast the level of all temperatures decays, over the loss rates: the slowest of all where bodies are weakly held.
/// 0 if nothing holds it.
double ConjugateGradients::rate_of_level() {
  std::fill(direction_.begin(), direction_.end(), 1.0);
  system_.combine_linear(-1, direction_, -1.0, {}, image_);
  const double rate = system_.heat_product(direction_, image_) / weight_;
  return rate > level_rounding ? rate : 0.0;
}

/// ‖e‖ <= ‖residual‖ / slowest rate, in the norm of C · loss rate, divided by the weight.
double ConjugateGradients::error_of(double square) const {
  if (square == 0.0) return 0.0;
  return std::sqrt(square / weight_) / slowest_;
}

double ConjugateGradients::error(ConstField residual) {
  precondition(residual);
  return error_of(system_.heat_product(residual, image_));
}

ConjugateGradients::End ConjugateGradients::improve(Field temperature, Field residual, long most_iterations,
                                                    const Goal& goal, const AfterIteration& after_iteration) {
  if (slowest_ == 0.0) slowest_ = rate_of_level();
  precondition(residual);
  std::fill(direction_.begin(), direction_.end(), 0.0);
  turn(0.0);
  lengths_.clear();
  shares_.clear();
  double square = system_.heat_product(residual, image_);
  std::size_t next_look = 1;
  while (square != 0.0) {
    if (iterations_ >= most_iterations) return End::out_of_iterations;
    system_.combine_linear(-1, direction_, -1.0, {}, image_);
    const double curvature = system_.heat_product(direction_, image_);
    if (!(square < longest * curvature)) return End::out_of_digits;
    lengths_.push_back(square / curvature);
    step(lengths_.back(), temperature, residual);
    ++iterations_;
    if (!after_iteration(temperature)) return End::stopped;
    const double before = std::exchange(square, system_.heat_product(residual, image_));
    if (lengths_.size() >= next_look || square == 0.0) {
      const double ritz = smallest_ritz_value(lengths_, shares_);
      slowest_ = slowest_ > 0.0 ? std::min(slowest_, ritz) : ritz;
      // The smallest Ritz value lies above the slowest rate: half the goal leaves room for that.
      if (error_of(square) <= 0.5 * goal(temperature)) return End::converged;
      next_look = lengths_.size() + 1 + lengths_.size() / iterations_per_look;
    }
    shares_.push_back(square / before);
    turn(shares_.back());
  }
  return End::converged;
}

}  // namespace peritherm
