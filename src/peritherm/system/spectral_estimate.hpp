#pragma once

#include "peritherm/system/thermal_system.hpp"

namespace peritherm {

/// What so many steps of Lanczos' method find of the fastest decay rate of the linear part [1/s]: never more than it,
/// and all digits of it after enough steps.
double fastest_rate_after(ThermalSystem& system, std::size_t steps);

/// Fastest decay rate of the linear part [1/s] by Lanczos' method from a fixed start that mixes all modes, raised by a
/// margin: for a random start the expected shortfall after k steps is at most 0.103 (ln n / (k − 1))² of it
/// [kuczynski1992], here 2 %; the margin is 3 %. Not a bound in the strict sense.
double estimate_fastest_rate(ThermalSystem& system, std::size_t free_points);

}  // namespace peritherm
