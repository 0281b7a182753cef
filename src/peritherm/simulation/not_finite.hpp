#pragma once

#include "peritherm/simulation/assemble.hpp"

namespace peritherm {

/// Throws Error (Fault::numerics) that names the time [s], and the first point of the body whose temperature is not
/// finite.
[[noreturn]] void report_not_finite(const Assembly& assembly, ConstField state, double time);

}  // namespace peritherm
