#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "peritherm/discretisation/bond_classes.hpp"
#include "peritherm/discretisation/face_points.hpp"

namespace peritherm {

/// s, all products of s, and d² differences of a bond: 1 in 1-D, 3 in 2-D, 6 in 3-D; where heat is exchanged across the
/// gap, behind them the difference of a temperature with slope 1 across the face and the jump that belongs to it.
using FaceMoments = std::array<double, 7>;

/// The coordinates of a point's face: s along it, d across.
struct FaceFrame {
  int dimension = 1;
  Point normal{};
  std::array<Point, 2> tangents{};
  double height = 0.0;  ///< d of the point
  double jump = 0.0;    ///< of a temperature with slope 1 across the face, in spacings; 0: insulated

  int count() const { return dimension == 3 ? 6 : dimension == 2 ? 3 : 1; }
  /// Does the bulk conduct this moment, as it does s² and d²?
  bool is_square(int c) const { return c < count() && (dimension == 3 ? c >= 2 && c != 4 : c >= count() - dimension); }
  /// Moments of a step; `jumps` as for the bond.
  FaceMoments operator()(const Point& step, const Point& jumps) const;
};

/// The linear equations of the fit: moments of the bonds of each point with a row, over classes of bonds, scaled.
class FaceSystem {
 public:
  FaceSystem(const Body& body, const Stencil& stencil, const FacePoints& points);

  std::size_t class_count() const { return strength_.size(); }
  std::size_t moments() const { return static_cast<std::size_t>(moments_); }
  /// Does heat pass between the faces?
  bool exchanges() const { return exchanges_; }
  /// Is unknown n that of a jump across a gap?
  bool is_jump(std::size_t n) const { return exchanges_ && (n + 1) % moments() == 0; }
  /// By how much of the bulk's second moment heat that passes between points on both sides of a gap, and not between
  /// its faces, disturbs row r: about twice spacing × coefficient / conductivity; 0 beside insulated faces.
  double disturbance(std::size_t r) const { return rows_[r].frame.jump > 0.0 ? 2.0 / rows_[r].frame.jump : 0.0; }
  /// Number of row r's point in FacePoints.
  std::size_t point_of(std::size_t r) const { return rows_[r].point; }

  /// Right sides, over the scales of their rows; row by row, moment by moment.
  const std::vector<double>& target() const { return target_; }
  /// What a scaled residual of one means in the bulk's second moment, 2.
  double scale(std::size_t n) const { return scale_[n] * rows_[n / moments()].wall_share; }
  /// Elastic terms that keep the fit solvable where rows contradict each other.
  const std::vector<double>& elasticity() const { return elasticity_; }

  /// Conductance of a class before the fit as far as it may change, and how many bonds it stands for.
  double weight(std::size_t e) const;
  double times(std::size_t e) const { return times_[e]; }
  /// A class's share before the fit, and what is added to it if the part that may change doubles.
  double base(std::size_t e) const { return base_[e]; }
  double strength(std::size_t e) const { return strength_[e]; }

  /// result[e] = Σ_r K_re λ_r / times(e)
  void gather(const std::vector<double>& lambda, std::vector<double>& result) const;
  /// result = K values
  void scatter(const std::vector<double>& values, std::vector<double>& result) const;

  /// One bond of a class as its row sees it.
  struct Member {
    std::uint32_t row;
    std::int32_t entry;  ///< of the stencil
  };
  std::span<const Member> members(std::size_t e) const {
    return std::span(members_).subspan(member_begin_[e], member_begin_[e + 1] - member_begin_[e]);
  }
  /// Column of K that a member makes, over the scales of its row.
  const FaceMoments& scaled_moments(const Member& member) const {
    return scaled_[static_cast<std::size_t>(&member - members_.data())];
  }

  const BondClasses& classes() const { return classes_; }

 private:
  struct Row {
    std::size_t point;
    FaceFrame frame;
    std::size_t begin;  ///< into bonds_
    double wall_share;  ///< of its cell
  };
  struct RowBond {
    std::int32_t number;  ///< of the class
    std::int32_t entry;
  };

  void add_row(const Body& body, std::size_t n);
  std::int32_t class_of(std::size_t n, int k);
  void find_members();
  void scale_rows();
  void scale_members();
  std::size_t row_end(std::size_t r) const { return r + 1 < rows_.size() ? rows_[r + 1].begin : bonds_.size(); }
  void replace_slopes(const Row& row, int entry, double cut, FaceMoments& lost) const;
  FaceMoments moments_of(const Row& row, int entry) const;

  const Stencil& stencil_;
  const FacePoints& points_;
  OffsetTable table_;
  BondClasses classes_;
  std::vector<double> weights_;  ///< per entry of the stencil, Σ ½ w ξ_x² = 1
  int moments_ = 1;
  bool exchanges_ = false;
  std::vector<Row> rows_;
  std::vector<RowBond> bonds_;
  std::unordered_map<std::uint64_t, std::int32_t> number_of_;
  std::vector<double> base_, strength_, times_;
  std::vector<std::size_t> member_begin_;
  std::vector<Member> members_;
  std::vector<FaceMoments> scaled_;  ///< per member
  std::vector<double> target_, scale_, elasticity_;
};

}  // namespace peritherm
