#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/operators/correction_kernels.hpp"

namespace peritherm {

/// Corrected bonds of a point, and the share of a cell that they are divided by.
struct PointCorrections {
  std::span<const BondDifference> bonds;
  double volume = 1.0;
};

/// Steps in which differences are counted: each bond's own, a small share of what the stencil says.
class BondSteps {
 public:
  /// `conductivities` per material [W/(m K)].
  BondSteps(const Stencil& stencil, const PaddedGrid& layout, std::span<const double> conductivities);

  /// Distances, and differences of one step, per entry of the stencil.
  const BondDifference* of(std::uint16_t material) const { return steps_.data() + material * codes_.size(); }
  struct Count {
    int code;  ///< entry of the stencil
    std::int32_t count;
  };
  /// What a bond differs times the volume, but for `rest`; none if it is no bond of the stencil or no whole number.
  std::optional<Count> count(std::uint16_t material, const BondDifference& bond, double volume) const;
  /// What the whole conductance of a bond is above a whole number of steps where a volume divides it; alike for all.
  static double rest(double volume);
  /// Whether all bonds of a point can be counted.
  bool can_count(std::uint16_t material, const PointCorrections& point) const;

 private:
  std::vector<BondDifference> steps_;
  std::unordered_map<std::int64_t, int> codes_;  ///< by distance
};

/// Corrected bonds of neighbouring points along x that have little in common, as mirrored ones near tips and along
/// slanted cracks. What one bond differs for each point stands side by side, in steps: four bytes instead of twelve,
/// and one instruction serves all points.
class CorrectionBundles {
 public:
  static constexpr int most_points = CorrectionKernels::most_points;

  CorrectionBundles() = default;
  explicit CorrectionBundles(std::shared_ptr<const BondSteps> steps) : steps_(std::move(steps)) {}

  struct Bundle {
    std::int64_t entry;   ///< of the first point
    std::int64_t begin;   ///< into codes
    std::uint32_t count;  ///< of bonds
    std::uint16_t length;
    std::uint16_t material;
  };
  /// Appends points, at most `most_points`, that stand one behind the other from `entry` on and after those before.
  /// False, and nothing is changed, if their bonds are no whole steps or take less room one by one.
  bool add(std::int64_t entry, std::uint16_t material, std::span<const PointCorrections> points);
  void append(const CorrectionBundles& later);
  void shrink_to_fit();

  std::span<const Bundle> bundles() const { return bundles_; }
  BondBundle bonds_of(const Bundle& bundle) const {
    return {static_cast<int>(bundle.count), codes_.data() + bundle.begin, steps_->of(bundle.material),
            counts_.data() + bundle.begin * most_points, rests_.data() + (&bundle - bundles_.data()) * most_points};
  }

  /// Shares of cells that the sums over a bundle's bonds are divided by.
  const double* volumes_of(const Bundle& bundle) const {
    return volumes_.data() + (&bundle - bundles_.data()) * most_points;
  }

  /// Calls visit(entry of j minus the point's own, difference) for the bonds of a point.
  template <class Visit>
  void visit(std::int64_t entry, Visit&& visit) const {
    const Bundle* const bundle = find(entry);
    if (bundle == nullptr) return;
    const BondBundle bonds = bonds_of(*bundle);
    const std::int64_t n = entry - bundle->entry;
    for (int k = 0; k < bonds.count; ++k) {
      const double count = bonds.counts[k * most_points + n] + bonds.rests[n];
      const BondDifference& step = bonds.steps[bonds.codes[k]];
      if (count != 0.0) visit(step.distance, step.difference * count / volumes_of(*bundle)[n]);
    }
  }
  std::size_t bytes() const;

 private:
  const Bundle* find(std::int64_t entry) const;

  std::shared_ptr<const BondSteps> steps_;
  std::vector<Bundle> bundles_;  ///< ascending
  std::vector<std::uint16_t> codes_;
  std::vector<std::int32_t> counts_;     ///< `most_points` per code
  std::vector<double> rests_, volumes_;  ///< `most_points` per bundle
};

}  // namespace peritherm
