#include "peritherm/simulation/reduction_memory.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/simulation/check.hpp"
#include "peritherm/simulation/memory.hpp"

namespace peritherm {
namespace {

constexpr double bytes_per_number = 8.0;
constexpr double bytes_per_entry = 12.0;  ///< of a sparse matrix

/// Unknowns that one input takes until the tolerance is met, as the plates and bars of the tests do: two for each
/// factor of ten, and some for the range of times.
double expected_unknowns(double tolerance, std::size_t inputs, int most) {
  return std::min<double>(most, (8.0 - 2.0 * std::log10(tolerance)) * static_cast<double>(inputs));
}

/// Boundaries and sources, and the start.
std::size_t count_inputs(const Problem& problem) { return problem.boundaries.size() + problem.sources.size() + 1; }

/// What several keys select, counted twice where they overlap.
double expected_retained(const RetainedPoints& retained, const Grid& grid) {
  const auto points = static_cast<double>(grid.size());
  const bool nothing_said = !retained.every && retained.regions.empty() && retained.points.empty() && !retained.share;
  const std::vector<int> every = retained.every.value_or(nothing_said ? std::vector<int>{2} : std::vector<int>{});
  double count = static_cast<double>(retained.points.size()) + retained.share.value_or(0.0) * points;
  if (!every.empty()) {
    double pattern = 1.0;
    for (int axis = 0; axis < grid.dimension; ++axis) {
      const auto number = std::min<std::size_t>(static_cast<std::size_t>(axis), every.size() - 1);
      pattern *= std::ceil(static_cast<double>(grid.count(axis)) / every[number]);
    }
    count += pattern;
  }
  for (const RetainedRegion& region : retained.regions) {
    double inside = 0.0;
    // A sample of the points will do.
    const std::size_t stride = std::max<std::size_t>(1, grid.size() / 100000);
    for (std::size_t n = 0; n < grid.size(); n += stride) {
      if (contains(region.shape, grid.position(grid.index(n)), 1e-9 * grid.spacing))
        inside += static_cast<double>(stride);
    }
    count += inside / std::pow(region.every, grid.dimension);
  }
  return std::min(count, points);
}

/// The matrix, its factor, and four dense matrices between the unknowns. The factor's fill is that of nested
/// dissection, n log n in 2-D and n^(4/3) in 3-D, per entry of a row; measured on a plate of 8,100 points.
double condensed_bytes(const Problem& problem, const RetainedPoints& retained, int modes) {
  const Grid grid = make_grid(problem);
  const auto points = static_cast<double>(grid.size());
  const double unknowns = expected_retained(retained, grid) + modes;
  const double reach = horizon_of(problem) / grid.spacing;
  const double row = grid.dimension == 1   ? 2.0 * reach
                     : grid.dimension == 2 ? 3.2 * reach * reach
                                           : 4.2 * std::pow(reach, 3);
  const double fill = grid.dimension == 1   ? 1.0
                      : grid.dimension == 2 ? 0.27 * std::log2(points)
                                            : 0.2 * std::cbrt(points);
  return bytes_per_entry * points * row * (1.0 + fill) + 4.0 * bytes_per_number * unknowns * unknowns;
}

double method_bytes(const Problem& problem, const RationalKrylov& method) {
  const auto points = static_cast<double>(make_grid(problem).size());
  const std::size_t inputs = count_inputs(problem);
  const double unknowns = expected_unknowns(method.tolerance, inputs, method.most_unknowns);
  // States of the basis and their rates, the basis itself, and two states per input.
  return bytes_per_number * points * (3.0 * unknowns + 3.0 * static_cast<double>(inputs));
}

double method_bytes(const Problem& problem, const StaticCondensation& method) {
  return condensed_bytes(problem, method.retained, 0);
}

double method_bytes(const Problem& problem, const CraigBampton& method) {
  return condensed_bytes(problem, method.retained, method.modes) +
         3.0 * bytes_per_number * static_cast<double>(make_grid(problem).size()) * method.modes;
}

double method_bytes(const Problem& problem, const ProperOrthogonal& method) {
  return 2.0 * bytes_per_number * static_cast<double>(make_grid(problem).size()) * method.snapshots;
}

std::string hint_for(const RationalKrylov&) { return "Choose a larger tolerance, fewer loads or fewer cells"; }
std::string hint_for(const StaticCondensation&) {
  return "Retain fewer points, e.g. every = [10], or choose type = \"rational_krylov\"";
}
std::string hint_for(const CraigBampton&) {
  return "Retain fewer points, e.g. every = [10], or choose type = \"rational_krylov\"";
}
std::string hint_for(const ProperOrthogonal&) { return "Keep fewer snapshots, or choose fewer cells"; }

std::string gibibytes(double bytes) {
  const double value = bytes / (1024.0 * 1024.0 * 1024.0);
  return shortest(std::round(value * 10.0) / 10.0) + " GiB";
}

}  // namespace

double reduction_bytes(const Problem& problem, const ReductionMethod& method) {
  return std::visit([&problem](const auto& chosen) { return method_bytes(problem, chosen); }, method);
}

void refuse_large_reduction(const Problem& problem, const ReductionMethod& method, double bytes) {
  const auto available = static_cast<double>(available_memory());
  if (available == 0.0 || bytes <= available) return;
  throw Error("the reduction needs about " + gibibytes(bytes) + " of memory for " +
                  std::to_string(make_grid(problem).size()) + " points, and " + gibibytes(available) + " are available",
              std::visit([](const auto& chosen) { return hint_for(chosen); }, method), Fault::machine);
}

}  // namespace peritherm
