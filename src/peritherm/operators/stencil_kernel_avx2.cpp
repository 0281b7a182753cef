#include "peritherm/operators/stencil_kernel.hpp"

namespace peritherm {

const Kernels* kernels_avx2() {
  static constexpr Kernels kernels{
      "avx2",        source_kernels<double, 4, 6, 2, 16>(), source_kernels<float, 8, 6, 2, 16>(), narrow, combine_row,
      accumulate_row};
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &kernels : nullptr;
}

}  // namespace peritherm
