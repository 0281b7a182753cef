#include "peritherm/operators/correction_patterns.hpp"

#include <algorithm>
#include <bit>

namespace peritherm {
namespace {

constexpr std::size_t most_codes = 65536;

std::uint64_t mixed(std::uint64_t value) {
  // The finaliser of MurmurHash3.
  value ^= value >> 33;
  value *= 0xff51afd7ed558ccdULL;
  value ^= value >> 33;
  value *= 0xc4ceb9fe1a85ec53ULL;
  return value ^ (value >> 33);
}

}  // namespace

std::size_t CorrectionPatterns::Hasher::operator()(const BondDifference& bond) const {
  return mixed(std::bit_cast<std::uint64_t>(bond.difference) + 31 * static_cast<std::uint64_t>(bond.distance));
}

bool CorrectionPatterns::SameBits::operator()(const BondDifference& a, const BondDifference& b) const {
  return a.distance == b.distance &&
         std::bit_cast<std::uint64_t>(a.difference) == std::bit_cast<std::uint64_t>(b.difference);
}

std::uint64_t CorrectionPatterns::hash_of(Bonds bonds) {
  std::uint64_t hash = bonds.size();
  for (const BondDifference& bond : bonds) hash = mixed(hash + Hasher{}(bond));
  return hash;
}

/// Appends the codes of all bonds; none if the dictionary would have to grow beyond what 16 bits tell apart.
bool CorrectionPatterns::encode(Bonds bonds) {
  const std::size_t before = codes_.size();
  for (const BondDifference& bond : bonds) {
    auto found = code_of_.find(bond);
    if (found == code_of_.end()) {
      if (dictionary_.size() == most_codes) {
        codes_.resize(before);
        return false;
      }
      found = code_of_.emplace(bond, static_cast<std::uint16_t>(dictionary_.size())).first;
      dictionary_.push_back(bond);
    }
    codes_.push_back(found->second);
  }
  return true;
}

std::uint32_t CorrectionPatterns::add(Bonds bonds, std::uint64_t hash, bool enumerable) {
  for (auto found = number_of_.find(hash); found != number_of_.end(); found = number_of_.find(++hash)) {
    if (equals(found->second, bonds)) return found->second;
  }
  const auto number = static_cast<std::uint32_t>(patterns_.size());
  number_of_[hash] = number;
  Pattern pattern{static_cast<std::int64_t>(codes_.size()), static_cast<std::uint32_t>(bonds.size()), false};
  pattern.coded = enumerable && encode(bonds);
  if (!pattern.coded) {
    pattern.begin = static_cast<std::int64_t>(distances_.size());
    for (const BondDifference& bond : bonds) {
      distances_.push_back(static_cast<std::int32_t>(bond.distance));
      differences_.push_back(bond.difference);
    }
  }
  patterns_.push_back(pattern);
  return number;
}

bool CorrectionPatterns::equals(std::uint32_t pattern, Bonds bonds) const {
  const BondList own = (*this)[pattern];
  if (static_cast<std::size_t>(own.count) != bonds.size()) return false;
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    if (!SameBits{}(own[static_cast<int>(k)], bonds[k])) return false;
  }
  return true;
}

void CorrectionPatterns::finish() {
  decltype(code_of_)().swap(code_of_);
  decltype(number_of_)().swap(number_of_);
  patterns_.shrink_to_fit();
  codes_.shrink_to_fit();
  dictionary_.shrink_to_fit();
  distances_.shrink_to_fit();
  differences_.shrink_to_fit();
}

BondList CorrectionPatterns::operator[](std::uint32_t number) const {
  const Pattern& pattern = patterns_[number];
  const auto count = static_cast<int>(pattern.count);
  if (pattern.coded) return {count, codes_.data() + pattern.begin, dictionary_.data(), nullptr, nullptr};
  return {count, nullptr, nullptr, distances_.data() + pattern.begin, differences_.data() + pattern.begin};
}

std::size_t CorrectionPatterns::bytes() const {
  return patterns_.capacity() * sizeof(Pattern) + codes_.capacity() * sizeof(codes_[0]) +
         dictionary_.capacity() * sizeof(BondDifference) + distances_.capacity() * sizeof(distances_[0]) +
         differences_.capacity() * sizeof(differences_[0]);
}

}  // namespace peritherm
