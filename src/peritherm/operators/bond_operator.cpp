#include <algorithm>
#include <limits>
#include <utility>

#include "peritherm/base/error.hpp"
#include "peritherm/operators/conduction.hpp"

namespace peritherm {
namespace {

class BondOperator final : public ConductionOperator {
 public:
  BondOperator(Bonds bonds, std::vector<std::int64_t> entries, std::vector<double> inverse_capacities,
               std::size_t field_size, Precision precision)
      : bonds_(std::move(bonds)),
        entries_(std::move(entries)),
        inverse_capacities_(std::move(inverse_capacities)),
        size_(field_size) {
    if (field_size > static_cast<std::size_t>(std::numeric_limits<PointIndex>::max())) {
      throw Error("the bond backend numbers at most 2147483647 points and fictitious points",
                  "Choose fewer cells, or the stencil backend");
    }
    neighbours_.assign(bonds_.neighbours.begin(), bonds_.neighbours.end());
    bonds_.neighbours = {};
    if (precision == Precision::single) round_conductances();
    const std::vector<double> peaks =
        bonds_.cuts.empty() ? std::vector<double>{} : bonds_.cuts.peaks(bonds_.conductances);
    for (std::size_t row = 0; row < rows(); ++row) {
      double sum = 0.0;
      for (BondIndex b = bonds_.row_begin[row]; b < bonds_.row_begin[row + 1]; ++b) {
        sum += peaks.empty() ? conductance(b) : peaks[static_cast<std::size_t>(b)];
      }
      bound_ = std::max(bound_, 2.0 * sum * inverse_capacities_[row]);
      free_points_ += inverse_capacities_[row] > 0.0 ? 1 : 0;
    }
  }

  std::size_t size() const override { return size_; }
  std::size_t free_points() const override { return free_points_; }
  double gershgorin_bound() const override { return bound_; }

  void combine(ConstField temperature, double rate_weight, Terms terms, Field result,
               Accumulations accumulations) const override {
    const double* const values = temperature.data();
    // Entries that are no points of the body still take part in the combination.
#pragma omp parallel
    {
#pragma omp for schedule(static)
      for (std::size_t n = 0; n < size_; ++n) {
        for (const Accumulation& more : accumulations) {
          more.target[n] += more.temperature_weight * values[n] + more.result_weight * result[n];
        }
        result[n] = combined(terms, n);
      }
#pragma omp for schedule(static)
      for (std::size_t row = 0; row < rows(); ++row) {
        if (inverse_capacities_[row] == 0.0) continue;
        result[static_cast<std::size_t>(entries_[row])] +=
            rate_weight * inverse_capacities_[row] * heat_rate(row, values);
      }
    }
  }

  double sum_of_squares(Terms terms) const override {
    constexpr std::size_t chunk = 4096;
    std::vector<double> sums((rows() + chunk - 1) / chunk, 0.0);
#pragma omp parallel for schedule(static)
    for (std::size_t c = 0; c < sums.size(); ++c) {
      for (std::size_t row = c * chunk; row < std::min(rows(), (c + 1) * chunk); ++row) {
        if (inverse_capacities_[row] == 0.0) continue;
        const double value = combined(terms, static_cast<std::size_t>(entries_[row]));
        sums[c] += value * value;
      }
    }
    double sum = 0.0;
    for (const double part : sums) sum += part;
    return sum;
  }

  double heat_product(ConstField a, ConstField b) const override {
    double sum = 0.0;
    for (std::size_t row = 0; row < rows(); ++row) {
      const auto n = static_cast<std::size_t>(entries_[row]);
      if (inverse_capacities_[row] > 0.0) sum += a[n] * b[n] / inverse_capacities_[row];
    }
    return sum;
  }

  double stored_heat(ConstField temperature) const override {
    double sum = 0.0;
    for (std::size_t row = 0; row < rows(); ++row) {
      if (inverse_capacities_[row] > 0.0) {
        sum += temperature[static_cast<std::size_t>(entries_[row])] / inverse_capacities_[row];
      }
    }
    return sum;
  }

  double heat_capacity() const override {
    double sum = 0.0;
    for (const double inverse : inverse_capacities_) sum += inverse > 0.0 ? 1.0 / inverse : 0.0;
    return sum;
  }

  void heat_capacities(Field capacities) const override {
    std::fill(capacities.begin(), capacities.end(), 0.0);
    for (std::size_t row = 0; row < rows(); ++row) {
      if (inverse_capacities_[row] > 0.0) {
        capacities[static_cast<std::size_t>(entries_[row])] = 1.0 / inverse_capacities_[row];
      }
    }
  }

  Extremes extremes(ConstField temperature) const override {
    Extremes found{temperature[static_cast<std::size_t>(entries_[0])],
                   temperature[static_cast<std::size_t>(entries_[0])]};
    for (const std::int64_t entry : entries_) {
      const double value = temperature[static_cast<std::size_t>(entry)];
      found.lowest = value >= found.lowest ? found.lowest : value;
      found.highest = value <= found.highest ? found.highest : value;
      if (value - value != 0.0) return {value - value, value - value};
    }
    return found;
  }

  void visit_bonds(std::size_t entry, const Visitor& visit) const override {
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), static_cast<std::int64_t>(entry));
    if (found == entries_.end() || *found != static_cast<std::int64_t>(entry)) return;
    const auto row = static_cast<std::size_t>(found - entries_.begin());
    for (BondIndex b = bonds_.row_begin[row]; b < bonds_.row_begin[row + 1]; ++b) {
      visit(static_cast<std::size_t>(neighbours_[b]), conductance(b));
    }
  }

  bool average_over(double from, double to) override {
    const bool changed = bonds_.cuts.average_over(from, to, bonds_.conductances);
    if (!changed || rounded_.empty()) return changed;
    for (const std::size_t bond : changing_bonds_) rounded_[bond] = static_cast<float>(bonds_.conductances[bond]);
    return true;
  }

  bool changes_within(double from, double to) const override { return bonds_.cuts.changes_within(from, to); }

  std::vector<std::size_t> changing_points() const override {
    std::vector<std::size_t> points;
    for (const std::size_t bond : bonds_.cuts.entries()) {
      const auto next =
          std::upper_bound(bonds_.row_begin.begin(), bonds_.row_begin.end(), static_cast<BondIndex>(bond));
      points.push_back(
          static_cast<std::size_t>(entries_[static_cast<std::size_t>(next - bonds_.row_begin.begin()) - 1]));
    }
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  std::size_t bytes() const override {
    return neighbours_.capacity() * sizeof(PointIndex) + bonds_.conductances.capacity() * sizeof(double) +
           rounded_.capacity() * sizeof(float) + changing_bonds_.capacity() * sizeof(std::size_t) +
           bonds_.row_begin.capacity() * sizeof(BondIndex) + entries_.capacity() * sizeof(std::int64_t) +
           inverse_capacities_.capacity() * sizeof(double) + bonds_.cuts.bytes();
  }

 private:
  std::size_t rows() const { return entries_.size(); }

  static double combined(Terms terms, std::size_t n) {
    double value = 0.0;
    for (const Term& term : terms) value += term.weight * term.values[n];
    return value;
  }

  double conductance(BondIndex b) const {
    const auto k = static_cast<std::size_t>(b);
    return rounded_.empty() ? bonds_.conductances[k] : static_cast<double>(rounded_[k]);
  }

  /// Those in double stay only where growing cracks will change some of them.
  void round_conductances() {
    rounded_.assign(bonds_.conductances.begin(), bonds_.conductances.end());
    changing_bonds_ = bonds_.cuts.entries();
    if (changing_bonds_.empty()) bonds_.conductances = {};
  }

  double heat_rate(std::size_t row, const double* temperature) const {
    return rounded_.empty() ? sum_row(row, bonds_.conductances.data(), temperature)
                            : sum_row(row, rounded_.data(), temperature);
  }

  /// Σ_j G_ij (T_j − T_i); constants give 0 exactly. Four sums hide the latency of the additions. The time goes into
  /// reading neighbours and conductances, so differences and sums are double in any case.
  template <class Conductance>
  double sum_row(std::size_t row, const Conductance* g, const double* temperature) const {
    const double own = temperature[entries_[row]];
    const PointIndex* const j = neighbours_.data();
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    BondIndex b = bonds_.row_begin[row];
    const BondIndex end = bonds_.row_begin[row + 1];
    for (; b + 4 <= end; b += 4) {
      for (int k = 0; k < 4; ++k) sums[k] += static_cast<double>(g[b + k]) * (temperature[j[b + k]] - own);
    }
    for (; b < end; ++b) sums[0] += static_cast<double>(g[b]) * (temperature[j[b]] - own);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }

  Bonds bonds_;
  std::vector<float> rounded_;               ///< the conductances in single precision; empty in double
  std::vector<std::size_t> changing_bonds_;  ///< in single precision: bonds that change in time
  std::vector<PointIndex> neighbours_;
  std::vector<std::int64_t> entries_;
  std::vector<double> inverse_capacities_;
  std::size_t size_;
  std::size_t free_points_ = 0;
  double bound_ = 0.0;
};

}  // namespace

std::unique_ptr<ConductionOperator> make_bond_operator(Bonds bonds, std::vector<std::int64_t> entries,
                                                       std::vector<double> inverse_capacities, std::size_t field_size,
                                                       Precision precision) {
  return std::make_unique<BondOperator>(std::move(bonds), std::move(entries), std::move(inverse_capacities), field_size,
                                        precision);
}

}  // namespace peritherm
