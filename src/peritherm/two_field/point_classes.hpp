#pragma once

#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "peritherm/base/field.hpp"

namespace peritherm {

/// Points whose rows are equal, neighbours counted from the point itself.
struct PointClasses {
  /// Neighbouring points [begin, end) of one class.
  struct Run {
    PointIndex begin, end;
    PointIndex number;
  };
  std::vector<PointIndex> class_of;  ///< of every point
  std::vector<PointIndex> example;   ///< a point of each class
  std::vector<Run> runs;             ///< all points once, ascending
  std::size_t size() const { return example.size(); }
};

/// Mixes a value into a hash.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15U + (hash << 6) + (hash >> 2);
  return hash * 0xff51afd7ed558ccdU;
}

/// Runs of a numbering.
void find_runs(PointClasses& classes);

/// `same(i, j)`: the rows of points i and j are equal; equal rows must have equal `hash(i)`.
template <class Hash, class Same>
PointClasses classify(std::size_t size, const Hash& hash, const Same& same) {
  PointClasses result;
  result.class_of.resize(size);
  std::unordered_multimap<std::uint64_t, PointIndex> known;
  for (std::size_t i = 0; i < size; ++i) {
    // Most points are like the one before, which is found without a hash.
    if (i > 0 && same(static_cast<std::size_t>(result.example[result.class_of[i - 1]]), i)) {
      result.class_of[i] = result.class_of[i - 1];
      continue;
    }
    const std::uint64_t key = hash(i);
    const auto [first, last] = known.equal_range(key);
    auto found = first;
    while (found != last && !same(static_cast<std::size_t>(result.example[found->second]), i)) ++found;
    if (found != last) {
      result.class_of[i] = found->second;
      continue;
    }
    result.class_of[i] = static_cast<PointIndex>(result.example.size());
    result.example.push_back(static_cast<PointIndex>(i));
    known.emplace(key, result.class_of[i]);
  }
  find_runs(result);
  return result;
}

}  // namespace peritherm
