#include "peritherm/operators/stencil_kernel.hpp"

namespace peritherm {

const Kernels* kernels_avx512() {
  static constexpr Kernels kernels{"avx512",
                                   source_kernels<double, 8, 10, 2, 32>(),
                                   source_kernels<float, 16, 10, 2, 32>(),
                                   narrow<8>,
                                   combine_row,
                                   accumulate_row,
                                   add_pattern<8>};
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")
             ? &kernels
             : nullptr;
}

}  // namespace peritherm
