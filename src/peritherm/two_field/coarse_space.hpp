#pragma once

#include <vector>

#include "peritherm/base/sparse_matrix.hpp"
#include "peritherm/two_field/stage_matrix.hpp"

namespace peritherm {

/// Points in cubes of about a horizon; points of two parts are never in one.
struct Bins {
  std::vector<PointIndex> bin_of;  ///< of every point
  std::size_t count = 0;

  /// result[bin] = Σ of the values in it.
  void sum(ConstField values, Field result) const;
};

/// `width`: edge of a cube, in horizons.
Bins make_bins(const TwoFieldSystem& system, double width);

/// Zᵀ A Z, Z = 1 on the points of a bin and 0 elsewhere.
SparseMatrix bin_matrix(const StageMatrix& matrix, const Bins& bins);
/// Φ Z: a row of each contact.
SparseMatrix bin_contacts(const TwoFieldSystem& system, const Bins& bins);
/// matrix + contactsᵀ diag(weights) contacts.
SparseMatrix add_contacts(const SparseMatrix& matrix, const SparseMatrix& contacts, ConstField weights);

}  // namespace peritherm
