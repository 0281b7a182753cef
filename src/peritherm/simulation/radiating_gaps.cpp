#include "peritherm/simulation/radiating_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"
#include "peritherm/discretisation/cell_block.hpp"
#include "peritherm/simulation/mirror_cracks.hpp"

namespace peritherm {
namespace {

/// Of the logarithm of temperatures, between fits: what passes is right to 1e-7.
constexpr double level_step = 0.12;
constexpr double coldest = 1.0;  ///< [K]; colder faces radiate as at this
/// By which the fastest decay rate may grow before it is measured again.
constexpr double rate_margin = 0.1;

/// Lagrange's, of the values at four places.
std::array<double, 4> cubic_weights(const std::array<double, 4>& places, double x) {
  std::array<double, 4> weights{1.0, 1.0, 1.0, 1.0};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t other = 0; other < 4; ++other) {
      if (other != k) weights[k] *= (x - places[other]) / (places[k] - places[other]);
    }
  }
  return weights;
}

}  // namespace

bool RadiatingGaps::needed(const Problem& problem) {
  return std::any_of(problem.cracks.begin(), problem.cracks.end(), follows_temperatures);
}

RadiatingGaps::RadiatingGaps(const Problem& problem, Assembly& assembly)
    : problem_(resolved(problem)), assembly_(assembly) {
  const std::span<const std::int64_t> near = assembly.geometry.body.faces.points();
  points_.assign(near.begin(), near.end());
  const Body& body = assembly.geometry.body;
  places_ = find_gap_places(body, points_);
  double conductivity = 0.0;
  for (const Material& material : body.materials) conductivity = std::max(conductivity, material.conductivity);
  for (const Crack& crack : problem_.cracks) {
    if (!follows_temperatures(crack)) continue;
    exchanged_ = std::max(exchanged_, gap_coefficient(*crack.gap, 1.0) / conductivity);
  }
}

/// Of the logarithm of a mean temperature: what all shares are nearly linear in. A bond that crosses the gap alone
/// would keep h ξ / (h ξ + k).
double RadiatingGaps::scale(double mean) const {
  const double passed = exchanged_ * std::exp(3.0 * mean) * assembly_.geometry.stencil_options.horizon;
  return passed / (1.0 + passed);
}

double RadiatingGaps::temperature(const GapPlace& place, const GapPlace::Weights& weights, ConstField state) const {
  const Grid& grid = assembly_.geometry.body.grid;
  const double zero = assembly_.geometry.body.cracks[place.crack].absolute_zero();
  double sum = 0.0, lowest = HUGE_VAL;
  for (const auto& [number, weight] : weights) {
    const double value = state[assembly_.layout.entry(grid.index(number))] - zero;
    sum += weight * value;
    lowest = std::min(lowest, value);
  }
  if (!std::isfinite(sum))
    throw Error("crack." + std::to_string(place.crack) + ".gap: the temperature of a face is not finite any more",
                "Choose smaller steps", Fault::numerics);
  // Straight lines may lead below what there is.
  const double absolute = std::max(sum, std::min(lowest, 0.0));
  if (absolute >= 0.0) return absolute;
  throw Error(
      "crack." + std::to_string(place.crack) + ".gap: a face at " + describe_place(place.position, grid.dimension) +
          " is " + shortest(-absolute) + " K colder than absolute zero",
      "Give temperatures in kelvin, or say where absolute zero is: absolute_zero = -273.15 for degrees Celsius");
}

FaceMeans RadiatingGaps::means(ConstField state) const {
  FaceMeans result{std::vector<double>(places_.size(), std::log(coldest)), std::vector<double>(places_.size(), 0.0)};
  double sum = 0.0;
  int known = 0;
  for (std::size_t n = 0; n < places_.size(); ++n) {
    const GapPlace& place = places_[n];
    if (place.above.empty() && place.below.empty()) continue;
    const double above = temperature(place, place.above.empty() ? place.below : place.above, state);
    const double below = temperature(place, place.below.empty() ? place.above : place.below, state);
    const double mean = std::cbrt(0.25 * (above * above + below * below) * (above + below));
    result.means[n] = std::log(std::max(coldest, mean));
    result.weights[n] = std::abs(above - below) / std::max({above, below, coldest});
    sum += result.means[n];
    ++known;
  }
  // Where nothing is on either side nothing passes, and no fit should be made for it.
  for (std::size_t n = 0; n < places_.size() && known > 0; ++n) {
    if (places_[n].above.empty() && places_[n].below.empty()) result.means[n] = sum / known;
  }
  return result;
}

/// Fits of all levels from one to another.
std::vector<const MirroredFaces*> RadiatingGaps::fits_between(int first, int last) {
  std::vector<const MirroredFaces*> fits;
  for (int level = first; level <= last; ++level) {
    auto found = fits_.find(level);
    if (found == fits_.end()) {
      for (CrackSurface& crack : assembly_.geometry.body.cracks) {
        if (crack.radiates()) crack.set_mean_temperature(std::exp(level * level_step));
      }
      found = fits_.emplace(level, mirror_cracks(problem_, assembly_.geometry)).first;
    }
    fits.push_back(&found->second);
  }
  return fits;
}

/// The mean at the middle of a bond, the same from both of its ends; none if the other end is far from all faces.
std::optional<double> RadiatingGaps::mean_of_bond(std::size_t near, const GridIndex& offset,
                                                  std::span<const double> means) const {
  const Body& body = assembly_.geometry.body;
  const GridIndex p = body.grid.index(static_cast<std::size_t>(points_[near]));
  const GridIndex q = body.fold({p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]});
  const auto number = static_cast<std::int64_t>(body.grid.number(q));
  const auto found = std::lower_bound(points_.begin(), points_.end(), number);
  if (found == points_.end() || *found != number) return std::nullopt;
  return 0.5 * (means[near] + means[static_cast<std::size_t>(found - points_.begin())]);
}

/// The bonds of a point. `fits` begin at the level `first`.
MirroredFaces::PointBonds RadiatingGaps::blend(std::size_t near, std::span<const double> means,
                                               std::span<const MirroredFaces* const> fits, int first) const {
  const auto point = static_cast<std::size_t>(points_[near]);
  MirroredFaces::PointBonds result{points_[near], fits.front()->volume(point), {}};
  std::vector<MirroredFaces::Row> rows;
  for (const MirroredFaces* fit : fits) rows.push_back(fit->row(point));
  std::vector<std::size_t> next(rows.size(), 0);
  std::vector<double> shares(rows.size());
  for (const StencilEntry& entry : assembly_.geometry.stencil.entries) {
    const std::uint32_t number = fits.front()->number_of(entry.offset);
    bool changes = false;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const bool listed = next[k] < rows[k].bonds.size() && rows[k].bonds[next[k]] == number;
      shares[k] = listed ? rows[k].shares[next[k]++] : 1.0;
      changes = changes || listed;
    }
    const auto mean = changes ? mean_of_bond(near, entry.offset, means) : std::nullopt;
    if (!mean) continue;
    const int begin = static_cast<int>(std::floor(*mean / level_step)) - 1;
    std::array<double, 4> places;
    for (int k = 0; k < 4; ++k) places[static_cast<std::size_t>(k)] = scale((begin + k) * level_step);
    const std::array<double, 4> weights = cubic_weights(places, scale(*mean));
    double share = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k)
      share += weights[k] * shares[static_cast<std::size_t>(begin - first) + k];
    result.bonds.push_back({number, share, {}});
  }
  return result;
}

bool RadiatingGaps::apply(std::span<const double> means) {
  if (means.empty()) return false;
  const auto [lowest, highest] = std::minmax_element(means.begin(), means.end());
  const int first = static_cast<int>(std::floor(*lowest / level_step)) - 1;
  const int last = static_cast<int>(std::floor(*highest / level_step)) + 2;
  const std::vector<const MirroredFaces*> fits = fits_between(first, last);
  std::vector<MirroredFaces::PointBonds> points(points_.size());
  const auto count = static_cast<std::int64_t>(points_.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::int64_t n = 0; n < count; ++n)
    points[static_cast<std::size_t>(n)] = blend(static_cast<std::size_t>(n), means, fits, first);
  Geometry& geometry = assembly_.geometry;
  const std::span<const std::int64_t> cut = fits.front()->cut_points();
  geometry.body.faces =
      MirroredFaces(geometry.stencil.radius, points, {cut.begin(), cut.end()}, fits.front()->lowest_share());
  const double excess = reference_rate_ > 0.0 ? largest_change() : HUGE_VAL;
  const bool measured = excess > rate_margin * reference_rate_;
  assembly_.system->replace_conduction(make_conduction(problem_, assembly_), measured ? 0.0 : allowed_rate());
  if (measured) {
    reference_ = geometry.body.faces;
    reference_rate_ = assembly_.system->fastest_rate();
    assembly_.system->set_fastest_rate(allowed_rate());
  }
  return measured;
}

double RadiatingGaps::allowed_rate() const { return (1.0 + rate_margin) * reference_rate_; }

/// By how much the fastest decay can be faster than that of the reference, by Gershgorin [1/s].
double RadiatingGaps::largest_change() const {
  const Body& body = assembly_.geometry.body;
  double conductivity = 0.0, capacity = HUGE_VAL;
  for (const Material& material : body.materials) {
    conductivity = std::max(conductivity, material.conductivity);
    capacity = std::min(capacity, volumetric_heat_capacity(material) * body.grid.cell_volume());
  }
  double largest = 0.0;
  const auto count = static_cast<std::int64_t>(points_.size());
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (std::int64_t n = 0; n < count; ++n) {
    const auto point = static_cast<std::size_t>(points_[static_cast<std::size_t>(n)]);
    const MirroredFaces::Row before = reference_.row(point), now = body.faces.row(point);
    double sum = 0.0;
    for (const StencilEntry& entry : assembly_.geometry.stencil.entries) {
      const std::uint32_t bond = body.faces.number_of(entry.offset);
      sum += entry.conductance * std::abs(now.find(bond).value_or(1.0) - before.find(bond).value_or(1.0));
    }
    largest = std::max(largest, 2.0 * sum * conductivity / (capacity * body.faces.volume(point)));
  }
  return largest;
}

}  // namespace peritherm
