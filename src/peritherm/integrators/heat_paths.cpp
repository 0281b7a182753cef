#include "peritherm/integrators/heat_paths.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

/// Bonds this weak against all bonds of a point together are the rounding of those that a crack cuts.
constexpr double weakest_bond = 1e-12;

}  // namespace

HeatPaths::HeatPaths(ThermalSystem& system) : system_(system), least_rate_(weakest_bond * system.fastest_rate()) {}

/// Entries that are not integrated have no rate, so they are never marked here.
bool HeatPaths::mark_changed(ConstField rates, Field marks) const {
  const auto count = static_cast<std::ptrdiff_t>(system_.field_size());
  bool any = false;
#pragma omp parallel for schedule(static) reduction(|| : any)
  for (std::ptrdiff_t n = 0; n < count; ++n) {
    if (marks[n] == 1.0 || std::abs(rates[n]) <= least_rate_) continue;
    marks[n] = 1.0;
    any = true;
  }
  return any;
}

void HeatPaths::mark_open(Field marks, Field scratch) {
  // A body at one temperature changes only where something else stands beside it.
  std::fill(marks.begin(), marks.end(), 1.0);
  std::fill(scratch.begin(), scratch.end(), 0.0);
  system_.combine_linear(-1, marks, 1.0, {}, scratch);
  ++evaluations_;
  std::fill(marks.begin(), marks.end(), 0.0);
  if (mark_changed(scratch, marks)) spread(marks, scratch);
}

void HeatPaths::spread(Field marks, Field scratch) {
  std::fill(scratch.begin(), scratch.end(), 0.0);
  do {
    system_.combine_linear(-1, marks, 1.0, {}, scratch);
    ++evaluations_;
  } while (mark_changed(scratch, marks));
}

}  // namespace peritherm
