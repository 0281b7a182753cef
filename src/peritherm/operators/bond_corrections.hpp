#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "peritherm/discretisation/cut_schedule.hpp"
#include "peritherm/discretisation/damage.hpp"
#include "peritherm/discretisation/held_points.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/discretisation/row_intervals.hpp"
#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/operators/correction_bundles.hpp"
#include "peritherm/operators/correction_patterns.hpp"

namespace peritherm {

/// The bonds whose conductance differs from the stencil's: cut, partly conducting, between materials, to places where
/// nothing is. What is kept is the difference of the conductance [W/K], of whole cells, to be added to the stencil's.
class BondCorrections {
 public:
  static constexpr int longest_segment = 64;

  /// Neighbouring points along x that share all their differences.
  struct Segment {
    std::int64_t entry;
    std::uint32_t pattern;
    std::uint16_t length;
    std::uint16_t scale;  ///< index into scales
  };
  /// A point with bonds that change in time.
  struct ChangingRow {
    std::int64_t entry;
    std::int64_t end;  ///< of its own in distances and differences
    std::uint16_t scale;
  };
  struct Parts {
    std::vector<double> scales;  ///< 1 / (ρ c V) per material [K/J], and 0 for what is held
    CorrectionPatterns patterns;
    std::vector<Segment> segments;   ///< block by block; in a block those of a pattern stand together
    std::vector<std::size_t> begin;  ///< blocks + 1, into segments; the blocks' points ascend
    CorrectionBundles bundles;
    std::vector<std::size_t> bundle_begin;  ///< blocks + 1, into bundles
    std::vector<ChangingRow> rows;          ///< ascending
    std::vector<std::int32_t> distances;
    std::vector<double> differences;  ///< at the time that was last asked for
    CutSchedule cuts;                 ///< how differences change in time
    CutBonds cut_bonds;
  };

  /// `kernel`: name of an instruction set, as in available_kernels().
  BondCorrections(Parts parts, std::string_view kernel);

  /// result += rate_weight · Σ difference (T_j − T_i) / C_i; the same bits for any number of threads.
  void apply(ConstField temperature, double rate_weight, Field result) const;

  /// Calls visit(entry of j minus the point's own, difference) for the corrected bonds of a point. A bond may be
  /// visited several times: the sum counts.
  template <class Visit>
  void visit(std::size_t entry, Visit&& visit) const {
    visit_with(parts_.differences, entry, visit);
  }

  /// Changing differences take their means over [from, to]. True if any is another than before.
  bool changes_within(double from, double to) const { return parts_.cuts.changes_within(from, to); }
  bool average_over(double from, double to) { return parts_.cuts.average_over(from, to, parts_.differences); }
  /// Entries of points whose bonds change in time, ascending.
  std::vector<std::size_t> changing_points() const;

  /// Calls visit(entry, Σ of the differences that raise a conductance) for all corrected points that are not held;
  /// those that change in time as far as they ever do.
  void for_raised(const std::function<void(std::size_t, double)>& visit) const;

  bool empty() const { return parts_.segments.empty() && parts_.bundles.bundles().empty() && parts_.rows.empty(); }
  const CutBonds& cut_bonds() const { return parts_.cut_bonds; }
  std::size_t bytes() const;

 private:
  /// `differences`: of the bonds that change.
  template <class Visit>
  void visit_with(const std::vector<double>& differences, std::size_t entry, Visit&& visit) const {
    for (const BondList& bonds : lists_of(static_cast<std::int64_t>(entry), differences)) {
      for (int k = 0; k < bonds.count; ++k) visit(bonds[k].distance, bonds[k].difference);
    }
    parts_.bundles.visit(static_cast<std::int64_t>(entry), visit);
  }
  /// Bonds of segments, and those that change.
  std::array<BondList, 2> lists_of(std::int64_t entry, const std::vector<double>& differences) const;
  BondList list_of_row(std::size_t row, const std::vector<double>& differences) const;
  const Segment* find_segment(std::int64_t entry) const;
  double raised_at(std::size_t entry, const std::vector<double>& peaks) const;
  void apply_segments(std::size_t block, const double* temperature, double rate_weight, double* result) const;
  void apply_bundles(std::size_t block, const double* temperature, double rate_weight, double* result) const;
  void apply_row(std::size_t row, const double* temperature, double rate_weight, double* result) const;
  void order_by_entry();

  Parts parts_;
  const CorrectionKernels& kernels_;
  std::vector<std::uint32_t> by_entry_;  ///< numbers of the segments, ascending by entry
};

/// Follows every bond that may differ from the stencil's, once. `kernel` as above.
BondCorrections make_corrections(const Body& body, const PaddedGrid& layout, const Stencil& stencil,
                                 const HeldPoints& held_by, std::string_view kernel);

/// Points with at least one bond that may differ from the stencil's; merged.
std::vector<RowInterval> find_special_points(const Body& body, const Stencil& stencil);

}  // namespace peritherm
