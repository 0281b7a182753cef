#pragma once

#include <string>
#include <vector>

#include "peritherm/base/field.hpp"
#include "peritherm/physics/profile.hpp"

namespace peritherm {

/// How a load acts: as a temperature outside (held, or of a fluid), or as heat (a flux, a source).
enum class LoadKind { temperature, heat };

/// A pattern in space: a profile frozen at a time.
struct LoadShape {
  Profile profile;
  double time = 0.0;  ///< [s]
  bool operator==(const LoadShape&) const = default;
};

/// What one boundary or one source prescribes, Σ_k u_k(t) shape_k(x); the u_k are inputs of a reduced model.
struct Load {
  std::string key;  ///< where its profile stands in the case: "boundary.0.value", "source.1.value"
  int boundary = -1;
  int source = -1;  ///< one of the two is not −1
  LoadKind kind = LoadKind::temperature;
  /// At least one. Loads of kind temperature can make a constant of their shapes; then the level of all temperatures
  /// is free.
  std::vector<LoadShape> shapes;
  /// Where a profile is sampled: as many places as shapes decide the u_k, the others only check. Empty for a load that
  /// is the same everywhere.
  std::vector<Point> places;
  bool operator==(const Load&) const = default;
};

}  // namespace peritherm
