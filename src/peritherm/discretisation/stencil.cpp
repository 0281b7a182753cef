#include "peritherm/discretisation/stencil.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {
namespace {

double power(double base, int exponent) {
  double result = 1.0;
  for (int k = 0; k < exponent; ++k) result *= base;
  return result;
}

/// Conductances of bonds between whole cells of unit conductivity, before calibration. Offsets that differ in signs
/// and in the order of their axes conduct alike to the last bit.
class OffsetConductances {
 public:
  OffsetConductances(const StencilOptions& options, double spacing, int dimension)
      : options_(options),
        ratio_(options.horizon / spacing),
        spacing_(spacing),
        dimension_(dimension),
        cell_(power(spacing, dimension)),
        amplitude_(micro_conductivity_amplitude(options.kernel, 1.0, options.horizon, dimension)) {}

  struct Parts {
    double bond = 0.0, self = 0.0;
  };
  Parts operator()(GridIndex offset) {
    for (int& along : offset) along = std::abs(along);
    std::sort(offset.begin(), offset.end(), std::greater<>());
    const auto [place, is_new] = known_.try_emplace(offset);
    if (is_new) place->second = {bond(offset), self(offset)};
    return place->second;
  }

 private:
  double bond(const GridIndex& offset) const {
    if (options_.partial_volumes == PartialVolumes::cell_integrated) {
      if (covered_volume(offset, ratio_, dimension_) <= least_share) return 0.0;
      const auto kernel = [this](double distance) { return micro_conductivity(distance, distance); };
      return integral_over_covered(kernel, offset, ratio_, dimension_) * cell_ * cell_;
    }
    const CountedCell counted = count_cell(options_.partial_volumes, offset, ratio_, dimension_);
    if (counted.share <= 0.0) return 0.0;
    return micro_conductivity(counted.kernel_distance, distance_to(offset)) * counted.share * cell_ * cell_;
  }

  double self(const GridIndex& offset) const {
    if (options_.self_term == SelfTerm::none || offset[0] > 1) return 0.0;
    const double distance = distance_to(offset);
    if (options_.self_term == SelfTerm::bobaru_2010) {
      // ∫ k(0)/|ξ|² (1/2) ξ·∇∇T ξ dV over the own cell, with second differences for the curvature.
      return offset[1] == 0 ? micro_conductivity(0.0, 1.0) * cell_ * cell_ / (2.0 * dimension_) : 0.0;
    }
    return micro_conductivity(0.5 * distance, 0.5 * distance) * cell_ * cell_ / (power(3.0, dimension_) - 1.0);
  }

  /// κ at distances in spacings.
  double micro_conductivity(double kernel_distance, double distance) const {
    return amplitude_ * shape(options_.kernel, kernel_distance / ratio_) /
           power(distance * spacing_, options_.kernel.exponent);
  }

  StencilOptions options_;
  double ratio_;
  double spacing_;
  int dimension_;
  double cell_;
  double amplitude_;
  std::map<GridIndex, Parts> known_;
};

int square_of(const GridIndex& o) { return o[0] * o[0] + o[1] * o[1] + o[2] * o[2]; }

[[noreturn]] void refuse(double horizon, double spacing) {
  throw Error("horizon " + shortest(horizon) + " m reaches no neighbour",
              "Choose a horizon larger than the spacing, " + shortest(spacing) + " m, or smaller cells");
}

/// Σ over the offsets that differ in signs only, so that products of cosines stand for them; x fastest.
std::vector<double> folded(const Stencil& stencil, const GridIndex& counts) {
  std::vector<double> sums(static_cast<std::size_t>(counts[0]) * counts[1] * counts[2], 0.0);
  for (const StencilEntry& entry : stencil.entries) {
    const auto [x, y, z] = entry.offset;
    sums[std::abs(x) + static_cast<std::size_t>(counts[0]) * (std::abs(y) + counts[1] * std::abs(z))] +=
        entry.conductance;
  }
  return sums;
}

/// Σ_o weights[o] cos(o π wave / waves) over the slowest axis of an array of `count` slices.
std::vector<double> contract(const std::vector<double>& weights, int count, int wave, int waves) {
  const std::size_t slice = weights.size() / count;
  std::vector<double> sums(slice, 0.0);
  for (int o = 0; o < count; ++o) {
    const double cosine = std::cos(std::numbers::pi * o * wave / waves);
    for (std::size_t k = 0; k < slice; ++k) sums[k] += cosine * weights[o * slice + k];
  }
  return sums;
}

/// Least value of Σ_o weights[o] cos(o k) over k = 0, π/waves, …, π.
double least_cosine_sum(const std::vector<double>& weights, const std::vector<double>& cosines, int waves) {
  const std::size_t columns = static_cast<std::size_t>(waves) + 1;
  std::vector<double> sums(columns, 0.0);
  for (std::size_t o = 0; o < weights.size(); ++o) {
    for (std::size_t k = 0; k < columns; ++k) sums[k] += weights[o] * cosines[o * columns + k];
  }
  return *std::min_element(sums.begin(), sums.end());
}

/// cos(o π k / waves), k fastest.
std::vector<double> cosine_table(int count, int waves) {
  std::vector<double> table;
  for (int o = 0; o < count; ++o) {
    for (int k = 0; k <= waves; ++k) table.push_back(std::cos(std::numbers::pi * o * k / waves));
  }
  return table;
}

}  // namespace

Stencil make_stencil(const StencilOptions& options, double spacing, int dimension) {
  OffsetConductances conductances(options, spacing, dimension);
  const bool has_self = options.self_term != SelfTerm::none;
  int limit = static_cast<int>(reach_of(options.partial_volumes, options.horizon / spacing) + 1e-6);
  if (has_self) limit = std::max(limit, 1);
  const int limit_y = dimension > 1 ? limit : 0;
  const int limit_z = dimension > 2 ? limit : 0;
  Stencil stencil;
  for (int z = -limit_z; z <= limit_z; ++z) {
    for (int y = -limit_y; y <= limit_y; ++y) {
      for (int x = -limit; x <= limit; ++x) {
        if (x == 0 && y == 0 && z == 0) continue;
        const auto [bond, self] = conductances({x, y, z});
        if (bond + self <= 0.0) continue;
        stencil.entries.push_back({{x, y, z}, bond + self});
        if (has_self) stencil.self.push_back(self);
        stencil.radius = std::max({stencil.radius, x, y, z});
      }
    }
  }
  if (stencil.entries.empty()) refuse(options.horizon, spacing);
  if (options.calibration == Calibration::discrete) {
    const double factor = 1.0 / effective_conductivity(stencil, spacing, dimension);
    for (StencilEntry& entry : stencil.entries) entry.conductance *= factor;
    for (double& part : stencil.self) part *= factor;
  }
  return stencil;
}

double effective_conductivity(const Stencil& stencil, double spacing, int dimension) {
  double sum = 0.0;
  for (const StencilEntry& entry : stencil.entries) {
    sum += entry.conductance * (entry.offset[0] * entry.offset[0]);
  }
  return 0.5 * sum * spacing * spacing / power(spacing, dimension);
}

double largest_symbol(const Stencil& stencil, int dimension) {
  double sum = 0.0;
  double second_moment = 0.0;
  for (const StencilEntry& entry : stencil.entries) {
    sum += entry.conductance;
    second_moment += entry.conductance * square_of(entry.offset);
  }
  // A maximum is at most half an interval h off a scanned wave vector along each axis, and by reflection symmetry
  // the symbol's curvature there costs at most Σ_a (1/2)(h/2)² Σ G o_a² = (h²/8) Σ G |o|². The symbol's mean is Σ G.
  constexpr double sharpness = 0.002;
  const int waves = static_cast<int>(std::ceil(std::numbers::pi * std::sqrt(second_moment / (8.0 * sharpness * sum))));
  const int count = stencil.radius + 1;
  const GridIndex counts{count, dimension > 1 ? count : 1, dimension > 2 ? count : 1};
  const std::vector<double> cosines = cosine_table(count, waves);
  const std::vector<double> weights = folded(stencil, counts);
  double least = sum;
  for (int wave_z = 0; wave_z <= (dimension > 2 ? waves : 0); ++wave_z) {
    const std::vector<double> plane = contract(weights, counts[2], wave_z, waves);
    for (int wave_y = 0; wave_y <= (dimension > 1 ? waves : 0); ++wave_y) {
      least = std::min(least, least_cosine_sum(contract(plane, counts[1], wave_y, waves), cosines, waves));
    }
  }
  const double interval = std::numbers::pi / waves;
  return sum - least + interval * interval / 8.0 * second_moment;
}

}  // namespace peritherm
