#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "peritherm/operators/correction_kernels.hpp"

namespace peritherm {

/// The corrected bonds of points, each different list of them once: along straight cracks and faces most points share
/// theirs with others. Bonds that are cut take few values of (distance, difference) in all, so that a 16-bit number
/// stands for each; lists with other values are kept as they are.
class CorrectionPatterns {
 public:
  using Bonds = std::span<const BondDifference>;

  /// A value to find equal lists by.
  static std::uint64_t hash_of(Bonds bonds);

  /// Number of a pattern that is added if it is new. `enumerable`: its values are among few.
  std::uint32_t add(Bonds bonds, std::uint64_t hash, bool enumerable);
  /// To be called once after the last `add`.
  void finish();

  BondList operator[](std::uint32_t pattern) const;
  std::size_t bytes() const;

 private:
  struct Pattern {
    std::int64_t begin;
    std::uint32_t count;
    bool coded;
  };
  struct Hasher {
    std::size_t operator()(const BondDifference& bond) const;
  };
  struct SameBits {
    bool operator()(const BondDifference& a, const BondDifference& b) const;
  };
  bool encode(Bonds bonds);
  bool equals(std::uint32_t pattern, Bonds bonds) const;

  std::vector<Pattern> patterns_;
  std::vector<std::uint16_t> codes_;
  std::vector<BondDifference> dictionary_;
  std::vector<std::int32_t> distances_;  ///< of patterns that are not coded
  std::vector<double> differences_;
  std::unordered_map<BondDifference, std::uint16_t, Hasher, SameBits> code_of_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_of_;
};

}  // namespace peritherm
