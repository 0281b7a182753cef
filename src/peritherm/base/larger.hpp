#pragma once

#include <cmath>

namespace peritherm {

/// The larger of two numbers; not a number if either is, so that a maximum over errors cannot hide one.
inline double larger(double a, double b) { return a > b || std::isnan(a) ? a : b; }

}  // namespace peritherm
