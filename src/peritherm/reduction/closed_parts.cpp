#include "peritherm/reduction/closed_parts.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/integrators/heat_paths.hpp"

namespace peritherm {
namespace {

/// One evaluation spreads marks by a horizon; beyond so many horizons the body is not searched for parts.
constexpr int longest_path = 5000;

/// 1 at all free points if nothing takes heat from them, else nothing.
std::vector<FieldStorage> find_closed_body(HeatSystem& system, ConstField capacities) {
  FieldStorage ones(system.size()), rate(system.size());
  for (std::size_t n = 0; n < capacities.size(); ++n) ones[n] = capacities[n] > 0.0 ? 1.0 : 0.0;
  system.combine_linear(-1, ones, 1.0, {}, rate);
  // Far below what one bond to something held would take.
  const double rounding = 1e-12 * system.fastest_rate();
  for (std::size_t n = 0; n < capacities.size(); ++n) {
    if (capacities[n] > 0.0 && std::abs(rate[n]) > rounding) return {};
  }
  for (std::size_t n = 0; n < capacities.size(); ++n) ones[n] = capacities[n] > 0.0 ? 1.0 : 0.0;
  std::vector<FieldStorage> whole;
  whole.push_back(std::move(ones));
  return whole;
}

}  // namespace

std::vector<FieldStorage> find_closed_parts(HeatSystem& system, const PaddedGrid& layout, ConstField capacities,
                                            std::size_t most, long& evaluations) {
  for (int axis = 0; axis < 3; ++axis) {
    if (layout.padding(axis) > 0 && layout.grid().count(axis) / layout.padding(axis) > longest_path) {
      ++evaluations;
      return find_closed_body(system, capacities);
    }
  }
  HeatPaths paths(system);
  FieldStorage known(system.size()), scratch(system.size());
  paths.mark_open(known, scratch);
  std::vector<FieldStorage> parts;
  for (std::size_t n = 0; n < capacities.size() && parts.size() < most; ++n) {
    if (capacities[n] == 0.0 || known[n] == 1.0) continue;
    FieldStorage marks(system.size());
    marks[n] = 1.0;
    paths.spread(marks, scratch);
    for (std::size_t k = 0; k < capacities.size(); ++k) {
      marks[k] = capacities[k] > 0.0 && marks[k] == 1.0 ? 1.0 : 0.0;
      if (marks[k] == 1.0) known[k] = 1.0;
    }
    parts.push_back(std::move(marks));
  }
  evaluations += paths.evaluations();
  return parts;
}

}  // namespace peritherm
