#include "peritherm/operators/kernels.hpp"

namespace peritherm {

const Kernels* kernels_avx2() { return nullptr; }
const Kernels* kernels_avx512() { return nullptr; }

}  // namespace peritherm
