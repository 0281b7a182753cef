#pragma once

#include <set>
#include <utility>

#include "peritherm/discretisation/body.hpp"

namespace peritherm {

enum class TouchingSearch {
  points,       ///< materials of neighbouring points
  ways_between  ///< also of what lies between them, however thin
};

/// Pairs of materials of a body on one grid that touch, the smaller number first; not with what is cut away.
std::set<std::pair<MaterialIndex, MaterialIndex>> touching_materials(const Body& body, TouchingSearch search);

}  // namespace peritherm
