#include "peritherm/operators/fourier_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace peritherm {
namespace {

/// A length that FFTW transforms well, and the time per number for one way, in double and in single precision [ns].
/// Measured on one core with 512-bit vectors and plans by estimate. Lengths that one straight-line codelet covers are
/// far ahead; from 128 on time grows slowly, and unevenly for what lies between.
struct GoodLength {
  int length;
  double full, single;
};
constexpr GoodLength good_lengths[] = {{16, 1.48, 0.94}, {20, 1.60, 1.00}, {32, 1.28, 0.88},  {64, 1.12, 0.72},
                                       {80, 5.0, 3.5},   {96, 2.02, 1.66}, {112, 2.04, 2.26}, {128, 2.14, 1.36},
                                       {160, 3.1, 2.36}, {200, 3.4, 2.6},  {240, 3.8, 2.6},   {256, 4.2, 2.5},
                                       {320, 4.7, 2.75}, {400, 5.3, 3.1},  {512, 5.5, 3.3}};
/// Beyond the list: powers of two and five times those, with the time per doubling of the length.
constexpr double full_per_doubling = 0.65, single_per_doubling = 0.38;
/// What loading and multiplying take per number and axis, and what handing out takes per point [ns].
constexpr double copying = 1.0, per_point = 2.0;
/// In 3-D: what columns that stand far apart add per number, for each entry of a length beyond 32 [ns].
constexpr double far_apart[] = {0.03, 0.07, 0.11};
/// Larger pairs of tiles are taken only where the horizon leaves no choice.
constexpr double most_bytes = 64e6;

/// Lengths up to the first that is no less than `most`.
std::vector<int> lengths_up_to(int most) {
  std::vector<int> lengths;
  for (const GoodLength& good : good_lengths) lengths.push_back(good.length);
  for (int power = 512; lengths.back() < most; power *= 2) {
    lengths.push_back(power / 4 * 5);
    lengths.push_back(power * 2);
  }
  return lengths;
}

double transform_ns(int length, Precision precision) {
  const bool single = precision == Precision::single;
  for (const GoodLength& good : good_lengths) {
    if (good.length == length) return single ? good.single : good.full;
  }
  return (single ? single_per_doubling : full_per_doubling) * std::log2(length);
}

double value_bytes(Precision precision) { return precision == Precision::single ? 4.0 : 8.0; }

double entries_of(const FourierTiling& tiling) {
  return static_cast<double>(tiling.extent[0]) * tiling.extent[1] * tiling.extent[2];
}

/// One way to cut an axis.
struct AxisTiles {
  int count, kept, extent;
};

/// The fewest tiles of each length; tiles that give less than they read beyond their ends are never the best.
std::vector<AxisTiles> axis_tiles(const Grid& grid, int axis, int radius) {
  if (axis >= grid.dimension) return {{1, 1, 1}};
  const int length = grid.count(axis);
  std::vector<AxisTiles> ways;
  for (const int extent : lengths_up_to(length + 2 * radius)) {
    const int room = extent - 2 * radius;
    if (room < std::min(length, radius)) continue;
    const int count = (length + room - 1) / room;
    ways.push_back({count, (length + count - 1) / count, extent});
    if (count == 1) break;
  }
  return ways;
}

std::ptrdiff_t rounded_up(std::ptrdiff_t length, std::ptrdiff_t unit) { return (length + unit - 1) / unit * unit; }

std::ptrdiff_t odd_multiple(std::ptrdiff_t length, std::ptrdiff_t unit) {
  const std::ptrdiff_t whole = rounded_up(length, unit);
  return whole % (2 * unit) == 0 ? whole + unit : whole;
}

}  // namespace

double fourier_seconds(const FourierTiling& tiling, Precision precision) {
  double ns = 0.0, points = 2.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int length = tiling.extent[axis];
    if (length > 1) ns += 2.0 * transform_ns(length, precision) + copying;
    if (tiling.extent[2] > 1) ns += far_apart[axis] * std::clamp(length - 32, 0, 96);
    points *= tiling.kept[axis];
  }
  return tiling.pairs() * (entries_of(tiling) * ns + points * per_point) * 1e-9;
}

FourierTiling choose_fourier_tiling(const Grid& grid, int radius, Precision precision) {
  std::array<std::vector<AxisTiles>, 3> axes;
  for (int axis = 0; axis < 3; ++axis) axes[axis] = axis_tiles(grid, axis, radius);
  FourierTiling best;
  double least = std::numeric_limits<double>::infinity();
  bool best_fits = false;
  for (const AxisTiles& x : axes[0]) {
    for (const AxisTiles& y : axes[1]) {
      for (const AxisTiles& z : axes[2]) {
        const FourierTiling tiling{
            {x.count, y.count, z.count}, {x.kept, y.kept, z.kept}, {x.extent, y.extent, z.extent}};
        const bool fits = 2.0 * entries_of(tiling) * value_bytes(precision) <= most_bytes;
        const double seconds = fourier_seconds(tiling, precision);
        if (best_fits > fits || (best_fits == fits && seconds >= least)) continue;
        best = tiling;
        best_fits = fits;
        least = seconds;
      }
    }
  }
  return best;
}

FourierLayout::FourierLayout(const FourierTiling& tiling, int dimension)
    : x_row(odd_multiple(tiling.extent[0], lanes)),
      y_row(odd_multiple(tiling.extent[1], lanes)),
      plane(x_row * tiling.extent[1]),
      turned(static_cast<std::size_t>(y_row * rounded_up(tiling.extent[0], lanes))),
      pair(turned),
      symbol(static_cast<std::size_t>(x_row) * static_cast<std::size_t>(tiling.extent[1] / 2 + 1) *
             static_cast<std::size_t>(tiling.extent[2] / 2 + 1)) {
  if (plane % (2 * lanes) == 0) plane += lanes;
  if (dimension == 1) pair = static_cast<std::size_t>(x_row);
  if (dimension == 3) pair = static_cast<std::size_t>(plane) * static_cast<std::size_t>(tiling.extent[2]);
}

std::size_t fourier_bytes(const FourierTiling& tiling, int dimension, Precision precision) {
  const FourierLayout layout(tiling, dimension);
  return (2 * layout.pair + layout.symbol) * (precision == Precision::single ? 4 : 8);
}

}  // namespace peritherm
