#pragma once

#include "peritherm/base/describe.hpp"

namespace peritherm {

/// What stands for the heat that a point exchanges with the rest of its own cell.
enum class SelfTerm {
  none,
  bobaru_2010,  ///< k(0) in the cell, curvature from the nearest neighbours [bobaru2010, eq. 20]
  bobaru_2012   ///< all touching neighbours at half their distance r, with k(r/2) [bobaru2012, section 4]
};

template <>
struct EnumNames<SelfTerm> {
  static constexpr std::array<std::pair<SelfTerm, std::string_view>, 3> values{
      {{SelfTerm::none, "none"}, {SelfTerm::bobaru_2010, "bobaru_2010"}, {SelfTerm::bobaru_2012, "bobaru_2012"}}};
};

}  // namespace peritherm
