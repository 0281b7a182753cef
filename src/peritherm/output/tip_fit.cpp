#include "peritherm/output/tip_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "peritherm/output/interpolation.hpp"

namespace peritherm {
namespace {

// Radii and modes were chosen by the errors on exact samples and on computed fields with known K, see the guide.

constexpr double inner_radius = 1.2;  // [horizons]; nearer to the tip bonds feel its faces and its end
constexpr double least_ratio = 1.6;   // of outer to inner radius; a narrower ring does not tell modes apart
constexpr double shrinking = 0.85;    // from one outer radius to the next
constexpr double points_per_mode = 4.0;
constexpr std::size_t intensity_mode = 1;

/// The first harmonic modes beside insulated faces, one for a tip that acts a little off its place, and r² for uniform
/// sources or rates of temperature; the rest serve fields that change quickly in time or space.
constexpr std::array<std::size_t, 2> mode_counts{8, 12};

using Modes = std::array<double, mode_counts.back()>;

Modes modes_at(double r, double theta) {
  const double root = std::sqrt(r), square = r * r, half = 0.5 * theta;
  return {1.0,
          root * std::sin(half),
          r * std::cos(theta),
          r * root * std::sin(3.0 * half),
          square * std::cos(2.0 * theta),
          square * root * std::sin(5.0 * half),
          square,
          std::sin(half) / root,
          square * root * std::sin(half),
          square * r * std::cos(3.0 * theta),
          square * r * std::cos(theta),
          square * r * root * std::sin(7.0 * half)};
}

/// Least squares, equation by equation: the triangle of an orthogonal factorisation grows by Givens rotations. Its
/// leading part is that of the leading modes alone.
class GrowingFit {
 public:
  void add(Modes row, double value) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (row[k] == 0.0) continue;
      const double size = std::hypot(triangle_[k][k], row[k]);
      const double c = triangle_[k][k] / size, s = row[k] / size;
      for (std::size_t j = k; j < row.size(); ++j) rotate(c, s, triangle_[k][j], row[j]);
      rotate(c, s, values_[k], value);
    }
    ++points_;
  }

  std::size_t points() const { return points_; }

  /// Coefficient of the mode that is wanted, in a fit of the first `count` modes.
  double coefficient(std::size_t count) const {
    Modes solution{};
    for (std::size_t k = count; k-- > intensity_mode;) {
      solution[k] = values_[k];
      for (std::size_t j = k + 1; j < count; ++j) solution[k] -= triangle_[k][j] * solution[j];
      solution[k] /= triangle_[k][k];
    }
    return solution[intensity_mode];
  }

 private:
  static void rotate(double c, double s, double& one, double& other) {
    const double rest = c * other - s * one;
    one = c * one + s * other;
    other = rest;
  }

  std::array<Modes, mode_counts.back()> triangle_{};
  Modes values_{};
  std::size_t points_ = 0;
};

struct Sample {
  double r;  ///< [m]
  double theta;
  double temperature;
};

/// In the frame of a tip that grows with speed v, α ∇²T + v ∂T/∂x = ∂T/∂t. With T = T₀ + exp(−v x / 2α) u the field u
/// has no such term, the same singularity and insulated faces.
void follow_growth(std::vector<Sample>& samples, const TipSite& site) {
  if (site.growth == 0.0) return;
  double mean = 0.0;
  for (const Sample& sample : samples) mean += sample.temperature / static_cast<double>(samples.size());
  for (Sample& sample : samples) {
    sample.temperature = (sample.temperature - mean) * std::exp(0.5 * site.growth * sample.r * std::cos(sample.theta));
  }
}

/// The points of the ring, from the tip outwards.
std::vector<Sample> samples_of_ring(const Grid& grid, const PointValues& temperature, const TipSite& site) {
  const auto [tip_x, tip_y, tip_z] = site.position;
  const GridIndex low = nearest_point(grid, {tip_x - site.clear_radius, tip_y - site.clear_radius, tip_z});
  const GridIndex high = nearest_point(grid, {tip_x + site.clear_radius, tip_y + site.clear_radius, tip_z});
  const double on_crack = 1e-9 * grid.spacing;  // as cracks have it
  std::vector<Sample> samples;
  for (int j = low[1]; j <= high[1]; ++j) {
    for (int i = low[0]; i <= high[0]; ++i) {
      const Point place = grid.position({i, j, 0});
      const double x = place[0] - tip_x, y = place[1] - tip_y, r = std::hypot(x, y);
      if (r < inner_radius * site.horizon || r > site.clear_radius) continue;
      const double ahead = x * site.direction[0] + y * site.direction[1];
      const double left = y * site.direction[0] - x * site.direction[1];
      const bool stands_on_crack = ahead < 0.0 && std::abs(left) <= on_crack;
      const double theta = stands_on_crack ? site.angle_on_crack : std::atan2(left, ahead);
      samples.push_back({r, theta, temperature[grid.number({i, j, 0})]});
    }
  }
  follow_growth(samples, site);
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.r < b.r; });
  return samples;
}

/// Fits with fewer and fewer of the points that are far from the tip.
struct RingFit {
  double radius;  ///< outer one [m]
  std::size_t points;
  std::array<double, mode_counts.size()> intensities;  ///< with few and with all modes
};

std::vector<RingFit> fit_rings(const std::vector<Sample>& samples, const TipSite& site) {
  std::vector<double> radii;
  for (double radius = site.clear_radius; radius >= least_ratio * inner_radius * site.horizon; radius *= shrinking) {
    radii.push_back(radius);
  }
  // √r sin(θ/2) has the coefficient −(2 K / k) / √(2π).
  const double factor = -site.conductivity * std::sqrt(0.5 * std::numbers::pi / site.clear_radius);
  std::vector<RingFit> rings;
  GrowingFit fit;
  auto next = samples.begin();
  for (auto radius = radii.rbegin(); radius != radii.rend(); ++radius) {
    for (; next != samples.end() && next->r <= *radius; ++next) {
      fit.add(modes_at(next->r / site.clear_radius, next->theta), next->temperature);
    }
    RingFit ring{*radius, fit.points(), {}};
    for (std::size_t m = 0; m < mode_counts.size(); ++m) {
      const bool enough = static_cast<double>(fit.points()) >= points_per_mode * static_cast<double>(mode_counts[m]);
      // Adding 0 makes the negative zeros of uniform temperatures plain ones.
      ring.intensities[m] =
          enough ? factor * fit.coefficient(mode_counts[m]) + 0.0 : std::numeric_limits<double>::quiet_NaN();
    }
    rings.insert(rings.begin(), ring);
  }
  return rings;
}

/// What is left out of a series that begins below r² grows at least as r² beside its first term, so that a change of
/// the outer radius tells an upper limit of what is left. NaN without a smaller ring.
double uncertainty_of(const std::vector<RingFit>& rings, std::size_t ring, std::size_t modes) {
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t smaller = ring + 1; smaller < std::min(ring + 3, rings.size()); ++smaller) {
    const double ratio = rings[smaller].radius / rings[ring].radius;
    const double change = std::abs(rings[smaller].intensities[modes] - rings[ring].intensities[modes]);
    if (!std::isnan(change)) largest = std::fmax(largest, change / (1.0 - ratio * ratio));
  }
  return largest;
}

}  // namespace

TipFit fit_tip(const Grid& grid, const PointValues& temperature, const TipSite& site) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TipFit best{nan, nan, 0};
  const std::vector<RingFit> rings = fit_rings(samples_of_ring(grid, temperature, site), site);
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    for (std::size_t modes = 0; modes < mode_counts.size(); ++modes) {
      const double uncertainty = uncertainty_of(rings, ring, modes);
      if (std::isnan(uncertainty) || uncertainty >= best.uncertainty) continue;
      best = {rings[ring].intensities[modes], uncertainty, rings[ring].points};
    }
  }
  return best;
}

}  // namespace peritherm
