#pragma once

#include <cstdint>
#include <vector>

namespace peritherm {

/// Sparse matrix, row behind row.
struct SparseMatrix {
  std::size_t columns = 0;
  std::vector<std::int64_t> begin{0};   ///< rows + 1, into the two below
  std::vector<std::int32_t> column_of;  ///< ascending in each row
  std::vector<double> values;
  std::size_t rows() const { return begin.size() - 1; }
  bool operator==(const SparseMatrix&) const = default;
};

}  // namespace peritherm
