#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "peritherm/discretisation/body.hpp"

namespace peritherm {

/// A place on a face across which heat is radiated, and the temperatures on both sides of it as weighted sums over
/// points of the body: planes through those of each side nearby (least squares), so right to second order.
struct GapPlace {
  std::size_t crack = 0;
  Point position{};  ///< [m]
  /// Of the points by number. Empty where a side has none nearby.
  using Weights = std::vector<std::pair<std::size_t, double>>;
  Weights above, below;
};

/// For each of some points the place on the nearest radiating crack; `points` by number. Empty if no crack radiates.
std::vector<GapPlace> find_gap_places(const Body& body, std::span<const std::int64_t> points);

}  // namespace peritherm
