#pragma once

#include <vector>

#include "peritherm/discretisation/body.hpp"

namespace peritherm {

/// A crack that passes a bond.
struct Crossing {
  double time;          ///< when the crack has passed [s]
  double transmission;  ///< share of its conductance that the bond keeps
  bool in_time;         ///< false: there from the start
};

/// What lies along a bond.
struct BondPath {
  double conductivity = 0.0;        ///< without cracks [W/(m K)]; 0 if the bond leaves the body
  std::vector<Crossing> crossings;  ///< at most one per crack and mirror image, earliest first
};

/// Follows bonds through materials and cracks. Beyond mirrored faces the body goes on as its mirror image.
class BondTracer {
 public:
  explicit BondTracer(const Body& body);

  /// Bond between two points of the materials given; `b` may lie beyond mirrored faces. Fills `path`; symmetric in
  /// the end points to the bit. May be called from several threads.
  void trace(Point a, MaterialIndex material_a, Point b, MaterialIndex material_b, BondPath& path) const;

 private:
  struct Piece {
    Point begin, end;
    double share;  ///< of the bond's length
  };
  Point fold(const Point& x, const Point& within) const;
  Point off_cracks(const Point& x) const;
  void cut_at_walls(const Point& a, const Point& b, std::vector<Piece>& pieces) const;
  double conductivity_along(const std::vector<Piece>& pieces, MaterialIndex a, MaterialIndex b) const;

  const Body& body_;
  Point lower_{}, upper_{};  ///< corners of the box
  bool uniform_;             ///< one material, nothing cut away
};

/// Share of its conductance that the cracks there from the start leave to a bond: the product of their transmissions.
double standing_share(const BondPath& path);

}  // namespace peritherm
