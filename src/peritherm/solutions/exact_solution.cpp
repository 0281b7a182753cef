#include "peritherm/solutions/exact_solution.hpp"

#include "peritherm/solutions/classical.hpp"

namespace peritherm {
namespace {

double value(const HeldEnds& bar, const Point& place, double time) {
  return bar.held + (bar.start - bar.held) * slab_with_held_ends({bar.length, bar.diffusivity}, place[0], time);
}

}  // namespace

double temperature(const ExactSolution& solution, const Point& place, double time) {
  return std::visit([&](const auto& chosen) { return value(chosen, place, time); }, solution);
}

}  // namespace peritherm
