#pragma once

#include <functional>
#include <vector>

#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// Preconditioned conjugate gradients [hestenes1952] for the temperature at which the rate vanishes, in the heat
/// product, in which minus the linear part of the rate is symmetric. Along each part of a body that nothing holds and
/// where the loss rates are all the same, they leave Σ C T as it is.
class ConjugateGradients {
 public:
  /// `loss_rates`: the diagonal that preconditions [1/s]; points of loss rate 0 stay as they are.
  ConjugateGradients(ThermalSystem& system, std::vector<double> loss_rates);

  enum class End { converged, stopped, out_of_iterations, out_of_digits };

  /// Estimated error of the temperature, root mean square weighted with C · loss rate [K], at which to be content.
  using Goal = std::function<double(ConstField temperature)>;
  /// Asked after each iteration; false ends the search.
  using AfterIteration = std::function<bool(ConstField temperature)>;

  /// Improves the temperature. `residual`: its rate; leaves what the recurrence makes of it.
  End improve(Field temperature, Field residual, long most_iterations, const Goal& goal,
              const AfterIteration& after_iteration);

  /// Bound of the error that belongs to a residual [K]: its norm over the slowest decay rate seen so far.
  double error(ConstField residual);

  long iterations() const { return iterations_; }

 private:
  void precondition(ConstField residual);
  void step(double length, Field temperature, Field residual);
  void turn(double share);
  double error_of(double square) const;
  double rate_of_level();

  ThermalSystem& system_;
  std::vector<double> inverse_;  ///< of the loss rates [s]
  std::vector<double> direction_;
  std::vector<double> image_;  ///< minus the linear part of the direction's rate; between iterations inverse · residual
  std::vector<double> lengths_, shares_;  ///< of this search's iterations
  double weight_ = 0.0;                   ///< Σ C · loss rate
  double slowest_ = 0.0;                  ///< smallest Ritz value, over the loss rates; 0: none yet
  long iterations_ = 0;
};

/// Smallest eigenvalue of the tridiagonal matrix that conjugate gradients of these step lengths and shares of the last
/// direction belong to, from above, to one percent [golub2013, sec. 10.2.4 and 8.4].
double smallest_ritz_value(const std::vector<double>& lengths, const std::vector<double>& shares);

}  // namespace peritherm
