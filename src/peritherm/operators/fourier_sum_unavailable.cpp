#include "peritherm/base/error.hpp"
#include "peritherm/operators/fourier_sum.hpp"

namespace peritherm {

bool fourier_sum_available() { return false; }

std::unique_ptr<StencilSum> make_fourier_sum(const PaddedGrid&, const Stencil&, Precision, const FourierTiling&) {
  throw Error("the fft backend needs FFTW, which this build has not",
              "Install libfftw3-dev and configure with -DPERITHERM_FFTW=ON, or choose backend = \"stencil\"");
}

std::unique_ptr<StencilSum> make_fourier_sum(const PaddedGrid& layout, const Stencil& stencil, Precision precision) {
  return make_fourier_sum(layout, stencil, precision, FourierTiling{});
}

}  // namespace peritherm
