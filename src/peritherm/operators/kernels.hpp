#pragma once

#include "peritherm/operators/stencil_program.hpp"

namespace peritherm {

/// The kernels of each instruction set; none if this build or this processor lacks it.
const Kernels* kernels_baseline();
const Kernels* kernels_avx2();
const Kernels* kernels_avx512();

}  // namespace peritherm
