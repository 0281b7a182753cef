#include "peritherm/output/observer.hpp"

#include "peritherm/output/interpolation.hpp"

namespace peritherm {

double temperature_at(const Snapshot& snapshot, const Point& place) {
  if (snapshot.temperature_at) return snapshot.temperature_at(place);
  if (!snapshot.jumps) return interpolate(snapshot.grid, snapshot.temperature, place);
  return interpolate(snapshot.grid, snapshot.temperature, snapshot.materials, snapshot.jumps, place);
}

}  // namespace peritherm
