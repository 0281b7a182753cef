#include "peritherm/operators/correction_kernel.hpp"

namespace peritherm {

const CorrectionKernels* correction_kernels_avx512() {
  static constexpr CorrectionKernels kernels{8, sum_points, sum_run<8>, sum_bundle<8>};
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") ? &kernels : nullptr;
}

}  // namespace peritherm
