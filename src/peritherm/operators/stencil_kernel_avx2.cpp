#include "peritherm/operators/kernels.hpp"
#include "peritherm/operators/stencil_kernel.hpp"

namespace peritherm {

const Kernels* kernels_avx2() {
  static constexpr Kernels kernels{"avx2", sum_block<4>, combine_row, fold_row, accumulate_row};
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &kernels : nullptr;
}

}  // namespace peritherm
