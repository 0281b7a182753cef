#pragma once

#include <functional>
#include <utility>

#include "peritherm/discretisation/point_values.hpp"

namespace peritherm {

/// Where temperatures jump between materials that touch; without functions nowhere.
struct MaterialJumps {
  std::function<MaterialIndex(const Point& place)> material_at;                              ///< by shapes
  std::function<bool(MaterialIndex one, MaterialIndex other, const Point& place)> may_jump;  ///< in any order
  explicit operator bool() const { return static_cast<bool>(may_jump); }
  bool between(MaterialIndex one, MaterialIndex other, const Point& place) const {
    return one != other && one != no_material && other != no_material && may_jump(one, other, place);
  }
};

/// Two places on the way from one to another, a rounding apart, between which the material changes from that of the
/// first.
std::pair<Point, Point> find_change(const MaterialJumps& jumps, const Point& from, const Point& to);

}  // namespace peritherm
