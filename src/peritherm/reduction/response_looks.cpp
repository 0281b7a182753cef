#include "peritherm/reduction/response_looks.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/reduction/galerkin.hpp"

namespace peritherm {
namespace {

constexpr std::size_t looks_chunk = 512;  ///< entries whose basis stays in the second cache
constexpr std::size_t looks_slab = 16;    ///< chunks that are summed in order

/// One chunk of the residual and of the response at one time.
struct ResponseChunk {
  double residual[looks_chunk], response[looks_chunk];
};

void fill_chunk(const HeatBasis& basis, const Drive& drive, const Response& response, std::size_t time,
                std::size_t begin, std::size_t length, ResponseChunk& chunk) {
  double* const residual = chunk.residual;
  double* const temperature = chunk.response;
  for (std::size_t n = 0; n < length; ++n) {
    residual[n] = drive.is_start ? 0.0 : drive.rate[begin + n];
    temperature[n] = 0.0;
  }
  for (std::size_t k = 0; k < basis.size(); ++k) {
    const double* const state = basis.state(k).data() + begin;
    const double* const rate = basis.rate(k).data() + begin;
    const double weight = response.coordinates(k, time), slope = response.slopes(k, time);
#pragma omp simd
    for (std::size_t n = 0; n < length; ++n) {
      temperature[n] += weight * state[n];
      residual[n] += weight * rate[n] - slope * state[n];
    }
  }
}

}  // namespace

ResponseSolver::ResponseSolver(const HeatBasis& basis, std::size_t count) : basis_(basis) {
  ProjectedEquations projected = project_equations(basis, count, Matrix(basis.size(), 0));
  rates_ = std::move(projected.equations.rates);
  modes_ = std::move(projected.modes);
}

Response ResponseSolver::respond(const Drive& drive, const std::vector<double>& times) const {
  const std::vector<double> gains = basis_.coordinates(drive.rate);
  Response response{Matrix(basis_.size(), times.size()), Matrix(basis_.size(), times.size())};
  for (std::size_t mode = 0; mode < rates_.size(); ++mode) {
    double gain = 0.0;
    for (std::size_t k = 0; k < modes_.rows; ++k) gain += modes_(k, mode) * gains[k];
    for (std::size_t t = 0; t < times.size(); ++t) {
      const double decayed = std::exp(-rates_[mode] * times[t]);
      const double grown =
          rates_[mode] * times[t] > 1e-12 ? -std::expm1(-rates_[mode] * times[t]) / rates_[mode] : times[t];
      const double share = gain * (drive.is_start ? decayed : grown);
      const double slope = gain * decayed * (drive.is_start ? -rates_[mode] : 1.0);
      for (std::size_t k = 0; k < modes_.rows; ++k) {
        response.coordinates(k, t) += modes_(k, mode) * share;
        response.slopes(k, t) += modes_(k, mode) * slope;
      }
    }
  }
  return response;
}

std::vector<Look> look_at(const HeatBasis& basis, const Drive& drive, const Response& response) {
  const ConstField capacities = basis.capacities();
  const std::size_t entries = capacities.size(), count = response.slopes.columns;
  constexpr std::size_t slab = looks_chunk * looks_slab;
  const std::size_t slabs = (entries + slab - 1) / slab;
  std::vector<Look> looks(slabs * count);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < slabs; ++b) {
    ResponseChunk chunk;
    for (std::size_t begin = b * slab; begin < std::min(entries, (b + 1) * slab); begin += looks_chunk) {
      const std::size_t length = std::min(looks_chunk, entries - begin);
      for (std::size_t t = 0; t < count; ++t) {
        fill_chunk(basis, drive, response, t, begin, length, chunk);
        Look& look = looks[b * count + t];
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

void residual_of(const HeatBasis& basis, const Drive& drive, const Response& response, std::size_t time,
                 Field residual) {
  const ConstField capacities = basis.capacities();
  const std::size_t chunks = (capacities.size() + looks_chunk - 1) / looks_chunk;
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < chunks; ++c) {
    ResponseChunk chunk;
    const std::size_t begin = c * looks_chunk, length = std::min(looks_chunk, capacities.size() - begin);
    fill_chunk(basis, drive, response, time, begin, length, chunk);
    for (std::size_t n = 0; n < length; ++n) {
      residual[begin + n] = capacities[begin + n] > 0.0 ? chunk.residual[n] : 0.0;
    }
  }
}

}  // namespace peritherm
