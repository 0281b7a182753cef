#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "peritherm/base/field.hpp"

namespace peritherm {

struct Body;
struct Grid;

/// A plane piece of a crack whose faces mirror, in units of the spacing: a point of the grid stands at its indices.
class FacePiece {
 public:
  /// How much a piece cuts of a bond, 0 to 1, and where on the way from a to b.
  struct Cut {
    double share = 0.0;
    double place = 2.0;
  };

  /// 1-D: `corners` holds the position; 2-D: both ends; 3-D: the corners, or the centre if `radius` is not 0. `joined`
  /// per end (2-D) or edge (3-D, from corner k to the next): no tip. `shift`: by how much tips are pulled back.
  FacePiece(int dimension, std::vector<Point> corners, const Point& normal, double radius, std::vector<bool> joined,
            double shift, double strength = 1.0, double exchange = 0.0);

  double height(const Point& x) const;
  const Point& normal() const { return normal_; }
  double shift() const { return shift_; }
  /// Share of a bond's conductance that the piece takes away if nothing passes the gap.
  double strength() const { return strength_; }
  /// By how many spacings of slope temperatures jump because the gap resists; 0 if nothing passes it, or if heat passes
  /// in other ways as well. `conductivity` around the crack.
  double jump(double conductivity) const;
  /// Two such gaps, one behind the other.
  void double_gap() { exchange_ *= 0.5; }
  /// Unit vectors along the piece: none in 1-D, one in 2-D, two in 3-D.
  const std::array<Point, 2>& tangents() const { return tangents_; }

  /// What the piece with its effective tips cuts of the bond a–b: at tips a ramp one spacing wide. `conductivity`: of
  /// the bond.
  Cut cut(const Point& a, const Point& b, double conductivity) const;
  /// Does a–b meet the piece, or its continuation up to `ahead` before a tip?
  bool meets(const Point& a, const Point& b, double ahead) const;
  double distance_to(const Point& x) const;
  /// Distance to the nearest tip or front; infinite if there is none.
  double distance_to_tip(const Point& x) const;
  Point mirrored(const Point& x) const;
  /// Share to which the piece with its effective tips lies below or above x.
  double share_at(const Point& x) const;

  /// The image across the wall at `wall` along an axis.
  FacePiece image(int axis, double wall) const;
  /// Number of the crack in the body.
  void set_crack(std::size_t crack) { crack_ = crack; }
  std::size_t crack() const { return crack_; }
  /// The piece acts inside this box only: beyond it lie its images.
  void confine(const Point& lower, const Point& upper);
  /// Is x on the piece, or as good as on it?
  bool touches(const Point& x, double tolerance) const;
  /// Lower and upper corner of a box around it.
  std::array<Point, 2> bounds() const;
  /// 2-D: ends of the piece that are tips, and the direction in which the crack would go on there.
  struct Tip {
    Point place, direction;
    bool at_end;  ///< of the piece, not at its beginning
  };
  std::vector<Tip> tips() const;

 private:
  /// Where a–b crosses the plane; false if it does not, or outside the box.
  bool crosses_plane(const Point& a, const Point& b, double& place, Point& x) const;
  /// Depth of a point of the plane inside the piece, counted from tips and fronts only; −∞ beyond joined ends.
  double depth(const Point& x) const;
  double depth_in_polygon(double along, double across) const;
  double distance_to_edges(double along, double across, bool fronts_only) const;
  /// Share of 1 that is cut at a depth; at tips a ramp one spacing wide.
  double ramp(double depth) const;
  /// Share that is cut at a place of the plane.
  double share_on(const Point& x) const;
  bool is_in_box(const Point& x) const;

  int dimension_;
  std::vector<Point> corners_;
  Point normal_;
  std::array<Point, 2> tangents_{};
  double radius_;
  double length_ = 0.0;  ///< 2-D
  std::size_t crack_ = 0;
  std::vector<bool> joined_;
  double shift_, strength_;
  double exchange_;                                   ///< coefficient of the gap times the spacing [W/(m K)]
  std::vector<std::array<double, 2>> plane_corners_;  ///< 3-D
  Point lower_, upper_;                               ///< the box in which it acts
};

/// How far [spacings] corners of a crack may lie beside the segment that stands for them: fits lose accuracy where
/// corners are nearer to each other than a spacing, and arcs of many short segments are then as good as of few.
inline constexpr double straight_within = 0.02;

/// Which cracks of a body are looked at, and how.
struct CrackChoice {
  std::vector<bool> there{};  ///< per crack; empty: all
  double time = 0.0;          ///< at which faces touch or not [s]
  bool touching = true;       ///< cracks that are closed at that time conduct; otherwise all are open
  bool repeats = false;       ///< what lies on top of others, too
};

/// The pieces of complete mirroring cracks of a body, with their images across walls within
/// `reach` spacings. `shifts` per crack, in spacings; negative: the crack does not mirror. Ends on walls, on other
/// cracks and at kinks are no tips.
std::vector<FacePiece> make_face_pieces(const Body& body, std::span<const double> shifts, double reach,
                                        const CrackChoice& choice);

/// Index coordinates of a place [m]: those of a point of the grid are its indices.
Point in_spacings(const Grid& grid, const Point& x);
inline Point in_spacings(const GridIndex& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace peritherm
