#include <algorithm>
#include <type_traits>

#include "peritherm/operators/kernels.hpp"
#include "peritherm/operators/stencil_sum.hpp"
#include "peritherm/operators/tile_sources.hpp"

namespace peritherm {
namespace {

constexpr int bar_strip = 4096;    // points of a bar that one task works on
constexpr int widest_tile = 2048;  // columns of a plate whose surrounding rows stay in the second cache
constexpr int solid_depth = 16;  // planes that one task walks through; what it walks through stays in the second cache
constexpr int solid_tile = 256;  // and so many columns
constexpr int sums_columns = 128;  // columns of a plate whose sums are handed out together
constexpr int solid_sums_columns = 64;

/// One thread's room; it is kept between evaluations.
template <class Scalar>
struct Workspace {
  TileSources<Scalar> sources;
  FoldedPlanes<Scalar> folded;
  AlignedRoom<double> sums;
};

template <class Scalar>
const SourceKernels<Scalar>& source_kernels_of(const Kernels& kernels) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return kernels.full;
  } else {
    return kernels.single;
  }
}

int pieces(int length, int piece) { return (length + piece - 1) / piece; }

template <class Scalar>
class DirectSum final : public StencilSum {
 public:
  DirectSum(const PaddedGrid& layout, const Stencil& stencil, const Kernels& kernels)
      : layout_(layout),
        program_(make_stencil_program(stencil, layout.grid().dimension)),
        kernels_(kernels),
        block_(layout.grid().dimension == 1 ? source_kernels_of<Scalar>(kernels_).bar
                                            : source_kernels_of<Scalar>(kernels_).block) {}

  void sum(ConstField temperature, const RowSink& sink) const override {
    const Grid& grid = layout_.grid();
    const Sweep sweep{program_, layout_, kernels_, temperature.data()};
    const bool solid = grid.dimension == 3;
    const int tile = solid ? solid_tile : grid.dimension == 2 ? widest_tile : bar_strip;
    const int depth = solid ? solid_depth : 1;
    const int bands = pieces(grid.count(1), band_rows());
    const int tasks = bands * pieces(grid.count(2), depth);
    const int tiles = pieces(grid.count(0), tile);
#pragma omp parallel
    {
      thread_local Workspace<Scalar> workspace;
      // Every tile is shared out alike, so that a thread stays with its rows and planes.
      for (int x = 0; x < (grid.dimension == 1 ? 1 : tiles); ++x) {
#pragma omp for schedule(static) nowait
        for (int task = 0; task < (grid.dimension == 1 ? tiles : tasks); ++task) {
          const int column = (grid.dimension == 1 ? task : x) * tile;
          const int y = grid.dimension == 1 ? 0 : task % bands * band_rows();
          const int z = grid.dimension == 1 ? 0 : task / bands * depth;
          const Tile piece{{column, y, z},
                           std::min(tile, grid.count(0) - column),
                           std::min(band_rows(), grid.count(1) - y),
                           std::min(depth, grid.count(2) - z)};
          solid ? sum_solid(sweep, sink, piece, workspace) : sum_flat(sweep, sink, piece, workspace);
        }
      }
    }
  }

  std::size_t bytes() const override { return program_.bytes(); }

 private:
  /// Rows that are worked on together. Narrowing pays if several blocks share it.
  int band_rows() const {
    const bool narrows = std::is_same_v<Scalar, float> && layout_.grid().dimension == 2;
    return narrows ? 4 * block_.rows : block_.rows;
  }

  /// The last block of an axis ends with the grid, so that it finds as many rows as it needs if there are enough.
  int first_row_of_block(int y) const { return std::max(0, std::min(y, layout_.grid().count(1) - block_.rows)); }

  /// Hands out the rows [y, end) of a block of sums that begins with row `first`.
  void hand_out(const RowSink& sink, const double* sums, std::ptrdiff_t stride, int first, int y, int end, int x, int z,
                int width) const {
    for (int row = y; row < end; ++row) sink(sums + (row - first) * stride, {x, row, z}, width);
  }

  void sum_flat(const Sweep& sweep, const RowSink& sink, const Tile& tile, Workspace<Scalar>& workspace) const {
    const int stride = sums_columns + block_.columns;
    double* const sums = workspace.sums.at_least(static_cast<std::size_t>(block_.rows * stride));
    const int end = tile.first[1] + tile.rows;
    const int first = first_row_of_block(tile.first[1]);
    for (int x = tile.first[0]; x < tile.first[0] + tile.width; x += sums_columns) {
      const int width = std::min(sums_columns, tile.first[0] + tile.width - x);
      workspace.sources.enter(sweep, {{x, first, tile.first[2]},
                                      pieces(width, block_.columns) * block_.columns,
                                      std::max(end - first, block_.rows),
                                      1});
      const Patch<const Scalar> source = workspace.sources.plane(0);
      for (int y = tile.first[1]; y < end; y += block_.rows) {
        const int block = first_row_of_block(y);
        const SourcePlane<Scalar> plane{source.first + (block - first) * source.stride, source.stride,
                                        block_.columns + 8};
        block_.sum(program_, &plane, width, sums, stride);
        hand_out(sink, sums, stride, block, y, std::min(end, y + block_.rows), x, tile.first[2], width);
      }
    }
  }

  /// Block by block along x; each walks through the planes, so that it finds all but the newest in the nearest cache.
  void sum_solid(const Sweep& sweep, const RowSink& sink, const Tile& tile, Workspace<Scalar>& workspace) const {
    const std::ptrdiff_t stride = solid_sums_columns, plane_stride = stride * block_.rows;
    double* const sums = workspace.sums.at_least(static_cast<std::size_t>(plane_stride * tile.depth));
    const int first = first_row_of_block(tile.first[1]);
    for (int x = tile.first[0]; x < tile.first[0] + tile.width; x += solid_sums_columns) {
      const int width = std::min(solid_sums_columns, tile.first[0] + tile.width - x);
      for (int column = 0; column < width; column += block_.columns) {
        workspace.sources.enter(sweep, {{x + column, first, tile.first[2]}, block_.columns, block_.rows, tile.depth});
        for (int z = 0; z < tile.depth; ++z) {
          if (z > 0) workspace.sources.advance(sweep);
          const SourcePlane<Scalar>* const planes = workspace.folded.fold(
              sweep, source_kernels_of<Scalar>(kernels_), workspace.sources, 0, block_.columns, block_.rows);
          block_.sum(program_, planes, block_.columns, sums + z * plane_stride + column, stride);
        }
      }
      for (int z = 0; z < tile.depth; ++z) {
        hand_out(sink, sums + z * plane_stride, stride, first, tile.first[1], tile.first[1] + tile.rows, x,
                 tile.first[2] + z, width);
      }
    }
  }

  PaddedGrid layout_;
  StencilProgram program_;
  Kernels kernels_;
  BlockKernel<Scalar> block_;
};

}  // namespace

std::unique_ptr<StencilSum> make_direct_sum(const PaddedGrid& layout, const Stencil& stencil, std::size_t kernel,
                                            Precision precision) {
  const Kernels& kernels = available_kernels().at(kernel);
  if (precision == Precision::single) return std::make_unique<DirectSum<float>>(layout, stencil, kernels);
  return std::make_unique<DirectSum<double>>(layout, stencil, kernels);
}

}  // namespace peritherm
