#pragma once

#include <vector>

#include "peritherm/reduction/heat_basis.hpp"

namespace peritherm {

/// What drives a body: an input that is 1 from time 0 on, or the start.
struct Drive {
  ConstField rate;  ///< of the input [K/s], or the start itself [K]
  bool is_start = false;
  double amplitude = 0.0;  ///< of the temperatures that belong to the input; 0 if it puts heat in [K]
  double damping = 0.0;    ///< rate at which an error of the response decays by itself [1/s]
};

/// Galerkin's response T(t) = Σ coordinate · state to a drive at some times, and its slope, one column per time.
struct Response {
  Matrix coordinates;  ///< [K]
  Matrix slopes;       ///< [K/s]
};

/// Of the first `count` states of a basis.
class ResponseSolver {
 public:
  ResponseSolver(const HeatBasis& basis, std::size_t count);
  Response respond(const Drive& drive, const std::vector<double>& times) const;

 private:
  const HeatBasis& basis_;
  std::vector<double> rates_;
  Matrix modes_;
};

/// What a response leaves at a time.
struct Look {
  double residual = 0.0;  ///< (Σ C r²)^½, r = rate of the full system − slope
  double largest = 0.0;   ///< max |T|
};

/// Looks at all times in one pass over the basis.
std::vector<Look> look_at(const HeatBasis& basis, const Drive& drive, const Response& response);

/// r = rate of the full system − slope at one of the times. It is orthogonal to the basis.
void residual_of(const HeatBasis& basis, const Drive& drive, const Response& response, std::size_t time,
                 Field residual);

}  // namespace peritherm
