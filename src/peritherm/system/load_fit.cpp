#include "peritherm/system/heat_system.hpp"

namespace peritherm {

std::optional<ThermalSystem::LoadPiece> HeatSystem::fit_loads(double from, double to, int, double) {
  (void)to;
  (void)from;
  return std::nullopt;
}

void HeatSystem::combine_linear(int, Field temperature, double rate_weight, Terms terms, Field result,
                                Accumulations accumulations) {
  combine(current_load(), temperature, rate_weight, terms, result, accumulations);
}

}  // namespace peritherm
