#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "peritherm/base/field.hpp"

namespace peritherm {

/// Σ weight · T over some entries of a field. Entries that stand together form a strip, and strips with equal lists of
/// weights share the list: along a face that is held uniformly there are only a few.
class LinearFunctional {
 public:
  /// Takes the entries first, first + 1, … whose weights are not 0; each entry once, ascending.
  void append(std::int64_t first, std::span<const double> weights);
  /// To be called once after the last `append`.
  void finish();

  /// The same bits for any number of threads.
  double operator()(ConstField field) const;

  bool empty() const { return strips_.empty(); }
  std::size_t bytes() const;

 private:
  struct Strip {
    std::int64_t entry;
    std::int32_t length;
    std::uint32_t first_weight;
  };
  void append_strip(std::int64_t entry, std::span<const double> weights);
  double sum(std::size_t first, std::size_t last, const double* field) const;

  std::vector<Strip> strips_;
  std::vector<double> weights_;
  std::vector<std::size_t> chunk_begin_{0};  ///< strips that are summed by one thread
  std::size_t chunk_length_ = 0;
  std::unordered_multimap<std::uint64_t, std::uint32_t> known_;
};

}  // namespace peritherm
