#pragma once

#include "peritherm/base/describe.hpp"

namespace peritherm {

/// The faces of the box around a body, in the order axis 0 low, axis 0 high, axis 1 low, …
enum class Face { x_min, x_max, y_min, y_max, z_min, z_max };

constexpr int axis_of(Face face) { return static_cast<int>(face) / 2; }
constexpr bool is_upper(Face face) { return static_cast<int>(face) % 2 == 1; }
constexpr Face make_face(int axis, bool upper) { return static_cast<Face>(2 * axis + (upper ? 1 : 0)); }

template <>
struct EnumNames<Face> {
  static constexpr std::array<std::pair<Face, std::string_view>, 6> values{{{Face::x_min, "x_min"},
                                                                            {Face::x_max, "x_max"},
                                                                            {Face::y_min, "y_min"},
                                                                            {Face::y_max, "y_max"},
                                                                            {Face::z_min, "z_min"},
                                                                            {Face::z_max, "z_max"}}};
};

}  // namespace peritherm
