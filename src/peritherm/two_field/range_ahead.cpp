#include "peritherm/two_field/range_ahead.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

constexpr int looks_ahead = 64;

/// The fastest that sources and prescribed fluxes change a point's temperature [K/s].
double fastest_heating(const TwoFieldSystem& system, double from, double to) {
  double fastest = 0.0;
  std::vector<double> heat(system.size());
  for (int k = 0; k <= looks_ahead && system.loads().heating; ++k) {
    std::fill(heat.begin(), heat.end(), 0.0);
    system.add_heating(from + (to - from) * k / looks_ahead, 1.0, heat);
    for (std::size_t n = 0; n < heat.size(); ++n) {
      fastest = std::max(fastest, std::abs(heat[n]) / system.capacities()[n]);
    }
  }
  return fastest;
}

}  // namespace

TemperatureRange range_ahead(const TwoFieldSystem& system, ConstField temperature, double from, double to) {
  const auto [low, high] = std::minmax_element(temperature.begin(), temperature.end());
  TemperatureRange range{*low, *high};
  for (int k = 0; k <= looks_ahead; ++k) {
    const std::vector<double> outside = system.surroundings(from + (to - from) * k / looks_ahead);
    for (std::size_t r = 0; r < outside.size(); ++r) {
      if (system.rows()[r].second >= 0) continue;
      const double value = outside[r] / system.rows()[r].area;
      range = {std::min(range.lowest, value), std::max(range.highest, value)};
    }
  }
  if (range.lowest == range.highest) {
    range.highest += fastest_heating(system, from, to) * shortest_decay(system);
  }
  return range;
}

}  // namespace peritherm
