#pragma once

#include <memory>

#include "peritherm/operators/fourier_tiles.hpp"
#include "peritherm/operators/stencil_sum.hpp"

namespace peritherm {

/// Whether this build has FFTW.
bool fourier_sum_available();

/// The sum over a stencil as a convolution, by fast Fourier transforms of tiles that are padded by the fictitious
/// points. Temperatures enter as differences from one of their tile, so that a warm body loses no digits. An error is
/// about the unit roundoff × log2 (points of a tile) × the root mean square of these differences × Σ G.
/// Plans are chosen by estimate, never by trial, and threads share whole transforms: the same bits from run to run and
/// for any number of threads. One evaluation at a time. Throws Error if this build has no FFTW.
std::unique_ptr<StencilSum> make_fourier_sum(const PaddedGrid& layout, const Stencil& stencil, Precision precision,
                                             const FourierTiling& tiling);
std::unique_ptr<StencilSum> make_fourier_sum(const PaddedGrid& layout, const Stencil& stencil, Precision precision);

}  // namespace peritherm
