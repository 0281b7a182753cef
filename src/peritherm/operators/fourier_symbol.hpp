#pragma once

#include <vector>

#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {

/// Σ G (cos(k·ξ) − 1) over a stencil at the wave vectors of a periodic box: real, because a stencil is even, and even
/// along every axis. Value (kx, ky, kz), with kx from 0 to extent[0] − 1 and the others from 0 to extent / 2, stands at
/// kx + row · (ky + (extent[1] / 2 + 1) · kz); the rest of a row is 0.
std::vector<double> fourier_symbol(const Stencil& stencil, const GridIndex& extent, std::size_t row);

}  // namespace peritherm
