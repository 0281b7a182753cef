#pragma once

#include "bodies.hpp"
#include "machine.hpp"

namespace peritherm::bench {

/// The rate of the first points of a body, in the order of their numbers, as other programs would hold it. Columns and
/// neighbours are entries of the padded field, so that both see the fictitious points as the stencil does.
struct Baselines {
  std::size_t points = 0;
  SparseRows matrix;
  NeighbourList list;
};

/// As many points as fit into `most_bytes` of matrix. The body must have no crack.
Baselines make_baselines(const Assembly& assembly, double most_bytes);

/// Largest difference of `found` from the rate of the stencil, relative to the largest rate.
double deviation(const Evaluation& evaluation, const std::vector<double>& found, std::size_t points);

}  // namespace peritherm::bench
