#pragma once

#include <algorithm>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/share_over_time.hpp"

namespace peritherm {

/// A crack that passes a bond or closes again, or the elongation that breaks it.
struct Crossing {
  double time;                 ///< when the crack has passed, or changes what it lets through [s]
  double transmission;         ///< share of its conductance that the bond keeps
  bool in_time;                ///< false: there from the start
  bool by_elongation = false;  ///< not a crack
  int crack = 0;               ///< which one, mirror images apart; what it does last counts
};

/// What lies along a bond.
struct BondPath {
  double conductivity = 0.0;        ///< without cracks [W/(m K)]; 0 if the bond leaves the body
  double face_share = 1.0;          ///< what mirroring faces make of it, over the volume of its beginning; at first
  std::vector<ShareKnot> faces{};   ///< the same where it changes in time; empty where it does not
  std::vector<Crossing> crossings;  ///< earliest first
};

/// What a bond keeps of its conductance besides what mirroring faces make of it: the product of the transmissions of
/// the cracks that have passed it, or that of its elongation if this is less. Displacements that open a crack break the
/// bonds which it has cut already, and one gap must not count twice.
class RemainingShare {
 public:
  void pass(const Crossing& crossing);
  double value() const { return std::min(cracks_, broken_); }

 private:
  struct Passed {
    int crack;
    double transmission;
  };
  std::vector<Passed> passed_;
  double cracks_ = 1.0, broken_ = 1.0;
};

/// The cracks that reach into some part of the body, and with which of their parts.
struct NearbyCracks {
  struct Part {
    const CrackSurface* crack;
    std::vector<int> parts;
  };
  std::vector<Part> cracks;
  bool empty() const { return cracks.empty(); }
};

/// Follows bonds through materials and cracks, and knows which break. Beyond mirrored faces the body goes on as its
/// mirror image.
class BondTracer {
 public:
  explicit BondTracer(const Body& body);

  /// Bond between two points of the materials given; `b` may lie beyond mirrored faces. Fills `path`; symmetric in
  /// the end points to the bit. May be called from several threads.
  void trace(Point a, MaterialIndex material_a, Point b, MaterialIndex material_b, BondPath& path) const {
    trace(all_, a, material_a, b, material_b, path);
  }
  /// As above for a bond that meets no other cracks than those given.
  void trace(const NearbyCracks& nearby, Point a, MaterialIndex material_a, Point b, MaterialIndex material_b,
             BondPath& path) const;

  /// The cracks that bonds inside a box may meet; mirror images are folded back into the body first.
  NearbyCracks cracks_in(const Point& lower, const Point& upper) const;

 private:
  /// A part of a bond between two passages of mirrored faces, brought back into the body.
  struct Piece {
    Point begin, end;
    double share;  ///< of the bond's length
    Point bond;    ///< the whole bond, turned like the piece
  };
  /// A part of a piece inside one region.
  struct Stretch {
    Point begin, end;
    double share;  ///< of the bond's length
    int region;    ///< as from Body::region_at
    Point bond;    ///< as for the piece
  };
  void trace_cracks(const NearbyCracks& nearby, Point a, MaterialIndex material_a, Point b, MaterialIndex material_b,
                    BondPath& path) const;
  Point fold(const Point& x, const Point& within) const;
  Point off_cracks(const NearbyCracks& nearby, const Point& x) const;
  bool is_inside(const Point& x) const;
  static void append_crossings_of(const NearbyCracks& nearby, const Piece& piece, int image, BondPath& path);
  void cut_at_walls(const Point& a, const Point& b, std::vector<Piece>& pieces) const;
  void cut_at_surfaces(const std::vector<Piece>& pieces, std::vector<Stretch>& stretches) const;
  double conductivity_along(const std::vector<Stretch>& stretches, MaterialIndex a, MaterialIndex b) const;
  Point along_walls(Point normal, const Point& place) const;
  double contact_resistance(const std::vector<Stretch>& stretches) const;
  double contact_resistance(const Stretch& before, const Stretch& after, const Point& place) const;

  const Body& body_;
  Point lower_{}, upper_{};                  ///< corners of the box
  bool uniform_;                             ///< one material, nothing cut away
  std::vector<double> contact_resistances_;  ///< by two materials [m² K/W]; empty without contacts
  NearbyCracks all_;
};

/// Share of its conductance that the cracks there from the start, and elongation at the start, leave to a bond.
double standing_share(const BondPath& path);
/// How that share changes, earliest first.
void append_changes(const BondPath& path, std::vector<ShareRamp>& ramps);

}  // namespace peritherm
