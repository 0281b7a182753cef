#pragma once

#include <vector>

namespace peritherm {

/// Chebyshev coefficients of t^(j+1) φ_{j+1}(t x), j = 0 … degree, on −rate <= x <= 0; the first one counts half. rate
/// · time must be at least 1e-3. φ_1(z) = (e^z − 1)/z, φ_{j+1}(z) = (φ_j(z) − 1/j!)/z. Positive and falling; as many as
/// exceed 1e-17 of the first.
std::vector<std::vector<double>> propagator_coefficients(double rate, double time, int degree);

/// Leaves out the last coefficients as long as they sum to at most `error`, and adds that sum to the last one that
/// stays: the series remains exact at x = 0, where nothing decays and heat adds up, and is off by twice the error
/// elsewhere at most.
void truncate(std::vector<double>& coefficients, double error);

}  // namespace peritherm
