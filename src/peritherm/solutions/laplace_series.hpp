#pragma once

#include <complex>
#include <functional>

namespace peritherm {

using LaplaceTransform = std::function<std::complex<double>(std::complex<double> s)>;

/// f(t), t > 0, from its transform by the Fourier series of exp(−ct) f over a period of 4t [durbin1974]:
///   e^{ct}/P (F(c)/2 + Σ_k Re F(c + ikπ/P) i^k),  P = 2t, c = 18/P.
/// For transforms without singularities right of the imaginary axis, so for waves too. Its own error is e^{−36} of
/// f(5t), that of rounding about 1e-12 of what f has reached. The series ends where 64 terms together stay below
/// `tolerance`; it fades out between half of the terms and all, so that f should have no detail finer than 40 t/terms.
double invert_laplace_series(const LaplaceTransform& transform, double time, double tolerance, int terms = 40000);

}  // namespace peritherm
