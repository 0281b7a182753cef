#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/bond_classes.hpp"
#include "peritherm/discretisation/face_pieces.hpp"
#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {

/// What lies in the way of a bond.
enum class Way : std::uint8_t {
  free,      ///< nothing: the bond may be changed
  parted,    ///< a face, or the way ahead of a tip
  exchanges  ///< faces across which heat is exchanged: what is left of it may be changed
};

/// A point near mirroring faces, and what they make of its bonds.
struct FacePoint {
  GridIndex index;
  Point place;                ///< in spacings, moved off the faces to its own side
  int frame = 0;              ///< nearest piece: the coordinates along and across the face
  double conductivity = 0.0;  ///< of its material [W/(m K)]
  bool near_tip = false;      ///< within a horizon of a tip
  bool whole = false;         ///< all of its bonds exist and conduct alike
  bool has_row = false;       ///< its bonds are to conduct as if they were mirrored
  double volume = 1.0;        ///< share of a cell that lies on its side, with the pieces of others that it takes on
  std::vector<double> cut;    ///< per entry of the stencil: share that is cut; empty if nothing is
  std::vector<Way> ways;      ///< per entry; empty if all are free
  /// Per entry: by how many spacings of slope temperatures jump on the way, along the normals of the faces that
  /// exchange heat; empty if there are none.
  std::vector<Point> jumps;

  /// Do faces change its bonds or its cell?
  bool is_touched() const { return !cut.empty() || std::abs(volume - 1.0) > 1e-12; }
  Way way(std::size_t entry) const { return ways.empty() ? Way::free : ways[entry]; }
  Point jump(std::size_t entry) const { return jumps.empty() ? Point{} : jumps[entry]; }
  double cut_of(std::size_t entry) const { return cut.empty() ? 0.0 : cut[entry]; }
};

/// The points near the faces of a body, ascending by number.
class FacePoints {
 public:
  /// `pieces` must outlive it. `horizon_ratio`: horizon over spacing.
  FacePoints(const Body& body, const Stencil& stencil, const std::vector<FacePiece>& pieces, double horizon_ratio);

  const std::vector<FacePoint>& points() const { return points_; }
  std::vector<FacePoint>& points() { return points_; }
  /// Place in points() of a point of the body; −1: far from all faces.
  std::int64_t find(const GridIndex& index) const;
  std::int64_t find(std::size_t number) const;
  const std::vector<FacePiece>& pieces() const { return pieces_; }
  /// Where bond k of a point ends, seen from its side of the faces: mirrored at each one it meets.
  Point unfolded_end(std::size_t point, int k) const;

 private:
  void collect(const Body& body, double reach);
  void fill_box();
  std::int64_t place_in_box(const GridIndex& index) const;
  Point off_faces(const Point& x, const std::vector<int>& pieces) const;
  void settle(const Body& body, std::size_t point, double horizon_ratio);
  void look_along_bonds(const Body& body, std::size_t point, double horizon_ratio);
  void share_cells(const Body& body);
  using Takers = std::vector<std::pair<std::size_t, double>>;  ///< places in points_, with weights
  std::vector<int> faces_around(std::size_t point) const;
  Takers find_takers(const Body& body, std::size_t point, const FacePiece& piece, double above) const;
  void give(const Takers& takers, double volume);
  double mean_height(const Takers& takers, const FacePiece& piece) const;
  void balance_cells(const Body& body, std::size_t point, const FacePiece& piece, double beyond, const Takers& takers);

  const Stencil& stencil_;
  const std::vector<FacePiece>& pieces_;
  const Grid grid_;
  std::vector<FacePoint> points_;
  std::vector<std::size_t> numbers_;
  GridIndex box_low_{}, box_size_{};  ///< of the points
  std::vector<std::int32_t> in_box_;  ///< place in points_, −1: none; empty if the box is too large
  std::vector<std::vector<int>> pieces_near_;
};

}  // namespace peritherm
