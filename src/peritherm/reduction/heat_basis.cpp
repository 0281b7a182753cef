#include "peritherm/reduction/heat_basis.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

constexpr std::size_t products_chunk = 512;  ///< entries that stay in the first caches
constexpr std::size_t products_slab = 32;    ///< chunks that are summed by one thread, in order

}  // namespace

Matrix weighted_products(ConstField weights, std::span<const ConstField> first, std::span<const ConstField> second) {
  const std::size_t entries = weights.size(), count = first.size() * second.size();
  constexpr std::size_t slab = products_chunk * products_slab;
  const std::size_t slabs = (entries + slab - 1) / slab;
  std::vector<double> sums(slabs * count, 0.0);
#pragma omp parallel
  {
    std::vector<double> weighted(products_chunk);
#pragma omp for schedule(static)
    for (std::size_t s = 0; s < slabs; ++s) {
      double* const own = sums.data() + s * count;
      for (std::size_t begin = s * slab; begin < std::min(entries, (s + 1) * slab); begin += products_chunk) {
        const std::size_t length = std::min(products_chunk, entries - begin);
        for (std::size_t b = 0; b < second.size(); ++b) {
          const double* const values = second[b].data() + begin;
          for (std::size_t n = 0; n < length; ++n) weighted[n] = weights[begin + n] * values[n];
          for (std::size_t a = 0; a < first.size(); ++a) {
            const double* const others = first[a].data() + begin;
            double sum = 0.0;
#pragma omp simd reduction(+ : sum)
            for (std::size_t n = 0; n < length; ++n) sum += weighted[n] * others[n];
            own[b * first.size() + a] += sum;
          }
        }
      }
    }
  }
  Matrix products(first.size(), second.size());
  for (std::size_t s = 0; s < slabs; ++s) {
    for (std::size_t k = 0; k < count; ++k) products.values[k] += sums[s * count + k];
  }
  return products;
}

void add_states(std::span<const ConstField> states, std::span<const double> weights, Field values) {
  const std::size_t chunks = (values.size() + products_chunk - 1) / products_chunk;
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < chunks; ++c) {
    const std::size_t begin = c * products_chunk, end = std::min(values.size(), begin + products_chunk);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double weight = weights[k];
      const double* const from = states[k].data();
#pragma omp simd
      for (std::size_t n = begin; n < end; ++n) values[n] += weight * from[n];
    }
  }
}

HeatBasis::HeatBasis(HeatSystem& system) : system_(system), capacities_(system.size()) {
  system.conduction().heat_capacities(Field(capacities_).first(system.field_size()));
}

std::size_t HeatBasis::add(std::vector<FieldStorage> states, double least_remainder) {
  const std::size_t before = size();
  for (FieldStorage& values : states) {
    if (orthonormalise(values, least_remainder)) append(std::move(values), false);
  }
  return size() - before;
}

void HeatBasis::add_conserved(std::vector<FieldStorage> states) {
  for (FieldStorage& values : states) {
    if (orthonormalise(values, 1e-10)) append(std::move(values), true);
  }
  conserved_ = size();
}

/// Gram and Schmidt's method; a second time removes what rounding left of the first [giraud2005].
bool HeatBasis::orthonormalise(FieldStorage& values, double least_remainder) const {
  const ConstField own[] = {values};
  const double size = std::sqrt(weighted_products(capacities_, own, own)(0, 0));
  if (!(size > 0.0)) return false;
  double remainder = size;
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> shares = coordinates(values);
    for (double& share : shares) share = -share;
    add_states(states(), shares, values);
    remainder = std::sqrt(weighted_products(capacities_, own, own)(0, 0));
    if (!(remainder > least_remainder * size)) return false;
  }
  const auto entries = static_cast<std::ptrdiff_t>(values.size());
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < entries; ++n) values[n] = capacities_[n] > 0.0 ? values[n] / remainder : 0.0;
  return true;
}

void HeatBasis::append(FieldStorage values, bool is_conserved) {
  FieldStorage rate(system_.size());
  if (!is_conserved) system_.combine_linear(-1, values, 1.0, {}, rate);
  states_.push_back(std::move(values));
  rates_.push_back(std::move(rate));
  std::vector<double> row = coordinates(rates_.back());
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = k < conserved_ ? 0.0 : -row[k];
  conduction_.push_back(std::move(row));
}

Matrix HeatBasis::conduction(std::size_t count) const {
  Matrix matrix(count, count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j <= i; ++j) matrix(i, j) = matrix(j, i) = conduction_[i][j];
  }
  return matrix;
}

std::vector<double> HeatBasis::coordinates(ConstField values) const {
  if (states_.empty()) return {};
  const ConstField second[] = {values};
  return weighted_products(capacities_, states(), second).values;
}

std::size_t HeatBasis::bytes() const { return (states_.size() + rates_.size() + 1) * system_.size() * sizeof(double); }

}  // namespace peritherm
