#include "peritherm/operators/correction_bundles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "peritherm/discretisation/share_over_time.hpp"

namespace peritherm {
namespace {

/// Of a whole number of steps that arithmetic in double precision leaves.
constexpr double count_rounding = 1e-5;
constexpr double most_steps = 2147483647.0;
constexpr std::size_t most_entries = 65536;  ///< of 16 bits

}  // namespace

BondSteps::BondSteps(const Stencil& stencil, const PaddedGrid& layout, std::span<const double> conductivities) {
  for (const double conductivity : conductivities) {
    for (const auto& [offset, conductance] : stencil.entries) {
      steps_.push_back({conductivity * conductance / share_steps, layout.distance(offset)});
    }
  }
  for (std::size_t k = 0; k < stencil.entries.size(); ++k) codes_.emplace(steps_[k].distance, static_cast<int>(k));
}

std::optional<BondSteps::Count> BondSteps::count(std::uint16_t material, const BondDifference& bond,
                                                 double volume) const {
  const auto found = codes_.find(bond.distance);
  if (found == codes_.end()) return std::nullopt;
  const double count = bond.difference * volume / of(material)[found->second].difference - rest(volume);
  const double whole = std::round(count);
  // Bonds of no conductance have no steps, either.
  if (!(std::abs(count - whole) <= count_rounding && std::abs(whole) <= most_steps)) return std::nullopt;
  return Count{found->second, static_cast<std::int32_t>(whole)};
}

double BondSteps::rest(double volume) {
  const double steps = volume * share_steps;
  return std::round(steps) - steps;
}

/// A rest belongs to all bonds of the stencil.
bool BondSteps::can_count(std::uint16_t material, const PointCorrections& point) const {
  if (codes_.size() > most_entries) return false;
  if (rest(point.volume) != 0.0 && point.bonds.size() != codes_.size()) return false;
  return std::all_of(point.bonds.begin(), point.bonds.end(),
                     [&](const BondDifference& bond) { return count(material, bond, point.volume).has_value(); });
}

bool CorrectionBundles::add(std::int64_t entry, std::uint16_t material, std::span<const PointCorrections> points) {
  std::map<int, std::array<std::int32_t, most_points>> bonds;
  std::size_t separately = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const auto& [own, volume] = points[n];
    separately += own.size() * (sizeof(double) + sizeof(std::int32_t));
    for (const BondDifference& bond : own) {
      const auto counted = steps_->count(material, bond, volume);
      if (!counted || bonds[counted->code][n] != 0) return false;
      bonds[counted->code][n] = counted->count;
    }
  }
  if (bonds.size() * (sizeof(std::uint16_t) + most_points * sizeof(std::int32_t)) > separately) return false;
  bundles_.push_back({entry, static_cast<std::int64_t>(codes_.size()), static_cast<std::uint32_t>(bonds.size()),
                      static_cast<std::uint16_t>(points.size()), material});
  for (std::size_t n = 0; n < most_points; ++n) {
    volumes_.push_back(n < points.size() ? points[n].volume : 1.0);
    rests_.push_back(BondSteps::rest(volumes_.back()));
  }
  for (const auto& [code, counts] : bonds) {
    codes_.push_back(static_cast<std::uint16_t>(code));
    counts_.insert(counts_.end(), counts.begin(), counts.end());
  }
  return true;
}

void CorrectionBundles::append(const CorrectionBundles& later) {
  const auto before = static_cast<std::int64_t>(codes_.size());
  if (!steps_) steps_ = later.steps_;
  for (Bundle bundle : later.bundles_) {
    bundle.begin += before;
    bundles_.push_back(bundle);
  }
  codes_.insert(codes_.end(), later.codes_.begin(), later.codes_.end());
  counts_.insert(counts_.end(), later.counts_.begin(), later.counts_.end());
  rests_.insert(rests_.end(), later.rests_.begin(), later.rests_.end());
  volumes_.insert(volumes_.end(), later.volumes_.begin(), later.volumes_.end());
}

void CorrectionBundles::shrink_to_fit() {
  bundles_.shrink_to_fit();
  codes_.shrink_to_fit();
  counts_.shrink_to_fit();
  rests_.shrink_to_fit();
  volumes_.shrink_to_fit();
}

/// None if the point is in no bundle.
const CorrectionBundles::Bundle* CorrectionBundles::find(std::int64_t entry) const {
  const auto later = std::upper_bound(bundles_.begin(), bundles_.end(), entry,
                                      [](std::int64_t wanted, const Bundle& b) { return wanted < b.entry; });
  if (later == bundles_.begin()) return nullptr;
  const Bundle& bundle = *(later - 1);
  return entry < bundle.entry + bundle.length ? &bundle : nullptr;
}

std::size_t CorrectionBundles::bytes() const {
  return bundles_.capacity() * sizeof(Bundle) + codes_.capacity() * sizeof(codes_[0]) +
         counts_.capacity() * sizeof(counts_[0]) + (rests_.capacity() + volumes_.capacity()) * sizeof(double);
}

}  // namespace peritherm
