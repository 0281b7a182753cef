#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "peritherm/base/error.hpp"
#include "peritherm/operators/fourier_sum.hpp"
#include "peritherm/operators/fourier_symbol.hpp"
#include "support/transform_error.hpp"

namespace peritherm {
namespace {

Grid grid_of(int dimension, const GridIndex& cells) {
  Grid grid;
  grid.dimension = dimension;
  grid.spacing = 0.5;
  for (int axis = 0; axis < dimension; ++axis) grid.cells[axis] = cells[axis];
  return grid;
}

Stencil stencil_of(const Grid& grid, double ratio) {
  StencilOptions options;
  options.kernel.form = LinearKernel{};
  options.horizon = ratio * grid.spacing;
  return make_stencil(options, grid.spacing, grid.dimension);
}

std::vector<double> evaluate(const StencilSum& sum, const PaddedGrid& layout, const std::vector<double>& temperature) {
  std::vector<double> sums(layout.grid().size(), std::nan(""));
  sum.sum(temperature, [&](const double* values, const GridIndex& first, int width) {
    std::copy_n(values, width, sums.begin() + static_cast<std::ptrdiff_t>(layout.grid().number(first)));
  });
  return sums;
}

std::vector<double> random_temperature(const PaddedGrid& layout, double base) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> temperature(layout.size());
  for (double& value : temperature) value = base + uniform(engine);
  return temperature;
}

struct TileCase {
  int dimension;
  GridIndex cells;
  double ratio;
  GridIndex tiles;  ///< tiles along each axis; their extents follow
};

FourierTiling tiling_of(const TileCase& which, int radius) {
  FourierTiling tiling;
  for (int axis = 0; axis < which.dimension; ++axis) {
    tiling.count[axis] = which.tiles[axis];
    tiling.kept[axis] = (which.cells[axis] + which.tiles[axis] - 1) / which.tiles[axis];
    for (const int length : {16, 20, 32, 64, 80, 96, 128}) {
      tiling.extent[axis] = length;
      if (length >= tiling.kept[axis] + 2 * radius) break;
    }
  }
  return tiling;
}

/// Odd numbers of tiles, last tiles that are cut off, one tile alone, many small ones.
const TileCase tile_cases[] = {{1, {37, 1, 1}, 3.0, {1, 1, 1}},   {1, {100, 1, 1}, 2.0, {7, 1, 1}},
                               {2, {30, 21, 1}, 3.5, {1, 1, 1}},  {2, {41, 37, 1}, 4.0, {3, 3, 1}},
                               {2, {64, 50, 1}, 2.0, {6, 5, 1}},  {3, {13, 9, 11}, 2.0, {1, 1, 1}},
                               {3, {20, 17, 19}, 2.5, {2, 1, 3}}, {3, {22, 25, 18}, 1.5, {2, 3, 2}}};

class FourierSum : public testing::Test {
 protected:
  void SetUp() override {
    if (!fourier_sum_available()) GTEST_SKIP() << "this build has no FFTW";
  }
};

TEST(FourierTiling, tiles_cover_the_grid_and_reach_beyond_it_by_the_radius) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (const int length : {1, 5, 31, 64, 100, 301}) {
      for (const int radius : {1, 3, 8, 40}) {
        for (const Precision precision : {Precision::full, Precision::single}) {
          const Grid grid = grid_of(dimension, {length, 2 * length, length + 1});
          const FourierTiling tiling = choose_fourier_tiling(grid, radius, precision);
          for (int axis = 0; axis < dimension; ++axis) {
            EXPECT_GE(tiling.count[axis] * tiling.kept[axis], grid.count(axis));
            EXPECT_LT((tiling.count[axis] - 1) * tiling.kept[axis], grid.count(axis));
            EXPECT_GE(tiling.extent[axis], tiling.kept[axis] + 2 * radius);
            int rest = tiling.extent[axis];
            for (const int factor : {2, 3, 5, 7}) {
              while (rest % factor == 0) rest /= factor;
            }
            EXPECT_EQ(rest, 1) << tiling.extent[axis];
          }
          for (int axis = dimension; axis < 3; ++axis) EXPECT_EQ(tiling.extent[axis], 1);
        }
      }
    }
  }
}

TEST(FourierSymbol, is_the_sum_of_cosines_and_vanishes_for_constants) {
  const Stencil stencil = stencil_of(grid_of(3, {8, 8, 8}), 2.5);
  const GridIndex extent{12, 10, 9};
  const std::vector<double> symbol = fourier_symbol(stencil, extent, 16);
  double total = 0.0;
  for (const StencilEntry& entry : stencil.entries) total += entry.conductance;
  for (int z = 0; z <= extent[2] / 2; ++z) {
    for (int y = 0; y <= extent[1] / 2; ++y) {
      for (int x = 0; x < extent[0]; ++x) {
        double expected = 0.0;
        for (const StencilEntry& entry : stencil.entries) {
          double phase = 0.0;
          const GridIndex wave{x, y, z};
          for (int axis = 0; axis < 3; ++axis) {
            phase += 2.0 * std::numbers::pi * wave[axis] * entry.offset[axis] / extent[axis];
          }
          expected += entry.conductance * (std::cos(phase) - 1.0);
        }
        const double found = symbol[static_cast<std::size_t>(x + 16 * (y + (extent[1] / 2 + 1) * z))];
        EXPECT_NEAR(found, expected, rounding(stencil.entries.size(), total));
      }
    }
  }
  EXPECT_EQ(symbol[0], 0.0);
}

TEST_F(FourierSum, agrees_with_the_direct_sum_for_every_way_to_cut_the_grid) {
  for (const TileCase& which : tile_cases) {
    const Grid grid = grid_of(which.dimension, which.cells);
    const Stencil stencil = stencil_of(grid, which.ratio);
    const PaddedGrid layout(grid, stencil.radius);
    const FourierTiling tiling = tiling_of(which, stencil.radius);
    // A warm body: what counts are the differences, at most 2.
    const std::vector<double> temperature = random_temperature(layout, 1000.0);
    const std::vector<double> expected = evaluate(*make_direct_sum(layout, stencil, 0), layout, temperature);
    double total = 0.0;
    for (const StencilEntry& entry : stencil.entries) total += entry.conductance;
    for (const Precision precision : {Precision::full, Precision::single}) {
      const std::vector<double> found =
          evaluate(*make_fourier_sum(layout, stencil, precision, tiling), layout, temperature);
      double squares = 0.0;
      for (std::size_t n = 0; n < found.size(); ++n) squares += std::pow((found[n] - expected[n]) / (2.0 * total), 2);
      const double direct =
          rounding(2 * stencil.entries.size() + 8, 1001.0) * std::sqrt(static_cast<double>(grid.size()));
      EXPECT_LE(std::sqrt(squares), transform_error(tiling, layout, precision, 2.0) + direct)
          << which.dimension << "-D, " << grid.cells[0] << " points along x, " << name_of(precision);
    }
  }
}

TEST_F(FourierSum, loses_the_digits_that_transforms_lose_on_average) {
  const Grid grid = grid_of(2, {90, 70, 1});
  const Stencil stencil = stencil_of(grid, 5.0);
  const PaddedGrid layout(grid, stencil.radius);
  const std::vector<double> temperature = random_temperature(layout, 0.0);
  const std::vector<double> expected = evaluate(*make_direct_sum(layout, stencil, 0), layout, temperature);
  const FourierTiling tiling = choose_fourier_tiling(grid, stencil.radius, Precision::single);
  const std::vector<double> found =
      evaluate(*make_fourier_sum(layout, stencil, Precision::single), layout, temperature);
  double errors = 0.0, sums = 0.0;
  for (std::size_t n = 0; n < found.size(); ++n) {
    errors += std::pow(found[n] - expected[n], 2);
    sums += expected[n] * expected[n];
  }
  // Root mean square errors of a transform are about 0.6 u sqrt(log2 N) [frigo2005]; there are two, rounding of the
  // input and of the symbol, and the sums are about as large as the terms.
  const double doublings = std::log2(static_cast<double>(tiling.extent[0]) * tiling.extent[1]);
  EXPECT_LE(std::sqrt(errors / sums), 2.0 * unit_roundoff(Precision::single) * std::sqrt(doublings));
  EXPECT_GT(errors, 0.0);
}

TEST_F(FourierSum, a_constant_temperature_gives_exactly_nothing) {
  for (const TileCase& which : tile_cases) {
    const Grid grid = grid_of(which.dimension, which.cells);
    const Stencil stencil = stencil_of(grid, which.ratio);
    const PaddedGrid layout(grid, stencil.radius);
    const std::vector<double> temperature(layout.size(), 293.15);
    for (const Precision precision : {Precision::full, Precision::single}) {
      for (const double sum : evaluate(*make_fourier_sum(layout, stencil, precision), layout, temperature)) {
        ASSERT_EQ(sum, 0.0);
      }
    }
  }
}

TEST_F(FourierSum, gives_the_same_bits_for_any_number_of_threads_and_from_plan_to_plan) {
  const int threads_before = omp_get_max_threads();
  for (const TileCase& which : tile_cases) {
    const Grid grid = grid_of(which.dimension, which.cells);
    const Stencil stencil = stencil_of(grid, which.ratio);
    const PaddedGrid layout(grid, stencil.radius);
    const std::vector<double> temperature = random_temperature(layout, 20.0);
    for (const Precision precision : {Precision::full, Precision::single}) {
      std::vector<double> first;
      for (const int threads : {1, 2, 3, 5}) {
        omp_set_num_threads(threads);
        const auto sum = make_fourier_sum(layout, stencil, precision, tiling_of(which, stencil.radius));
        const std::vector<double> found = evaluate(*sum, layout, temperature);
        if (threads == 1) first = found;
        EXPECT_EQ(found, first) << threads << " threads, " << which.dimension << "-D";
        EXPECT_EQ(evaluate(*sum, layout, temperature), first);
      }
    }
  }
  omp_set_num_threads(threads_before);
}

TEST(FourierSumWithoutFftw, says_how_to_get_it) {
  if (fourier_sum_available()) GTEST_SKIP() << "this build has FFTW";
  const Grid grid = grid_of(2, {10, 10, 1});
  const Stencil stencil = stencil_of(grid, 2.0);
  try {
    make_fourier_sum(PaddedGrid(grid, stencil.radius), stencil, Precision::full);
    FAIL() << "made";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("PERITHERM_FFTW"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace peritherm
