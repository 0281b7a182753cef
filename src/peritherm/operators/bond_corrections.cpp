#include "peritherm/operators/bond_corrections.hpp"

#include <algorithm>
#include <numeric>

namespace peritherm {
namespace {

/// Collects points that share a pattern until there are enough for the kernel.
class PointBatch {
 public:
  PointBatch(const CorrectionKernels& kernels, const BondList& bonds, const double* temperature, double* result)
      : kernels_(kernels), bonds_(bonds), temperature_(temperature), result_(result) {}

  void add(std::int64_t entry, double weight) {
    own_[static_cast<std::size_t>(count_)] = temperature_ + entry;
    weights_[static_cast<std::size_t>(count_)] = weight;
    if (++count_ == CorrectionKernels::most_points) flush();
  }

  void flush() {
    if (count_ == 0) return;
    double sums[CorrectionKernels::most_points];
    kernels_.sum_points(bonds_, own_.data(), count_, sums);
    for (int n = 0; n < count_; ++n) {
      const auto k = static_cast<std::size_t>(n);
      result_[own_[k] - temperature_] += weights_[k] * sums[n];
    }
    count_ = 0;
  }

 private:
  const CorrectionKernels& kernels_;
  const BondList bonds_;
  const double* temperature_;
  double* result_;
  int count_ = 0;
  std::array<const double*, CorrectionKernels::most_points> own_{};
  std::array<double, CorrectionKernels::most_points> weights_{};
};

}  // namespace

BondCorrections::BondCorrections(Parts parts, std::string_view kernel)
    : parts_(std::move(parts)), kernels_(correction_kernels(kernel)) {
  order_by_entry();
}

void BondCorrections::order_by_entry() {
  by_entry_.resize(parts_.segments.size());
  std::iota(by_entry_.begin(), by_entry_.end(), 0U);
  for (std::size_t b = 0; b + 1 < parts_.begin.size(); ++b) {
    std::sort(by_entry_.begin() + static_cast<std::ptrdiff_t>(parts_.begin[b]),
              by_entry_.begin() + static_cast<std::ptrdiff_t>(parts_.begin[b + 1]),
              [this](std::uint32_t i, std::uint32_t j) { return parts_.segments[i].entry < parts_.segments[j].entry; });
  }
}

void BondCorrections::apply(ConstField temperature, double rate_weight, Field result) const {
  const auto blocks = static_cast<std::int64_t>(parts_.begin.size()) - 1;
  const auto rows = static_cast<std::int64_t>(parts_.rows.size());
  if (blocks <= 0 && rows == 0) return;
#pragma omp parallel if (blocks > 1 || rows > 256)
  {
#pragma omp for schedule(static)
    for (std::int64_t b = 0; b < blocks; ++b) {
      apply_segments(static_cast<std::size_t>(b), temperature.data(), rate_weight, result.data());
      apply_bundles(static_cast<std::size_t>(b), temperature.data(), rate_weight, result.data());
    }
    // A point may have bonds of both kinds: the loop above is complete before this one begins.
#pragma omp for schedule(static)
    for (std::int64_t r = 0; r < rows; ++r) {
      apply_row(static_cast<std::size_t>(r), temperature.data(), rate_weight, result.data());
    }
  }
}

void BondCorrections::apply_segments(std::size_t block, const double* temperature, double rate_weight,
                                     double* result) const {
  double sums[longest_segment];
  const std::size_t end = parts_.begin[block + 1];
  for (std::size_t s = parts_.begin[block]; s < end;) {
    const std::uint32_t pattern = parts_.segments[s].pattern;
    const BondList bonds = parts_.patterns[pattern];
    PointBatch batch(kernels_, bonds, temperature, result);
    for (; s < end && parts_.segments[s].pattern == pattern; ++s) {
      const Segment& segment = parts_.segments[s];
      const double weight = rate_weight * parts_.scales[segment.scale];
      if (weight == 0.0) continue;
      if (segment.length < kernels_.lanes) {
        for (int k = 0; k < segment.length; ++k) batch.add(segment.entry + k, weight);
        continue;
      }
      kernels_.sum_run(bonds, temperature + segment.entry, segment.length, sums);
      for (int k = 0; k < segment.length; ++k) result[segment.entry + k] += weight * sums[k];
    }
    batch.flush();
  }
}

void BondCorrections::apply_bundles(std::size_t block, const double* temperature, double rate_weight,
                                    double* result) const {
  double sums[CorrectionBundles::most_points];
  for (std::size_t n = parts_.bundle_begin[block]; n < parts_.bundle_begin[block + 1]; ++n) {
    const CorrectionBundles::Bundle& bundle = parts_.bundles.bundles()[n];
    const double weight = rate_weight * parts_.scales[bundle.material];
    kernels_.sum_bundle(parts_.bundles.bonds_of(bundle), temperature + bundle.entry, sums);
    const double* const volumes = parts_.bundles.volumes_of(bundle);
    for (int k = 0; k < bundle.length; ++k) result[bundle.entry + k] += weight * sums[k] / volumes[k];
  }
}

void BondCorrections::apply_row(std::size_t row, const double* temperature, double rate_weight, double* result) const {
  const ChangingRow& own = parts_.rows[row];
  const double weight = rate_weight * parts_.scales[own.scale];
  if (weight == 0.0) return;
  const double* const centre = temperature + own.entry;
  double sum = 0.0;
  kernels_.sum_points(list_of_row(row, parts_.differences), &centre, 1, &sum);
  result[own.entry] += weight * sum;
}

BondList BondCorrections::list_of_row(std::size_t row, const std::vector<double>& differences) const {
  const std::int64_t begin = row == 0 ? 0 : parts_.rows[row - 1].end;
  return {static_cast<int>(parts_.rows[row].end - begin), nullptr, nullptr, parts_.distances.data() + begin,
          differences.data() + begin};
}

const BondCorrections::Segment* BondCorrections::find_segment(std::int64_t entry) const {
  const auto later = std::upper_bound(
      by_entry_.begin(), by_entry_.end(), entry,
      [this](std::int64_t wanted, std::uint32_t number) { return wanted < parts_.segments[number].entry; });
  if (later == by_entry_.begin()) return nullptr;
  const Segment& segment = parts_.segments[*(later - 1)];
  return entry < segment.entry + segment.length ? &segment : nullptr;
}

std::array<BondList, 2> BondCorrections::lists_of(std::int64_t entry, const std::vector<double>& differences) const {
  std::array<BondList, 2> lists;
  if (const Segment* const segment = find_segment(entry)) lists[0] = parts_.patterns[segment->pattern];
  const auto row = std::lower_bound(parts_.rows.begin(), parts_.rows.end(), entry,
                                    [](const ChangingRow& r, std::int64_t wanted) { return r.entry < wanted; });
  if (row != parts_.rows.end() && row->entry == entry) {
    lists[1] = list_of_row(static_cast<std::size_t>(row - parts_.rows.begin()), differences);
  }
  return lists;
}

void BondCorrections::for_raised(const std::function<void(std::size_t, double)>& visit) const {
  const std::vector<double> peaks = parts_.cuts.peaks(parts_.differences);
  for (const Segment& segment : parts_.segments) {
    if (parts_.scales[segment.scale] == 0.0) continue;
    const double shared = raised_at(static_cast<std::size_t>(segment.entry), peaks);
    for (int k = 0; k < segment.length; ++k) {
      const auto entry = static_cast<std::size_t>(segment.entry + k);
      visit(entry, parts_.rows.empty() ? shared : raised_at(entry, peaks));
    }
  }
  for (const CorrectionBundles::Bundle& bundle : parts_.bundles.bundles()) {
    for (int k = 0; k < bundle.length; ++k) {
      const auto entry = static_cast<std::size_t>(bundle.entry + k);
      visit(entry, raised_at(entry, peaks));
    }
  }
  for (const ChangingRow& row : parts_.rows) {
    if (parts_.scales[row.scale] != 0.0)
      visit(static_cast<std::size_t>(row.entry), raised_at(static_cast<std::size_t>(row.entry), peaks));
  }
}

double BondCorrections::raised_at(std::size_t entry, const std::vector<double>& peaks) const {
  double raised = 0.0;
  visit_with(peaks, entry, [&](std::int64_t, double difference) { raised += std::max(0.0, difference); });
  return raised;
}

std::vector<std::size_t> BondCorrections::changing_points() const {
  std::vector<std::size_t> points;
  for (const ChangingRow& row : parts_.rows) points.push_back(static_cast<std::size_t>(row.entry));
  return points;
}

std::size_t BondCorrections::bytes() const {
  return parts_.patterns.bytes() + parts_.segments.capacity() * sizeof(Segment) +
         (parts_.begin.capacity() + parts_.bundle_begin.capacity()) * sizeof(std::size_t) + parts_.bundles.bytes() +
         by_entry_.capacity() * sizeof(by_entry_[0]) + parts_.rows.capacity() * sizeof(ChangingRow) +
         parts_.distances.capacity() * sizeof(std::int32_t) + parts_.differences.capacity() * sizeof(double) +
         parts_.cuts.bytes() + parts_.cut_bonds.bytes();
}

}  // namespace peritherm
