#pragma once

#include <vector>

#include "peritherm/output/section.hpp"

namespace peritherm {

/// Evenly spaced places of a section.
struct SampleLattice {
  Place first;
  Place step;
  int columns = 0, rows = 0;
  Place at(int i, int j) const { return {first.x + i * step.x, first.y + j * step.y}; }
};

/// Where temperatures jump between the materials of a section.
struct InterfaceLines {
  std::vector<Line> lines;    ///< in no order
  std::vector<bool> crossed;  ///< cells of the lattice through which lines run, x fastest; empty: none
};
InterfaceLines find_interfaces(const SectionSampler& sampler, const SampleLattice& lattice);

}  // namespace peritherm
