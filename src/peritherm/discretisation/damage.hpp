#pragma once

#include <cstdint>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {

/// Points with a bond that may cross a crack, ascending.
std::vector<std::size_t> points_near_cracks(const Body& body, int radius);

/// A bond between two points of the body that a crack cuts; partly conducting cracks cut as well.
struct CutBond {
  std::size_t first, second;  ///< points
  double time;                ///< when the first crack has passed it [s]
};

/// Every cut bond once.
std::vector<CutBond> find_cut_bonds(const Body& body, const Stencil& stencil);

/// Pairs of points of the body within each other's reach, cut ones included.
std::size_t count_bonds(const Body& body, const Stencil& stencil);

/// Share of each point's bonds that are cut at a time, 0 to 1; NaN where cut away.
std::vector<double> damage(const Body& body, const Stencil& stencil, const std::vector<CutBond>& cuts, double time);

}  // namespace peritherm
