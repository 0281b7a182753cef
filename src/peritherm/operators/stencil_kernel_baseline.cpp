#include "peritherm/operators/stencil_kernel.hpp"

namespace peritherm {

const Kernels* kernels_baseline() {
  static constexpr Kernels kernels{
      "baseline",    source_kernels<double, 2, 6, 2, 16>(), source_kernels<float, 4, 6, 2, 16>(), narrow, combine_row,
      accumulate_row};
  return &kernels;
}

}  // namespace peritherm
