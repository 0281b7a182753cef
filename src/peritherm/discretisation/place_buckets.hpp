#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "peritherm/discretisation/grid.hpp"

namespace peritherm {

/// Finds what stands near a place: everything within the width of a bucket, and some of what is farther.
template <class Value>
class PlaceBuckets {
 public:
  PlaceBuckets(int dimension, double width) : dimension_(dimension), width_(width) {}

  void add(const Point& place, Value value) { values_[key(bucket_of(place))].push_back(value); }

  template <class Visit>
  void for_each_near(const Point& place, const Visit& visit) const {
    const GridIndex centre = bucket_of(place);
    const int reach[] = {1, dimension_ > 1 ? 1 : 0, dimension_ > 2 ? 1 : 0};
    for (int dz = -reach[2]; dz <= reach[2]; ++dz) {
      for (int dy = -reach[1]; dy <= reach[1]; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const auto found = values_.find(key({centre[0] + dx, centre[1] + dy, centre[2] + dz}));
          if (found == values_.end()) continue;
          for (const Value& value : found->second) visit(value);
        }
      }
    }
  }

 private:
  GridIndex bucket_of(const Point& x) const {
    GridIndex bucket{};
    for (int axis = 0; axis < dimension_; ++axis) bucket[axis] = static_cast<int>(std::floor(x[axis] / width_));
    return bucket;
  }

  static std::int64_t key(const GridIndex& bucket) {
    constexpr std::int64_t stride = std::int64_t{1} << 21;
    return (bucket[2] * stride + bucket[1]) * stride + bucket[0];
  }

  int dimension_;
  double width_;
  std::unordered_map<std::int64_t, std::vector<Value>> values_;
};

}  // namespace peritherm
