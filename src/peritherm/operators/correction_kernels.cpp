#include "peritherm/operators/correction_kernels.hpp"

namespace peritherm {

const CorrectionKernels& correction_kernels(std::string_view name) {
  const CorrectionKernels* found = nullptr;
  if (name == "avx512") found = correction_kernels_avx512();
  if (name == "avx2") found = correction_kernels_avx2();
  return found != nullptr ? *found : *correction_kernels_baseline();
}

}  // namespace peritherm
