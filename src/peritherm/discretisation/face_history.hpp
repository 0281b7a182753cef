#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "peritherm/discretisation/face_fit.hpp"
#include "peritherm/discretisation/mirrored_faces.hpp"

namespace peritherm {

/// What mirrored faces are made from; as for mirror_faces.
struct FaceModel {
  const Body& body;
  const Stencil& stencil;
  double horizon_ratio;
  std::span<const double> shifts;
};

/// Follows the shares of bonds while cracks grow, appear and close. Bonds are fitted to every set of complete cracks
/// that matters somewhere, and each bond goes from one set's share to the next as the tip passes it: a bond that is cut
/// where it crosses the crack, another one where light from end to end would be reflected. Cells are shared between the
/// sides from the start, so that heat capacities never change.
class FaceHistory {
 public:
  /// `end`: time beyond which nobody looks [s].
  FaceHistory(const FaceModel& model, double end);
  MirroredFaces take() const;

 private:
  using FaceShares = std::unordered_map<std::size_t, std::vector<double>>;
  /// Bonds by a point's number, fitted to some cracks.
  struct Fitted {
    std::vector<bool> there;  ///< per crack
    FaceShares shares;
  };
  /// A crack that changes bonds near a point while it grows or appears, and when it passes one of them.
  struct Passing {
    std::size_t crack;
    std::vector<const FacePiece*> tracks;  ///< its pieces near the point
    std::vector<int> parts;                ///< of the crack, near the point or the place that it is an image of
    double begin = 0.0, end = 0.0;         ///< equal: all at once
    double passed(double time, Side side) const;
  };
  /// A point of the body and the cracks near it that are on their way.
  struct Site {
    std::size_t point;   ///< among those near faces
    std::size_t number;  ///< in the body
    std::vector<Passing> passings;
  };
  void follow(double from, double to);
  Site site_of(std::size_t point) const;
  void record(const Site& site, int k, double from, double to);
  void keep(const GridIndex& index, int k, const std::vector<ShareKnot>& knots, double from);
  double share(const Site& site, int k, double time, Side side);
  const std::vector<double>* row(const Site& site, std::uint64_t passed, double time);
  void fit(const std::vector<bool>& there);
  void time_passings(Site& site, int k) const;
  std::vector<int> parts_near(std::size_t crack, const Point& place, double reach) const;
  double length_to(std::size_t point, int k, const Passing& passing) const;
  std::vector<double> epochs() const;

  FaceModel model_;
  double end_;
  OffsetTable table_;
  BondClasses classes_;
  std::vector<FacePiece> pieces_;
  std::vector<FacePiece> tracks_;     ///< of cracks that move, with those on top of others
  std::optional<FacePoints> points_;  ///< with all cracks that there will be
  std::vector<bool> moves_;           ///< per crack: it grows or appears
  double epoch_ = 0.0;                ///< begin of the time in which no faces close or open
  std::deque<Fitted> fits_;           ///< of that time
  std::vector<bool> done_;            ///< per point and entry: known for that time
  FaceShares first_;
  std::unordered_map<std::uint64_t, std::vector<ShareKnot>> later_;  ///< by point · entries + entry
  std::set<std::int64_t> cut_points_;
  double lowest_ = 1.0;
};

}  // namespace peritherm
