#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/physics/material.hpp"

namespace peritherm {

/// One value per point of a grid, x fastest, read where they lie: behind one another, or in a padded field. A view:
/// what it was made from must outlive it.
class PointValues {
 public:
  PointValues(ConstField values) : values_(values), size_(values.size()) {}
  PointValues(const std::vector<double>& values) : PointValues(ConstField(values)) {}
  /// Points that were cut away read as NaN; `materials` may be empty.
  PointValues(const PaddedGrid& layout, ConstField padded, std::span<const MaterialIndex> materials)
      : layout_(&layout), values_(padded), materials_(materials), size_(layout.grid().size()) {}

  std::size_t size() const { return size_; }

  double operator[](std::size_t number) const {
    if (layout_ == nullptr) return values_[number];
    if (!materials_.empty() && materials_[number] == no_material) return std::numeric_limits<double>::quiet_NaN();
    return values_[layout_->entry(layout_->grid().index(number))];
  }

  /// Copies the values of the points first, first + 1, …
  void copy(std::size_t first, Field target) const {
    if (layout_ == nullptr) {
      std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(first), target.size(), target.begin());
      return;
    }
    const auto row_length = static_cast<std::size_t>(layout_->grid().count(0));
    for (std::size_t done = 0; done < target.size();) {
      const std::size_t number = first + done;
      const std::size_t length = std::min(target.size() - done, row_length - number % row_length);
      const auto from = static_cast<std::ptrdiff_t>(layout_->entry(layout_->grid().index(number)));
      std::copy_n(values_.begin() + from, length, target.begin() + static_cast<std::ptrdiff_t>(done));
      done += length;
    }
    for (std::size_t n = 0; n < target.size() && !materials_.empty(); ++n) {
      if (materials_[first + n] == no_material) target[n] = std::numeric_limits<double>::quiet_NaN();
    }
  }

 private:
  const PaddedGrid* layout_ = nullptr;
  ConstField values_;
  std::span<const MaterialIndex> materials_;
  std::size_t size_ = 0;
};

}  // namespace peritherm
