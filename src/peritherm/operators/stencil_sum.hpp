#pragma once

#include <functional>
#include <memory>

#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/discretisation/stencil.hpp"
#include "peritherm/operators/precision.hpp"

namespace peritherm {

/// Σ_k G_k (T_{i+k} − T_i) over the offsets k of one stencil, for every point i of a grid.
class StencilSum {
 public:
  /// Takes a piece of a row: sums[0 … width) belong to the points first, first + 1, … along x.
  using RowSink = std::function<void(const double* sums, const GridIndex& first, int width)>;

  virtual ~StencilSum() = default;

  /// Calls `sink` with pieces that cover each point once, from several threads; the same bits for any number of them.
  /// Fictitious entries of `temperature` must be filled.
  virtual void sum(ConstField temperature, const RowSink& sink) const = 0;

  /// Memory held between evaluations [B].
  virtual std::size_t bytes() const = 0;
};

/// Adds offset by offset. `kernel`: index into available_kernels().
std::unique_ptr<StencilSum> make_direct_sum(const PaddedGrid& layout, const Stencil& stencil, std::size_t kernel,
                                            Precision precision = Precision::full);

}  // namespace peritherm
