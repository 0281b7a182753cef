#include "peritherm/reduction/condensation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

std::vector<bool> free_among(const SparseHeat& heat, std::size_t points) {
  std::vector<bool> is_free(points, false);
  for (const std::int64_t point : heat.points) is_free[static_cast<std::size_t>(point)] = true;
  return is_free;
}

/// Row sums of R: how much of a constant the retained points pass on to each truncated one.
Matrix passed_on(const SplitHeat& split, const SparseMatrix& coupling) {
  Matrix sums(split.truncated.size(), 1);
  const std::vector<double> minus_ones(coupling.columns, -1.0);
  add_product(coupling, minus_ones, sums.values);
  split.factor.solve(sums);
  return sums;
}

/// R, column by column as it is found, row by row as it is asked for.
class ShareBuilder {
 public:
  ShareBuilder(const SplitHeat& split, double drop, std::size_t most_bytes)
      : split_(split),
        drop_(drop),
        most_bytes_(most_bytes),
        coupling_(part_of(split.heat.conductances, split.truncated, split.retained)),
        sums_(passed_on(split, coupling_)),
        kept_(sums_.rows, 0.0),
        counts_(sums_.rows, 0),
        largest_(sums_.rows, {0.0, -1}) {}

  SparseMatrix operator()() {
    const SparseMatrix columns = part_of(split_.heat.conductances, split_.retained, split_.truncated);
    constexpr std::size_t width = 64;
    const std::size_t count = split_.retained.size();
    for (std::size_t first = 0; first < count; first += width) {
      Matrix block(split_.truncated.size(), std::min(width, count - first));
      for (std::size_t k = 0; k < block.columns; ++k) {
        for (auto n = static_cast<std::size_t>(columns.begin[first + k]);
             n < static_cast<std::size_t>(columns.begin[first + k + 1]); ++n)
          block(static_cast<std::size_t>(columns.column_of[n]), k) = -columns.values[n];
      }
      split_.factor.solve(block);
      for (std::size_t k = 0; k < block.columns; ++k) keep(block.column(k), first + k);
      require_room(first + block.columns, count);
    }
    return rows();
  }

 private:
  void keep(ConstField column, std::size_t number) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      const double share = column[i];
      if (share == 0.0) continue;
      if (std::abs(share) > std::abs(largest_[i].first)) largest_[i] = {share, static_cast<std::int32_t>(number)};
      if (std::abs(share) < drop_) continue;
      entries_.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(number), share});
      kept_[i] += share;
      ++counts_[i];
    }
  }

  void require_room(std::size_t done, std::size_t count) const {
    if (most_bytes_ == 0) return;
    // Both orders are held at once.
    const double bytes =
        28.0 * static_cast<double>(entries_.size()) * static_cast<double>(count) / static_cast<double>(done);
    if (bytes <= static_cast<double>(most_bytes_)) return;
    throw Error(
        fmt::format("the shares of {} retained points in {} others take about {:.3g} GiB, and {:.3g} GiB are free",
                    count, sums_.rows, bytes / 0x1p30, static_cast<double>(most_bytes_) / 0x1p30),
        "Retain fewer points, raise 'drop', or choose the method rational_krylov", Fault::machine);
  }

  /// What dropping took from a row goes back to the others. Next to held points nothing may be left but the largest.
  SparseMatrix rows() {
    constexpr double hardly_any = 1e-6;
    SparseMatrix matrix;
    matrix.columns = split_.retained.size();
    std::vector<double> scales(sums_.rows, 1.0);
    for (std::size_t i = 0; i < sums_.rows; ++i) {
      const double sum = sums_.values[i];
      const bool lost = std::abs(kept_[i]) < 0.5 * std::abs(sum);
      if (lost && std::abs(sum) > hardly_any) {
        throw Error(fmt::format("dropping shares below {} leaves less than half of some points' temperatures", drop_),
                    "Lower 'drop'; the default is 1e-10");
      }
      if (lost && largest_[i].second >= 0) {
        scales[i] = 0.0;
        counts_[i] = 1;
      } else if (kept_[i] != 0.0) {
        scales[i] = sum / kept_[i];
      }
      matrix.begin.push_back(matrix.begin.back() + counts_[i]);
    }
    matrix.column_of.resize(static_cast<std::size_t>(matrix.begin.back()));
    matrix.values.resize(matrix.column_of.size());
    std::vector<std::int64_t> place(matrix.begin.begin(), matrix.begin.end() - 1);
    const auto put = [&](std::size_t i, std::int32_t column, double value) {
      const auto n = static_cast<std::size_t>(place[i]++);
      matrix.column_of[n] = column;
      matrix.values[n] = value;
    };
    for (const Entry& entry : entries_) {
      const auto i = static_cast<std::size_t>(entry.row);
      if (scales[i] != 0.0) put(i, entry.column, scales[i] * entry.share);
    }
    for (std::size_t i = 0; i < sums_.rows; ++i) {
      if (scales[i] == 0.0) put(i, largest_[i].second, sums_.values[i]);
    }
    return matrix;
  }

  struct Entry {
    std::int32_t row, column;
    double share;
  };
  const SplitHeat& split_;
  double drop_;
  std::size_t most_bytes_;
  SparseMatrix coupling_;  ///< K_tr
  Matrix sums_;            ///< of the rows of R, exactly
  std::vector<double> kept_;
  std::vector<std::int64_t> counts_;
  std::vector<std::pair<double, std::int32_t>> largest_;
  std::vector<Entry> entries_;
};

}  // namespace

UnitLoads find_unit_loads(FullSystem& full, const SparseHeat& heat) {
  std::size_t inputs = 0;
  for (const Load& load : full.loads) inputs += load.shapes.size();
  HeatSystem& system = full.system;
  const std::size_t field_size = system.field_size();
  UnitLoads loads{Matrix(heat.size(), inputs),
                  Matrix(full.layout.grid().size(), inputs),
                  Matrix(system.size() - field_size, inputs),
                  {}};
  FieldStorage held(system.size()), rate(system.size());
  std::vector<double> rates(full.layout.grid().size());
  for (const Load& load : full.loads) {
    for (const LoadShape& shape : load.shapes) {
      const std::size_t m = loads.kinds.size();
      system.load_rate({load.boundary, load.source}, shape.profile, shape.time, held, rate);
      full.layout.gather(held, loads.held.column(m));
      full.layout.gather(rate, rates);
      for (std::size_t i = 0; i < heat.size(); ++i) {
        const auto point = static_cast<std::size_t>(heat.points[i]);
        loads.heat(i, m) = heat.capacities[i] * rates[point];
        loads.held(point, m) = 0.0;
      }
      for (std::size_t a = 0; a < loads.accounts.rows; ++a) loads.accounts(a, m) = rate[field_size + a];
      loads.kinds.push_back(load.kind);
    }
  }
  return loads;
}

SplitHeat split_heat(FullSystem& full, const RetainedPoints& choice, std::vector<std::string>& notes) {
  HeatSystem& system = full.system;
  if (system.body_changes_within(0.0, full.longest_time)) {
    throw Error("a body whose cracks grow cannot be condensed: the model would hold at one instant only",
                "Choose the method proper_orthogonal, or let the cracks stand");
  }
  std::vector<double> padded(system.field_size()), capacities(full.layout.grid().size());
  system.conduction().heat_capacities(padded);
  full.layout.gather(padded, capacities);
  SparseHeat heat = make_sparse_heat(system, full.layout, capacities);
  const RetainedSet set =
      select_retained(choice, full.layout.grid(), full.present, free_among(heat, capacities.size()));
  notes.insert(notes.end(), set.notes.begin(), set.notes.end());
  std::vector<std::int32_t> retained, truncated;
  for (std::size_t i = 0; i < heat.size(); ++i) {
    const bool keep = std::binary_search(set.points.begin(), set.points.end(), heat.points[i]);
    (keep ? retained : truncated).push_back(static_cast<std::int32_t>(i));
  }
  require_few_unknowns(retained.size());
  require_anchors(heat, truncated, full.layout.grid());
  SparseFactor factor(part_of(heat.conductances, truncated, truncated), full.memory);
  return {std::move(heat), std::move(retained), std::move(truncated), std::move(factor)};
}

SparseMatrix condensed_shapes(const SplitHeat& split, double drop, const Matrix& modes, std::size_t most_bytes) {
  const SparseMatrix shares = ShareBuilder(split, drop, most_bytes)();
  SparseMatrix shapes;
  shapes.columns = split.retained.size() + modes.columns;
  std::size_t r = 0;
  for (std::size_t i = 0; i < split.heat.size(); ++i) {
    if (r < split.retained.size() && static_cast<std::size_t>(split.retained[r]) == i) {
      shapes.column_of.push_back(static_cast<std::int32_t>(r++));
      shapes.values.push_back(1.0);
    } else {
      const std::size_t t = i - r;
      const std::int64_t first = shares.begin[t], last = shares.begin[t + 1];
      shapes.column_of.insert(shapes.column_of.end(), shares.column_of.begin() + first,
                              shares.column_of.begin() + last);
      shapes.values.insert(shapes.values.end(), shares.values.begin() + first, shares.values.begin() + last);
      for (std::size_t k = 0; k < modes.columns; ++k) {
        shapes.column_of.push_back(static_cast<std::int32_t>(split.retained.size() + k));
        shapes.values.push_back(modes(t, k));
      }
    }
    shapes.begin.push_back(static_cast<std::int64_t>(shapes.values.size()));
  }
  return shapes;
}

Matrix static_responses(const SplitHeat& split, const UnitLoads& loads, bool of_heat_too) {
  const std::size_t inputs = loads.kinds.size();
  Matrix parts(split.truncated.size(), inputs);
  for (std::size_t m = 0; m < inputs; ++m) {
    if (loads.kinds[m] == LoadKind::heat && !of_heat_too) continue;
    for (std::size_t t = 0; t < parts.rows; ++t) {
      parts(t, m) = loads.heat(static_cast<std::size_t>(split.truncated[t]), m);
    }
  }
  split.factor.solve(parts);
  Matrix responses(split.heat.size(), inputs);
  for (std::size_t m = 0; m < inputs; ++m) {
    for (std::size_t t = 0; t < parts.rows; ++t) {
      responses(static_cast<std::size_t>(split.truncated[t]), m) = parts(t, m);
    }
  }
  return responses;
}

void tell(const ReductionProgress& progress, const std::string& stage, double share) {
  if (progress && !progress(stage, share)) throw Error("the reduction was stopped", {}, Fault::machine);
}

Lap::Lap() : last_(0.0) { (*this)(); }

double Lap::operator()() {
  const double now = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  return now - std::exchange(last_, now);
}

void require_few_unknowns(std::size_t unknowns) {
  constexpr std::size_t most = 4000;
  if (unknowns <= most) return;
  throw Error(
      fmt::format("a condensed model of {} unknowns is too large: its equations are coupled densely, and to "
                  "decouple them takes time with the third power of their number; {} are the most",
                  unknowns, most),
      "Retain fewer points, or choose the method rational_krylov, which is more exact with a few dozen unknowns");
}

}  // namespace peritherm
