#pragma once

#include <vector>

namespace peritherm {

/// A place in a plane: lengths [m] in a section, pixels (downwards) on a canvas.
struct Place {
  double x = 0.0;
  double y = 0.0;
  bool operator==(const Place&) const = default;
};

using Line = std::vector<Place>;

struct Rectangle {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

/// Twice the area of the triangle a, b, c; positive if c lies left of the way from a to b (y upwards).
inline double cross(const Place& a, const Place& b, const Place& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace peritherm
