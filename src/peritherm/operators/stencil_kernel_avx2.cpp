#include "peritherm/operators/stencil_kernel.hpp"

namespace peritherm {

const Kernels* kernels_avx2() {
  static constexpr Kernels kernels{"avx2",
                                   source_kernels<double, 4, 6, 2, 16>(),
                                   source_kernels<float, 8, 6, 2, 16>(),
                                   narrow<4>,
                                   combine_row,
                                   accumulate_row,
                                   add_pattern<4>};
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &kernels : nullptr;
}

}  // namespace peritherm
