#pragma once

#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// Evaluations that `estimate_loss_rates` takes.
inline constexpr int loss_rate_probes = 8;

/// How fast each point would lose its heat to neighbours at rest, minus the diagonal of the linear part of the rate
/// [1/s], from random signs [bekas2007]: the root mean square of what they give, which is never negative. With n equal
/// bonds it is sqrt(1 + 1/n) times the diagonal, up to about 1 / sqrt(4 n). Entries that are not integrated get 0, and
/// so do points without bonds. `signs` and `rates` are overwritten; all are as long as a state.
void estimate_loss_rates(ThermalSystem& system, Field loss_rates, Field signs, Field rates);

}  // namespace peritherm
