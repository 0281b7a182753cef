#pragma once

#include <cstdint>
#include <string_view>

namespace peritherm {

/// What one bond adds to the stencil's sum.
struct BondDifference {
  double difference;      ///< of the conductance [W/K], of whole cells
  std::int64_t distance;  ///< entry of the neighbour minus the point's own
};

/// Corrected bonds of a point: numbers in a dictionary, or, where there are no codes, their distances and differences.
struct BondList {
  int count = 0;
  const std::uint16_t* codes = nullptr;
  const BondDifference* dictionary = nullptr;
  const std::int32_t* distances = nullptr;
  const double* differences = nullptr;

  BondDifference operator[](int k) const {
    return codes != nullptr ? dictionary[codes[k]] : BondDifference{differences[k], distances[k]};
  }
};

/// Corrected bonds of `most_points` neighbouring points along x: code by code, the numbers of steps for each of them.
struct BondBundle {
  int count = 0;
  const std::uint16_t* codes = nullptr;
  const BondDifference* steps = nullptr;  ///< distances, and what one step differs, by code
  const std::int32_t* counts = nullptr;
  const double* rests = nullptr;  ///< per point, to be added to each count
};

/// The loops over corrected bonds, compiled for several instruction sets.
struct CorrectionKernels {
  /// sums[n] = Σ difference · (own[n][distance] − own[n][0]) over bonds that all the points share.
  using SumPoints = void (*)(const BondList& bonds, const double* const* own, int points, double* sums);
  /// The same for `length` neighbouring points along x, at least `lanes` of them.
  using SumRun = void (*)(const BondList& bonds, const double* own, int length, double* sums);

  /// The same for all points of a bundle, each with its own differences; what stands behind the field is read, too.
  using SumBundle = void (*)(const BondBundle& bonds, const double* own, double* sums);

  static constexpr int most_points = 8;
  int lanes;
  SumPoints sum_points;
  SumRun sum_run;
  SumBundle sum_bundle;
};

/// None if this build or this processor lacks the instruction set.
const CorrectionKernels* correction_kernels_baseline();
const CorrectionKernels* correction_kernels_avx2();
const CorrectionKernels* correction_kernels_avx512();

/// Those of the same instruction set as the stencil's kernels of this name, as in available_kernels().
const CorrectionKernels& correction_kernels(std::string_view name);

}  // namespace peritherm
