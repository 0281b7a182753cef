#include "peritherm/operators/stencil_kernel.hpp"

namespace peritherm {

const Kernels* kernels_baseline() {
  static constexpr Kernels kernels{"baseline",
                                   source_kernels<double, 2, 6, 2, 16>(),
                                   source_kernels<float, 4, 6, 2, 16>(),
                                   narrow<2>,
                                   combine_row,
                                   accumulate_row,
                                   add_pattern<2>};
  return &kernels;
}

}  // namespace peritherm
