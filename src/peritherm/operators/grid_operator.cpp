#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "peritherm/operators/bond_corrections.hpp"
#include "peritherm/operators/conduction.hpp"
#include "peritherm/operators/kernels.hpp"
#include "peritherm/operators/row_runs.hpp"
#include "peritherm/operators/stencil_sum.hpp"

namespace peritherm {
namespace {

class GridOperator final : public ConductionOperator {
 public:
  GridOperator(const Body& body, const PaddedGrid& layout, const Stencil& stencil, const HeldPoints& held_by,
               std::size_t kernel, std::shared_ptr<const StencilSum> uniform)
      : layout_(layout),
        stencil_(stencil),
        uniform_(uniform ? std::move(uniform) : std::shared_ptr(make_direct_sum(layout, stencil, kernel))),
        kernels_(available_kernels().at(kernel)),
        runs_(make_row_runs(body, held_by)),
        corrections_(make_corrections(body, layout, stencil, held_by, kernels_.name)) {
    for (const StencilEntry& entry : stencil.entries) stencil_sum_ += entry.conductance;
    for (const Material& material : body.materials) {
      conductivities_.push_back(material.conductivity);
      inverse_capacities_.push_back(1.0 / (volumetric_heat_capacity(material) * body.grid.cell_volume()));
    }
    if (body.materials.size() > 1 || body.has_voids()) material_of_ = body.material_of;
    for (const std::int64_t point : body.faces.points()) {
      const GridIndex p = body.grid.index(static_cast<std::size_t>(point));
      const double volume = body.faces.volume(static_cast<std::size_t>(point));
      if (volume == 1.0) continue;
      const bool held = held_by[static_cast<std::size_t>(point)] >= 0;
      const double capacity = 1.0 / inverse_capacities_[material_of(static_cast<std::size_t>(point))];
      const double excess = held ? 0.0 : capacity * body.grid.volume_share(p) * (volume - 1.0);
      parted_.push_back({layout.entry(p), volume, excess});
    }
  }

  std::size_t size() const override { return layout_.size(); }
  std::size_t free_points() const override { return runs_.free_points; }

  void combine(ConstField temperature, double rate_weight, Terms terms, Field result,
               Accumulations accumulations) const override {
    uniform_->sum(temperature, [&](const double* sums, const GridIndex& first, int width) {
      combine_row(sums, temperature, rate_weight, terms, result, accumulations, first, width);
    });
    corrections_.apply(temperature, rate_weight, result);
  }

  double sum_of_squares(Terms terms) const override {
    return sum_over_rows([terms](const RowRun& run, const GridIndex&, std::size_t entry) {
      if (run.rate_scale == 0.0) return 0.0;
      double sum = 0.0;
      for (std::int32_t x = run.begin; x < run.end; ++x) {
        double value = 0.0;
        for (const Term& term : terms) value += term.weight * term.values[entry + static_cast<std::size_t>(x)];
        sum += value * value;
      }
      return sum;
    });
  }

  double heat_product(ConstField a, ConstField b) const override {
    return sum_over_rows([&](const RowRun& run, const GridIndex& row, std::size_t entry) {
             if (run.rate_scale == 0.0) return 0.0;
             double sum = 0.0;
             for (std::int32_t x = run.begin; x < run.end; ++x) {
               const std::size_t n = entry + static_cast<std::size_t>(x);
               sum += layout_.grid().volume_share({x, row[1], row[2]}) * (a[n] * b[n]);
             }
             return run.capacity * sum;
           }) +
           sum_over_parted([&](std::size_t n) { return a[n] * b[n]; });
  }

  double stored_heat(ConstField temperature) const override {
    return sum_over_rows([&](const RowRun& run, const GridIndex& row, std::size_t entry) {
             if (run.rate_scale == 0.0) return 0.0;
             double sum = 0.0;
             for (std::int32_t x = run.begin; x < run.end; ++x) {
               sum +=
                   layout_.grid().volume_share({x, row[1], row[2]}) * temperature[entry + static_cast<std::size_t>(x)];
             }
             return run.capacity * sum;
           }) +
           sum_over_parted([&](std::size_t n) { return temperature[n]; });
  }

  double heat_capacity() const override {
    return sum_over_rows([&](const RowRun& run, const GridIndex& row, std::size_t) {
             if (run.rate_scale == 0.0) return 0.0;
             double sum = 0.0;
             for (std::int32_t x = run.begin; x < run.end; ++x) sum += layout_.grid().volume_share({x, row[1], row[2]});
             return run.capacity * sum;
           }) +
           sum_over_parted([](std::size_t) { return 1.0; });
  }

  void heat_capacities(Field capacities) const override {
    std::fill(capacities.begin(), capacities.end(), 0.0);
    for (std::int64_t row = 0; row < row_count(); ++row) {
      const GridIndex first = row_index(row);
      for (std::int64_t k = runs_.row_begin[row]; k < runs_.row_begin[row + 1]; ++k) {
        const RowRun& run = runs_.runs[k];
        for (std::int32_t x = run.begin; x < run.end && run.rate_scale != 0.0; ++x) {
          capacities[layout_.entry({x, first[1], first[2]})] =
              run.capacity * layout_.grid().volume_share({x, first[1], first[2]});
        }
      }
    }
    for (const PartedCell& cell : parted_) capacities[cell.entry] += cell.excess;
  }

  Extremes extremes(ConstField temperature) const override {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double lowest = infinity, highest = -infinity;
    bool valid = true;
#pragma omp parallel for schedule(static) reduction(min : lowest) reduction(max : highest) reduction(&& : valid)
    for (std::int64_t row = 0; row < row_count(); ++row) {
      const std::size_t entry = layout_.entry(row_index(row));
      for (std::int64_t k = runs_.row_begin[row]; k < runs_.row_begin[row + 1]; ++k) {
        if (runs_.runs[k].capacity == 0.0) continue;
        for (std::int32_t x = runs_.runs[k].begin; x < runs_.runs[k].end; ++x) {
          const double value = temperature[entry + static_cast<std::size_t>(x)];
          lowest = std::min(lowest, value);
          highest = std::max(highest, value);
          valid = valid && value - value == 0.0;
        }
      }
    }
    if (!valid) lowest = highest = std::numeric_limits<double>::quiet_NaN();
    return {lowest, highest};
  }

  void visit_bonds(std::size_t entry, const Visitor& visit) const override {
    const GridIndex p = layout_.index(entry);
    const MaterialIndex material = material_of(layout_.grid().number(p));
    if (material == no_material) return;
    const double volume_share = layout_.grid().volume_share(p) * parted_share(entry);
    const double own = conductivities_[material] * volume_share;
    for (const StencilEntry& bond : stencil_.entries) {
      visit(entry + static_cast<std::size_t>(layout_.distance(bond.offset)), own * bond.conductance);
    }
    corrections_.visit(entry, [&](std::int64_t distance, double difference) {
      visit(static_cast<std::size_t>(static_cast<std::int64_t>(entry) + distance), volume_share * difference);
    });
  }

  std::size_t reach() const override {
    std::ptrdiff_t largest = 0;
    for (const StencilEntry& bond : stencil_.entries) largest = std::max(largest, layout_.distance(bond.offset));
    return static_cast<std::size_t>(largest);
  }

  bool changes_within(double from, double to) const override { return corrections_.changes_within(from, to); }

  /// Offset by offset along the stretch.
  void add_exchange_weights(const Stretch& stretch, std::span<const std::int16_t> holder, int boundary,
                            std::int64_t origin, Field weights) const override {
    const auto length = static_cast<std::size_t>(stretch.length);
    std::vector<double> scales(length), sums(length, 0.0);
    GridIndex p = layout_.index(static_cast<std::size_t>(stretch.entry));
    const std::int16_t* const holders = holder.data() + stretch.entry;
    for (std::size_t x = 0; x < length; ++x, ++p[0]) {
      const MaterialIndex material = material_of(layout_.grid().number(p));
      if (holders[x] >= 0 || material == no_material) continue;
      scales[x] = conductivities_[material] * layout_.grid().volume_share(p) *
                  parted_share(static_cast<std::size_t>(stretch.entry) + x);
    }
    const auto held = static_cast<std::int16_t>(boundary);
    for (const StencilEntry& bond : stencil_.entries) {
      const std::ptrdiff_t distance = layout_.distance(bond.offset);
      const std::int16_t* const others = holders + distance;
      if (std::find(others, others + length, held) == others + length) continue;
      double* const there = weights.data() + (stretch.entry - origin + distance);
      for (std::size_t x = 0; x < length; ++x) {
        const double conductance = others[x] == held ? scales[x] * bond.conductance : 0.0;
        sums[x] += conductance;
        there[x] += conductance;
      }
    }
    double* const own = weights.data() + (stretch.entry - origin);
    for (std::size_t x = 0; x < length; ++x) own[x] -= sums[x];
    if (!corrections_.empty()) add_correction_weights(stretch, scales, holder, held, origin, weights);
  }

  bool average_over(double from, double to) override { return corrections_.average_over(from, to); }

  std::vector<std::size_t> changing_points() const override { return corrections_.changing_points(); }

  const CutBonds* cut_bonds() const override { return &corrections_.cut_bonds(); }

  double gershgorin_bound() const override {
    double bound = 0.0;
    for (const RowRun& run : runs_.runs) bound = std::max(bound, 2.0 * stencil_sum_ * run.rate_scale);
    corrections_.for_raised([&](std::size_t entry, double raised) {
      const MaterialIndex material = material_of(layout_.grid().number(layout_.index(entry)));
      bound =
          std::max(bound, 2.0 * inverse_capacities_[material] * (conductivities_[material] * stencil_sum_ + raised));
    });
    return bound;
  }

  std::size_t bytes() const override {
    return uniform_->bytes() + runs_.runs.capacity() * sizeof(RowRun) +
           runs_.row_begin.capacity() * sizeof(std::int64_t) + corrections_.bytes() + material_of_.capacity();
  }

 private:
  /// A cell beside a crack that is not all its point's own, or has taken on a part of another.
  struct PartedCell {
    std::size_t entry;
    double volume;  ///< share of a cell
    double excess;  ///< heat capacity beyond that of a whole cell [J/K]; 0 if held
  };

  double parted_share(std::size_t entry) const {
    const auto found = std::lower_bound(parted_.begin(), parted_.end(), entry,
                                        [](const PartedCell& cell, std::size_t wanted) { return cell.entry < wanted; });
    return found != parted_.end() && found->entry == entry ? found->volume : 1.0;
  }

  template <class Value>
  double sum_over_parted(Value value) const {
    double sum = 0.0;
    for (const PartedCell& cell : parted_) sum += cell.excess * value(cell.entry);
    return sum;
  }

  void add_correction_weights(const Stretch& stretch, const std::vector<double>& scales,
                              std::span<const std::int16_t> holder, std::int16_t held, std::int64_t origin,
                              Field weights) const {
    for (std::int32_t x = 0; x < stretch.length; ++x) {
      if (scales[static_cast<std::size_t>(x)] == 0.0) continue;
      const std::int64_t entry = stretch.entry + x;
      const double volume_share = layout_.grid().volume_share(layout_.index(static_cast<std::size_t>(entry))) *
                                  parted_share(static_cast<std::size_t>(entry));
      corrections_.visit(static_cast<std::size_t>(entry), [&](std::int64_t distance, double difference) {
        if (holder[static_cast<std::size_t>(entry + distance)] != held) return;
        weights[static_cast<std::size_t>(entry + distance - origin)] += volume_share * difference;
        weights[static_cast<std::size_t>(entry - origin)] -= volume_share * difference;
      });
    }
  }

  MaterialIndex material_of(std::size_t point) const { return material_of_.empty() ? 0 : material_of_[point]; }
  std::int64_t row_count() const { return static_cast<std::int64_t>(runs_.row_begin.size()) - 1; }
  GridIndex row_index(std::int64_t row) const {
    return {0, static_cast<int>(row % layout_.grid().count(1)), static_cast<int>(row / layout_.grid().count(1))};
  }

  /// Sums sum(run, first point of its row, entry of that point) over all runs; row by row, so in a fixed order.
  template <class Sum>
  double sum_over_rows(Sum sum) const {
    std::vector<double> sums(static_cast<std::size_t>(row_count()), 0.0);
#pragma omp parallel for schedule(static)
    for (std::int64_t row = 0; row < row_count(); ++row) {
      const GridIndex first = row_index(row);
      for (std::int64_t k = runs_.row_begin[row]; k < runs_.row_begin[row + 1]; ++k) {
        sums[static_cast<std::size_t>(row)] += sum(runs_.runs[k], first, layout_.entry(first));
      }
    }
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

  void combine_row(const double* sums, ConstField temperature, double rate_weight, Terms terms, Field result,
                   Accumulations accumulations, const GridIndex& first, int width) const {
    const auto row = static_cast<std::size_t>(first[1]) +
                     static_cast<std::size_t>(layout_.grid().count(1)) * static_cast<std::size_t>(first[2]);
    const std::size_t entry = layout_.entry(first);
    std::array<Term, 8> shifted;
    assert(terms.size() <= shifted.size());
    for (std::int64_t k = runs_.row_begin[row]; k < runs_.row_begin[row + 1]; ++k) {
      const RowRun& run = runs_.runs[k];
      const int begin = std::max(run.begin - first[0], 0);
      const int end = std::min(run.end - first[0], width);
      if (begin >= end) continue;
      const std::size_t at = entry + static_cast<std::size_t>(begin);
      for (const Accumulation& more : accumulations) {
        kernels_.accumulate_row(more.temperature_weight, temperature.data() + at, more.result_weight,
                                result.data() + at, end - begin, more.target + at);
      }
      for (std::size_t n = 0; n < terms.size(); ++n) {
        shifted[n] = {terms[n].weight, terms[n].values + at};
      }
      kernels_.combine_row(sums + begin, rate_weight * run.rate_scale, shifted.data(), terms.size(), end - begin,
                           result.data() + at);
    }
  }

  PaddedGrid layout_;
  Stencil stencil_;
  std::shared_ptr<const StencilSum> uniform_;
  Kernels kernels_;
  RowRuns runs_;
  BondCorrections corrections_;
  std::vector<PartedCell> parted_;  ///< ascending by entry
  std::vector<double> conductivities_;
  std::vector<double> inverse_capacities_;  ///< 1 / (ρ c V) of whole cells [K/J]
  std::vector<MaterialIndex> material_of_;  ///< empty if all points are of the first material
  double stencil_sum_ = 0.0;
};

}  // namespace

std::unique_ptr<ConductionOperator> make_stencil_operator(const Body& body, const PaddedGrid& layout,
                                                          const Stencil& stencil, const HeldPoints& held_by,
                                                          std::size_t kernel,
                                                          std::shared_ptr<const StencilSum> uniform) {
  return std::make_unique<GridOperator>(body, layout, stencil, held_by, kernel, std::move(uniform));
}

}  // namespace peritherm
