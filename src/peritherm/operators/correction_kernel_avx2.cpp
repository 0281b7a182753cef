#include "peritherm/operators/correction_kernel.hpp"

namespace peritherm {

const CorrectionKernels* correction_kernels_avx2() {
  static constexpr CorrectionKernels kernels{4, sum_points, sum_run<4>, sum_bundle<4>};
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &kernels : nullptr;
}

}  // namespace peritherm
