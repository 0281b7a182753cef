#pragma once

#include "peritherm/operators/correction_kernels.hpp"

/// The loops over corrected bonds, compiled once per instruction set from the files that include this one. Everything
/// stands in an unnamed namespace, so that no two of those files share a compiled function.
namespace peritherm {
namespace {

/// Bonds as numbers in a dictionary.
struct CodedBonds {
  const std::uint16_t* codes;
  const BondDifference* dictionary;
  double difference(int k) const { return dictionary[codes[k]].difference; }
  std::int64_t distance(int k) const { return dictionary[codes[k]].distance; }
};

/// Bonds as they are.
struct PlainBonds {
  const std::int32_t* distances;
  const double* differences;
  double difference(int k) const { return differences[k]; }
  std::int64_t distance(int k) const { return distances[k]; }
};

template <int Points, class Bonds>
__attribute__((always_inline)) inline void sum_shared(const Bonds& bonds, int count, const double* const* own,
                                                      double* sums) {
  const double* base[Points];
  double centre[Points], sum[Points];
  for (int n = 0; n < Points; ++n) {
    base[n] = own[n];
    centre[n] = *own[n];
    sum[n] = 0.0;
  }
  for (int k = 0; k < count; ++k) {
    const double difference = bonds.difference(k);
    const std::int64_t distance = bonds.distance(k);
    for (int n = 0; n < Points; ++n) sum[n] += difference * (base[n][distance] - centre[n]);
  }
  for (int n = 0; n < Points; ++n) sums[n] = sum[n];
}

/// One point alone: four sums at once, for one would wait for itself.
template <class Bonds>
__attribute__((always_inline)) inline void sum_single(const Bonds& bonds, int count, const double* own,
                                                      double* result) {
  double sums[4] = {};
  const double centre = *own;
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    for (int n = 0; n < 4; ++n) sums[n] += bonds.difference(k + n) * (own[bonds.distance(k + n)] - centre);
  }
  for (; k < count; ++k) sums[0] += bonds.difference(k) * (own[bonds.distance(k)] - centre);
  *result = (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

template <class Bonds>
void sum_some(const Bonds& bonds, int count, const double* const* own, int points, double* sums) {
  for (; points >= 8; points -= 8, own += 8, sums += 8) sum_shared<8>(bonds, count, own, sums);
  if (points >= 4) {
    sum_shared<4>(bonds, count, own, sums);
    points -= 4, own += 4, sums += 4;
  }
  if (points == 3) sum_shared<3>(bonds, count, own, sums);
  if (points == 2) sum_shared<2>(bonds, count, own, sums);
  if (points == 1) sum_single(bonds, count, *own, sums);
}

void sum_points(const BondList& bonds, const double* const* own, int points, double* sums) {
  if (bonds.codes != nullptr) {
    sum_some(CodedBonds{bonds.codes, bonds.dictionary}, bonds.count, own, points, sums);
  } else {
    sum_some(PlainBonds{bonds.distances, bonds.differences}, bonds.count, own, points, sums);
  }
}

template <int Lanes, int Vectors, class Bonds>
__attribute__((always_inline)) inline void sum_vectors(const Bonds& bonds, int count, const double* own, double* sums) {
  typedef double Vector __attribute__((vector_size(Lanes * sizeof(double)), aligned(sizeof(double)), may_alias));
  Vector centre[Vectors], sum[Vectors];
  for (int v = 0; v < Vectors; ++v) {
    centre[v] = *reinterpret_cast<const Vector*>(own + v * Lanes);
    sum[v] = Vector{};
  }
  for (int k = 0; k < count; ++k) {
    const double difference = bonds.difference(k);
    const double* const other = own + bonds.distance(k);
    for (int v = 0; v < Vectors; ++v) {
      sum[v] += difference * (*reinterpret_cast<const Vector*>(other + v * Lanes) - centre[v]);
    }
  }
  for (int v = 0; v < Vectors; ++v) *reinterpret_cast<Vector*>(sums + v * Lanes) = sum[v];
}

/// What is left over at the end is covered by a last vector that overlaps the one before.
template <int Lanes, class Bonds>
void sum_along(const Bonds& bonds, int count, const double* own, int length, double* sums) {
  int x = 0;
  for (; x + 4 * Lanes <= length; x += 4 * Lanes) sum_vectors<Lanes, 4>(bonds, count, own + x, sums + x);
  for (; x + Lanes <= length; x += Lanes) sum_vectors<Lanes, 1>(bonds, count, own + x, sums + x);
  if (x < length) sum_vectors<Lanes, 1>(bonds, count, own + length - Lanes, sums + length - Lanes);
}

template <int Lanes>
void sum_run(const BondList& bonds, const double* own, int length, double* sums) {
  if (bonds.codes != nullptr) {
    sum_along<Lanes>(CodedBonds{bonds.codes, bonds.dictionary}, bonds.count, own, length, sums);
  } else {
    sum_along<Lanes>(PlainBonds{bonds.distances, bonds.differences}, bonds.count, own, length, sums);
  }
}

/// Types of so many values at once; GCC converts no vectors whose size a function's own template sets.
template <int Lanes>
struct Lane {
  typedef double Values __attribute__((vector_size(Lanes * sizeof(double)), aligned(sizeof(double)), may_alias));
  typedef int Counts __attribute__((vector_size(Lanes * sizeof(int)), aligned(sizeof(int)), may_alias));
};

template <int Lanes>
void sum_bundle(const BondBundle& bonds, const double* own, double* sums) {
  using Values = typename Lane<Lanes>::Values;
  using Counts = typename Lane<Lanes>::Counts;
  constexpr int most_points = CorrectionKernels::most_points, vectors = most_points / Lanes;
  Values centre[vectors], rest[vectors], sum[vectors];
  for (int v = 0; v < vectors; ++v) {
    centre[v] = *reinterpret_cast<const Values*>(own + v * Lanes);
    rest[v] = *reinterpret_cast<const Values*>(bonds.rests + v * Lanes);
    sum[v] = Values{};
  }
  const std::int32_t* counts = bonds.counts;
  for (int k = 0; k < bonds.count; ++k, counts += most_points) {
    const BondDifference& step = bonds.steps[bonds.codes[k]];
    const double* const other = own + step.distance;
    for (int v = 0; v < vectors; ++v) {
      const Values count = __builtin_convertvector(*reinterpret_cast<const Counts*>(counts + v * Lanes), Values);
      sum[v] += step.difference * (count + rest[v]) * (*reinterpret_cast<const Values*>(other + v * Lanes) - centre[v]);
    }
  }
  for (int v = 0; v < vectors; ++v) *reinterpret_cast<Values*>(sums + v * Lanes) = sum[v];
}

}  // namespace
}  // namespace peritherm
