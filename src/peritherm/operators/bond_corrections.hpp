#pragma once

#include <cstdint>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/cut_schedule.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {

/// The bonds whose conductance differs from the stencil's: cut, partly conducting, between materials, to places where
/// nothing is. Row by row; the difference of the conductance [W/K], of whole cells, to be added to the stencil's.
struct BondCorrections {
  std::vector<std::int64_t> rows;          ///< entries of the points that have any, ascending
  std::vector<std::int64_t> row_begin{0};  ///< rows + 1
  std::vector<std::int32_t> distances;     ///< entry of j minus entry of i
  std::vector<double> differences;         ///< [W/K]
  CutSchedule cuts;                        ///< differences that change in time

  std::size_t bytes() const;
};

BondCorrections make_corrections(const Body& body, const PaddedGrid& layout, const Stencil& stencil);

/// Points with at least one bond that may differ from the stencil's; one flag per point.
std::vector<std::uint8_t> find_special_points(const Body& body, const Stencil& stencil);

}  // namespace peritherm
