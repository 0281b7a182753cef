#include <algorithm>

#include "peritherm/operators/stencil_program.hpp"
#include "peritherm/operators/stencil_sum.hpp"

namespace peritherm {
namespace {

constexpr int block_rows = StencilProgram::block_rows;
constexpr int band_rows = 4 * block_rows;  // rows that are worked on together, so that their sources stay in cache
constexpr int tile_columns = 96;

/// One thread's room for sums and folded planes; it is kept between evaluations.
class Workspace {
 public:
  void fit(const StencilProgram& program) {
    plane_stride_ = tile_columns + lanes_margin + 2 * program.radius;
    plane_rows_ = band_rows + block_rows + 2 * program.radius;
    sums_.resize(static_cast<std::size_t>(block_rows * stride()));
    planes_.resize(static_cast<std::size_t>(program.planes));
    if (program.planes > 1) {
      folded_.resize(static_cast<std::size_t>(program.planes * plane_stride_ * plane_rows_) + lanes_margin);
    }
  }

  static constexpr int stride() { return tile_columns + lanes_margin; }
  double* sums() { return sums_.data(); }
  std::vector<FoldedPlane>& planes() { return planes_; }

  /// Folds the planes around the tile whose first output stands at `source`.
  void fold(const StencilProgram& program, const PaddedGrid& layout, const double* source, int rows, int columns,
            FoldKernel fold_row) {
    const auto row_stride = static_cast<std::ptrdiff_t>(layout.stride(1));
    const auto plane_stride = static_cast<std::ptrdiff_t>(layout.stride(2));
    const int width = columns + lanes_margin + 2 * program.radius;
    for (int d = 0; d < program.planes; ++d) {
      const int reach = program.plane_radius[d];
      double* const origin = folded_.data() + static_cast<std::ptrdiff_t>(d) * plane_stride_ * plane_rows_ +
                             static_cast<std::ptrdiff_t>(program.radius) * plane_stride_ + program.radius;
      planes_[d] = {origin, plane_stride_};
      for (int row = -reach; row < rows + reach; ++row) {
        const double* const from = source + row * row_stride - program.radius;
        double* const to = origin + row * plane_stride_ - program.radius;
        if (d == 0) {
          std::copy_n(from, width, to);
        } else {
          fold_row(from + d * plane_stride, from - d * plane_stride, width, to);
        }
      }
    }
  }

 private:
  std::vector<double> sums_;
  std::ptrdiff_t plane_stride_ = 0, plane_rows_ = 0;
  std::vector<double> folded_;
  std::vector<FoldedPlane> planes_;
};

class DirectSum final : public StencilSum {
 public:
  DirectSum(const PaddedGrid& layout, const Stencil& stencil, const Kernels& kernels)
      : layout_(layout), program_(make_stencil_program(stencil, layout.grid().dimension)), kernels_(kernels) {}

  void sum(ConstField temperature, const RowSink& sink) const override {
    const Grid& grid = layout_.grid();
    const int bands = (grid.count(1) + band_rows - 1) / band_rows;
    const int strips = grid.dimension == 1 ? strips_of_a_bar() : 1;
    const std::int64_t count = static_cast<std::int64_t>(grid.count(2)) * bands * strips;
#pragma omp parallel
    {
      thread_local Workspace workspace;
      workspace.fit(program_);
#pragma omp for schedule(static)
      for (std::int64_t task = 0; task < count; ++task) {
        const int strip = static_cast<int>(task % strips);
        const int band = static_cast<int>(task / strips % bands);
        const int z = static_cast<int>(task / (strips * bands));
        sum_band(temperature, sink, z, band * band_rows, columns_of(strip, strips), workspace);
      }
    }
  }

  std::size_t bytes() const override { return program_.pairs.size() * sizeof(program_.pairs[0]); }

 private:
  struct Columns {
    int begin, end;
  };

  /// A bar has one row only; it is cut so that several threads find work.
  int strips_of_a_bar() const { return std::max(1, layout_.grid().count(0) / 4096); }
  Columns columns_of(int strip, int strips) const {
    const int length = layout_.grid().count(0);
    const int width = (length + strips - 1) / strips;
    return {strip * width, std::min(length, (strip + 1) * width)};
  }

  /// Rows y … y + band_rows of plane z; tile by tile, so that the sources of a tile stay in the nearest cache.
  void sum_band(ConstField temperature, const RowSink& sink, int z, int y, Columns columns,
                Workspace& workspace) const {
    const int rows = std::min(band_rows, layout_.grid().count(1) - y);
    for (int x = columns.begin; x < columns.end; x += tile_columns) {
      const int width = std::min(tile_columns, columns.end - x);
      const double* const source = temperature.data() + layout_.entry({x, y, z});
      if (program_.planes > 1) {
        const int block_end = (rows + block_rows - 1) / block_rows * block_rows;
        workspace.fold(program_, layout_, source, block_end, width, kernels_.fold_row);
      } else {
        workspace.planes()[0] = {source, static_cast<std::ptrdiff_t>(layout_.stride(1))};
      }
      for (int row = 0; row < rows; row += block_rows) {
        kernels_.sum_block(program_, workspace.planes().data(), width, workspace.sums(), Workspace::stride());
        for (int r = row; r < std::min(rows, row + block_rows); ++r) {
          sink(workspace.sums() + (r - row) * Workspace::stride(), {x, y + r, z}, width);
        }
        for (FoldedPlane& plane : workspace.planes()) plane.origin += block_rows * plane.stride;
      }
    }
  }

  PaddedGrid layout_;
  StencilProgram program_;
  Kernels kernels_;
};

}  // namespace

std::unique_ptr<StencilSum> make_direct_sum(const PaddedGrid& layout, const Stencil& stencil, std::size_t kernel,
                                            Precision) {
  return std::make_unique<DirectSum>(layout, stencil, available_kernels().at(kernel));
}

}  // namespace peritherm
