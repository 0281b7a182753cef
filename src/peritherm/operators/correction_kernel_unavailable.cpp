#include "peritherm/operators/correction_kernels.hpp"

namespace peritherm {

const CorrectionKernels* correction_kernels_avx2() { return nullptr; }
const CorrectionKernels* correction_kernels_avx512() { return nullptr; }

}  // namespace peritherm
