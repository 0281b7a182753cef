#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "peritherm/operators/bond_corrections.hpp"
#include "peritherm/operators/conduction.hpp"
#include "peritherm/operators/row_runs.hpp"
#include "peritherm/operators/stencil_program.hpp"
#include "peritherm/operators/stencil_sum.hpp"

namespace peritherm {
namespace {

class GridOperator final : public ConductionOperator {
 public:
  GridOperator(const Body& body, const PaddedGrid& layout, const Stencil& stencil,
               const std::vector<std::int16_t>& held_by, std::size_t kernel)
      : layout_(layout),
        stencil_(stencil),
        uniform_(make_direct_sum(layout, stencil, kernel)),
        kernels_(available_kernels().at(kernel)),
        runs_(make_row_runs(body, held_by)),
        corrections_(make_corrections(body, layout, stencil)) {
    for (const StencilEntry& entry : stencil.entries) stencil_sum_ += entry.conductance;
    for (const Material& material : body.materials) conductivities_.push_back(material.conductivity);
    if (body.materials.size() > 1 || body.has_voids()) material_of_ = body.material_of;
    const double volume = body.grid.cell_volume();
    for (std::size_t r = 0; r < corrections_.rows.size(); ++r) {
      const std::size_t point = body.grid.number(layout.index(static_cast<std::size_t>(corrections_.rows[r])));
      const Material& material = body.materials[body.material_of[point]];
      const bool free = held_by.empty() || held_by[point] < 0;
      correction_scales_.push_back(free ? 1.0 / (volumetric_heat_capacity(material) * volume) : 0.0);
    }
  }

  std::size_t size() const override { return layout_.size(); }
  std::size_t free_points() const override { return runs_.free_points; }

  void combine(ConstField temperature, double rate_weight, Terms terms, Field result,
               Accumulations accumulations) const override {
    uniform_->sum(temperature, [&](const double* sums, const GridIndex& first, int width) {
      combine_row(sums, temperature, rate_weight, terms, result, accumulations, first, width);
    });
#pragma omp parallel for schedule(static)
    for (std::size_t r = 0; r < corrections_.rows.size(); ++r) correct_row(r, temperature, rate_weight, result);
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
    });
  }

  double stored_heat(ConstField temperature) const override {
    return sum_over_rows([&](const RowRun& run, const GridIndex& row, std::size_t entry) {
      if (run.rate_scale == 0.0) return 0.0;
      double sum = 0.0;
      for (std::int32_t x = run.begin; x < run.end; ++x) {
        sum += layout_.grid().volume_share({x, row[1], row[2]}) * temperature[entry + static_cast<std::size_t>(x)];
      }
      return run.capacity * sum;
    });
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
    const double volume_share = layout_.grid().volume_share(p);
    const double own = conductivities_[material] * volume_share;
    for (const StencilEntry& bond : stencil_.entries) {
      visit(entry + static_cast<std::size_t>(layout_.distance(bond.offset)), own * bond.conductance);
    }
    const auto found =
        std::lower_bound(corrections_.rows.begin(), corrections_.rows.end(), static_cast<std::int64_t>(entry));
    if (found == corrections_.rows.end() || *found != static_cast<std::int64_t>(entry)) return;
    const auto row = static_cast<std::size_t>(found - corrections_.rows.begin());
    for (std::int64_t c = corrections_.row_begin[row]; c < corrections_.row_begin[row + 1]; ++c) {
      visit(entry + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(corrections_.distances[c])),
            volume_share * corrections_.differences[c]);
    }
  }

  bool average_over(double from, double to) override {
    return corrections_.cuts.average_over(from, to, corrections_.differences);
  }

  bool changes_within(double from, double to) const override { return corrections_.cuts.changes_within(from, to); }

  std::vector<std::size_t> changing_points() const override {
    std::vector<std::size_t> points;
    for (const std::size_t c : corrections_.cuts.entries()) {
      const auto next =
          std::upper_bound(corrections_.row_begin.begin(), corrections_.row_begin.end(), static_cast<std::int64_t>(c));
      points.push_back(static_cast<std::size_t>(
          corrections_.rows[static_cast<std::size_t>(next - corrections_.row_begin.begin()) - 1]));
    }
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  double gershgorin_bound() const override {
    double bound = 0.0;
    for (const RowRun& run : runs_.runs) bound = std::max(bound, 2.0 * stencil_sum_ * run.rate_scale);
    for (std::size_t r = 0; r < corrections_.rows.size(); ++r) {
      double raised = 0.0;
      for (std::int64_t c = corrections_.row_begin[r]; c < corrections_.row_begin[r + 1]; ++c) {
        raised += std::max(0.0, corrections_.differences[c]);
      }
      const GridIndex p = layout_.index(static_cast<std::size_t>(corrections_.rows[r]));
      const double own = conductivities_[material_of(layout_.grid().number(p))] * stencil_sum_;
      bound = std::max(bound, 2.0 * correction_scales_[r] * (own + raised));
    }
    return bound;
  }

  std::size_t bytes() const override {
    return uniform_->bytes() + runs_.runs.capacity() * sizeof(RowRun) +
           runs_.row_begin.capacity() * sizeof(std::int64_t) + corrections_.bytes() +
           correction_scales_.capacity() * sizeof(double) + material_of_.capacity();
  }

 private:
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

  void correct_row(std::size_t r, ConstField temperature, double rate_weight, Field result) const {
    if (correction_scales_[r] == 0.0) return;
    const double* const own = temperature.data() + corrections_.rows[r];
    double sum = 0.0;
    for (std::int64_t c = corrections_.row_begin[r]; c < corrections_.row_begin[r + 1]; ++c) {
      sum += corrections_.differences[c] * (own[corrections_.distances[c]] - *own);
    }
    result[static_cast<std::size_t>(corrections_.rows[r])] += rate_weight * correction_scales_[r] * sum;
  }

  PaddedGrid layout_;
  Stencil stencil_;
  std::unique_ptr<StencilSum> uniform_;
  Kernels kernels_;
  RowRuns runs_;
  BondCorrections corrections_;
  std::vector<double> correction_scales_;  ///< 1 / (ρ c V) per corrected row; 0 if held
  std::vector<double> conductivities_;
  std::vector<MaterialIndex> material_of_;  ///< empty if all points are of the first material
  double stencil_sum_ = 0.0;
};

}  // namespace

std::unique_ptr<ConductionOperator> make_stencil_operator(const Body& body, const PaddedGrid& layout,
                                                          const Stencil& stencil,
                                                          const std::vector<std::int16_t>& held_by,
                                                          std::size_t kernel) {
  return std::make_unique<GridOperator>(body, layout, stencil, held_by, kernel);
}

}  // namespace peritherm
