#include "peritherm/reduction/response_looks.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/reduction/galerkin.hpp"

namespace peritherm {
namespace {

constexpr std::size_t looks_chunk = 512;  ///< entries whose basis stays in the second cache
constexpr std::size_t looks_slab = 16;    ///< chunks that are summed in order

/// One chunk of r and x for one shift.
struct ResponseChunk {
  double residual[looks_chunk], response[looks_chunk];
};

void fill_chunk(const HeatBasis& basis, ConstField rate, double shift, ConstField coordinates, std::size_t begin,
                std::size_t length, ResponseChunk& chunk) {
  double* const residual = chunk.residual;
  double* const response = chunk.response;
  for (std::size_t n = 0; n < length; ++n) {
    residual[n] = rate[begin + n];
    response[n] = 0.0;
  }
  for (std::size_t k = 0; k < basis.size(); ++k) {
    const double* const state = basis.state(k).data() + begin;
    const double* const own_rate = basis.rate(k).data() + begin;
    const double weight = coordinates[k], shifted = shift * weight;
#pragma omp simd
    for (std::size_t n = 0; n < length; ++n) {
      response[n] += weight * state[n];
      residual[n] += weight * own_rate[n] - shifted * state[n];
    }
  }
}

}  // namespace

ResponseSolver::ResponseSolver(const HeatBasis& basis) {
  ProjectedEquations projected = project_equations(basis, basis.size(), Matrix(basis.size(), 0));
  rates_ = std::move(projected.equations.rates);
  modes_ = std::move(projected.modes);
}

Matrix ResponseSolver::coordinates(const HeatBasis& basis, ConstField rate, const std::vector<double>& shifts) const {
  const std::vector<double> gains = basis.coordinates(rate);
  Matrix result(basis.size(), shifts.size());
  for (std::size_t mode = 0; mode < basis.size(); ++mode) {
    double gain = 0.0;
    for (std::size_t k = 0; k < basis.size(); ++k) gain += modes_(k, mode) * gains[k];
    for (std::size_t s = 0; s < shifts.size(); ++s) {
      const double share = gain / (shifts[s] + rates_[mode]);
      for (std::size_t k = 0; k < basis.size(); ++k) result(k, s) += modes_(k, mode) * share;
    }
  }
  return result;
}

std::vector<Look> look_at(const HeatBasis& basis, ConstField rate, const std::vector<double>& shifts,
                          const Matrix& coordinates) {
  const ConstField capacities = basis.capacities();
  const std::size_t entries = capacities.size(), count = shifts.size();
  constexpr std::size_t slab = looks_chunk * looks_slab;
  const std::size_t slabs = (entries + slab - 1) / slab;
  std::vector<Look> looks(slabs * count);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < slabs; ++b) {
    ResponseChunk chunk;
    for (std::size_t begin = b * slab; begin < std::min(entries, (b + 1) * slab); begin += looks_chunk) {
      const std::size_t length = std::min(looks_chunk, entries - begin);
      for (std::size_t s = 0; s < count; ++s) {
        fill_chunk(basis, rate, shifts[s], coordinates.column(s), begin, length, chunk);
        Look& look = looks[b * count + s];
        for (std::size_t n = 0; n < length; ++n) {
          const double capacity = capacities[begin + n];
          if (capacity == 0.0) continue;
          look.residual += capacity * (chunk.residual[n] * chunk.residual[n]);
          look.largest = std::max(look.largest, std::abs(chunk.response[n]));
        }
      }
    }
  }
  std::vector<Look> all(count);
  for (std::size_t k = 0; k < looks.size(); ++k) {
    all[k % count].residual += looks[k].residual;
    all[k % count].largest = std::max(all[k % count].largest, looks[k].largest);
  }
  for (Look& look : all) look.residual = std::sqrt(look.residual);
  return all;
}

void residual_of(const HeatBasis& basis, ConstField rate, double shift, ConstField coordinates, Field residual) {
  const ConstField capacities = basis.capacities();
  const std::size_t chunks = (capacities.size() + looks_chunk - 1) / looks_chunk;
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < chunks; ++c) {
    ResponseChunk chunk;
    const std::size_t begin = c * looks_chunk, length = std::min(looks_chunk, capacities.size() - begin);
    fill_chunk(basis, rate, shift, coordinates, begin, length, chunk);
    for (std::size_t n = 0; n < length; ++n) {
      residual[begin + n] = capacities[begin + n] > 0.0 ? chunk.residual[n] : 0.0;
    }
  }
}

}  // namespace peritherm
