#include "peritherm/integrators/loss_rates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace peritherm {
namespace {

/// +1 or −1, the same for the same place and round on every machine: the last mixing step of SplitMix64.
double random_sign(std::uint64_t place, std::uint64_t round) {
  std::uint64_t bits = place * 64 + round + 0x9e3779b97f4a7c15U;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebU;
  return ((bits ^ (bits >> 31)) & 1U) == 0 ? 1.0 : -1.0;
}

}  // namespace

void estimate_loss_rates(ThermalSystem& system, Field loss_rates, Field signs, Field rates) {
  const auto count = static_cast<std::ptrdiff_t>(system.field_size());
  std::fill(loss_rates.begin(), loss_rates.end(), 0.0);
  std::fill(rates.begin(), rates.end(), 0.0);
  std::fill(signs.begin(), signs.end(), 0.0);
  for (int round = 0; round < loss_rate_probes; ++round) {
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t n = 0; n < count; ++n) {
      signs[n] = random_sign(static_cast<std::uint64_t>(n), static_cast<std::uint64_t>(round));
    }
    system.combine_linear(-1, signs, 1.0, {}, rates);
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t n = 0; n < count; ++n) loss_rates[n] += rates[n] * rates[n] / loss_rate_probes;
  }
#pragma omp parallel for simd schedule(static)
  for (std::ptrdiff_t n = 0; n < count; ++n) loss_rates[n] = std::sqrt(loss_rates[n]);
}

}  // namespace peritherm
