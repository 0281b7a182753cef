#pragma once

#include <vector>

#include "peritherm/reduction/heat_basis.hpp"

namespace peritherm {

/// What drives a body, and how far its response in the frequency domain, x(s) = (s + A)⁻¹ rate, is known. At the time
/// t after it has set in, the temperature is about x(1/t); that of a start is about s x(s).
struct Drive {
  ConstField rate;  ///< of a unit input [K/s], or the start itself [K]
  bool is_start = false;
  double amplitude = 0.0;  ///< of the temperatures that belong to a unit input; 0 if it puts heat in [K]
  double damping = 0.0;    ///< rate at which what is not known of x decays, beside s [1/s]
};

/// What a basis leaves of a drive at a shift.
struct Look {
  double residual = 0.0;  ///< (Σ C r²)^½, r = rate − (s + A) x
  double largest = 0.0;   ///< max |x|
};

/// Galerkin's coordinates of x for some shifts, one column each.
class ResponseSolver {
 public:
  explicit ResponseSolver(const HeatBasis& basis);
  Matrix coordinates(const HeatBasis& basis, ConstField rate, const std::vector<double>& shifts) const;

 private:
  std::vector<double> rates_;
  Matrix modes_;
};

/// Looks at all shifts in one pass over the basis.
std::vector<Look> look_at(const HeatBasis& basis, ConstField rate, const std::vector<double>& shifts,
                          const Matrix& coordinates);

/// r = rate − (shift + A) Σ coordinate · state.
void residual_of(const HeatBasis& basis, ConstField rate, double shift, ConstField coordinates, Field residual);

}  // namespace peritherm
