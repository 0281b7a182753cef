#pragma once

#include "peritherm/two_field/two_field_system.hpp"

namespace peritherm {

struct TemperatureRange {
  double lowest = 0.0, highest = 0.0;  ///< [K]
};

/// Of temperatures now, and of what surrounds them until the end; if that is one temperature, as much more as sources
/// and prescribed fluxes change a point until its neighbours notice. From one temperature everywhere, errors can be
/// measured by what is to come only.
TemperatureRange range_ahead(const TwoFieldSystem& system, ConstField temperature, double from, double to);

}  // namespace peritherm
