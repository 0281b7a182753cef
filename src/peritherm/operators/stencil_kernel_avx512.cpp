#include "peritherm/operators/kernels.hpp"
#include "peritherm/operators/stencil_kernel.hpp"

namespace peritherm {

const Kernels* kernels_avx512() {
  static constexpr Kernels kernels{"avx512", sum_block<8>, combine_row, fold_row, accumulate_row};
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") ? &kernels : nullptr;
}

}  // namespace peritherm
