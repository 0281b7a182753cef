#include "peritherm/operators/conduction.hpp"

namespace peritherm {

void ConductionOperator::add_exchange_weights(const Stretch& stretch, std::span<const std::int16_t> holder,
                                              int boundary, std::int64_t origin, Field weights) const {
  for (std::int64_t entry = stretch.entry; entry < stretch.entry + stretch.length; ++entry) {
    if (holder[static_cast<std::size_t>(entry)] >= 0) continue;
    visit_bonds(static_cast<std::size_t>(entry), [&](std::size_t j, double conductance) {
      if (holder[j] != boundary) return;
      weights[j - static_cast<std::size_t>(origin)] += conductance;
      weights[static_cast<std::size_t>(entry - origin)] -= conductance;
    });
  }
}

}  // namespace peritherm
