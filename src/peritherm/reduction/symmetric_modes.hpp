#pragma once

#include <functional>
#include <span>
#include <vector>

#include "peritherm/base/matrix.hpp"
#include "peritherm/reduction/sparse_factor.hpp"

namespace peritherm {

/// Solutions of K φ = rate · C φ, slowest first, with φᵀ C φ = 1.
struct SymmetricModes {
  std::vector<double> rates;  ///< [1/s]
  Matrix shapes;              ///< column by column
};

/// All of them, of dense matrices; only the lower halves are read. `capacities` must be positive definite, or Error
/// (Fault::numerics) is thrown.
SymmetricModes all_modes(const Matrix& conductances, const Matrix& capacities);

/// The slowest ones, by block Lanczos steps with K⁻¹ [golub2013, sec. 10.3.6], each to a residual of
/// 1e-6: rates are then good to 1e-12.
/// `capacities`: the diagonal of C.
SymmetricModes slowest_modes(const SparseFactor& conductances, std::span<const double> capacities, std::size_t count,
                             const std::function<void()>& after_block = {});

}  // namespace peritherm
