#include "peritherm/system/linear_functional.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

namespace peritherm {
namespace {

constexpr std::size_t longest_strip = 2048;
constexpr std::size_t entries_per_chunk = 16384;

std::uint64_t hash_of(std::span<const double> weights) {
  std::uint64_t hash = weights.size();
  for (const double weight : weights) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(weight)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

double dot(const double* weights, const double* values, std::int32_t length) {
  double sums[8] = {};
  std::int32_t k = 0;
  for (; k + 8 <= length; k += 8) {
    for (int n = 0; n < 8; ++n) sums[n] += weights[k + n] * values[k + n];
  }
  for (; k < length; ++k) sums[0] += weights[k] * values[k];
  return ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

}  // namespace

void LinearFunctional::append(std::int64_t first, std::span<const double> weights) {
  for (std::size_t begin = 0; begin < weights.size();) {
    if (weights[begin] == 0.0) {
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    while (end < weights.size() && weights[end] != 0.0 && end - begin < longest_strip) ++end;
    append_strip(first + static_cast<std::int64_t>(begin), weights.subspan(begin, end - begin));
    begin = end;
  }
}

void LinearFunctional::append_strip(std::int64_t entry, std::span<const double> weights) {
  const std::uint64_t hash = hash_of(weights);
  const auto [low, high] = known_.equal_range(hash);
  const auto found = std::find_if(low, high, [&](const auto& candidate) {
    return candidate.second + weights.size() <= weights_.size() &&
           std::memcmp(weights_.data() + candidate.second, weights.data(), weights.size_bytes()) == 0;
  });
  auto first_weight = static_cast<std::uint32_t>(weights_.size());
  if (found != high) {
    first_weight = found->second;
  } else {
    known_.emplace(hash, first_weight);
    weights_.insert(weights_.end(), weights.begin(), weights.end());
  }
  strips_.push_back({entry, static_cast<std::int32_t>(weights.size()), first_weight});
  chunk_length_ += weights.size();
  if (chunk_length_ < entries_per_chunk) return;
  chunk_begin_.push_back(strips_.size());
  chunk_length_ = 0;
}

void LinearFunctional::finish() {
  if (chunk_begin_.back() != strips_.size()) chunk_begin_.push_back(strips_.size());
  strips_.shrink_to_fit();
  weights_.shrink_to_fit();
  decltype(known_)().swap(known_);
}

double LinearFunctional::sum(std::size_t first, std::size_t last, const double* field) const {
  double total = 0.0;
  for (std::size_t s = first; s < last; ++s) {
    const Strip& strip = strips_[s];
    total += dot(weights_.data() + strip.first_weight, field + strip.entry, strip.length);
  }
  return total;
}

double LinearFunctional::operator()(ConstField field) const {
  const auto chunks = static_cast<std::int64_t>(chunk_begin_.size()) - 1;
  thread_local std::vector<double> room;
  room.assign(static_cast<std::size_t>(chunks), 0.0);
  double* const sums = room.data();
#pragma omp parallel for schedule(static) if (chunks > 1)
  for (std::int64_t c = 0; c < chunks; ++c) {
    sums[c] =
        sum(chunk_begin_[static_cast<std::size_t>(c)], chunk_begin_[static_cast<std::size_t>(c) + 1], field.data());
  }
  return std::accumulate(sums, sums + chunks, 0.0);
}

std::size_t LinearFunctional::bytes() const {
  return strips_.capacity() * sizeof(Strip) + weights_.capacity() * sizeof(double) +
         chunk_begin_.capacity() * sizeof(std::size_t);
}

}  // namespace peritherm
