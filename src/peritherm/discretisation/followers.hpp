#pragma once

#include <cstdint>
#include <vector>

#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/cut_schedule.hpp"

namespace peritherm {

/// Points that have no equation of their own: their boundary ties them to others so that the heat flux q [W/m²] into
/// the body is the prescribed one,
///   T_i = (Σ_p g_p T_p + q) / Σ_p g_p.
/// Row by row, as the conductances of bonds are kept.
struct Followers {
  std::vector<std::int64_t> entries;     ///< where the points stand in a field
  std::vector<std::int16_t> boundaries;  ///< that each belongs to
  std::vector<std::int64_t> fluxes;      ///< index of q among the exchange values; −1: q = 0
  std::vector<BondIndex> row_begin{0};   ///< points + 1
  std::vector<std::int64_t> neighbours;  ///< entries of p in a field, fictitious ones too
  std::vector<double> gains;             ///< g_p >= 0 [W/(m² K)]
  CutSchedule cuts;                      ///< gains that change in time
  std::size_t size() const { return entries.size(); }
};

}  // namespace peritherm
