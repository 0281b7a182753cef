#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "peritherm/discretisation/grid.hpp"
#include "peritherm/discretisation/offset_numbers.hpp"
#include "peritherm/discretisation/share_over_time.hpp"

namespace peritherm {

struct Body;
struct Stencil;

/// What cracks with mirroring faces make of the bonds and cells of a body.
class MirroredFaces {
 public:
  /// A bond of a point that conducts otherwise than the stencil says.
  struct Bond {
    std::uint32_t number;          ///< of its offset
    double share;                  ///< of what the stencil says, at first
    std::vector<ShareKnot> later;  ///< how the share changes; none where it does not
  };
  /// A point whose bonds or cell faces change.
  struct PointBonds {
    std::int64_t point;
    double volume;            ///< share of a cell, besides what walls leave of it
    std::vector<Bond> bonds;  ///< ascending
  };

  MirroredFaces() = default;
  /// `points` ascending; `cut_points`: those that could not be given mirrored bonds and keep cut ones; `lowest_share`
  /// of bonds that no crack passes, at any time.
  MirroredFaces(int radius, const std::vector<PointBonds>& points, std::vector<std::int64_t> cut_points,
                double lowest_share);

  bool empty() const { return points_.empty(); }
  /// The numbers of a point's bonds that conduct otherwise than the stencil says, ascending, and their first shares.
  struct Row {
    std::span<const std::uint32_t> bonds;
    std::span<const double> shares;
    std::optional<double> find(std::uint32_t bond) const;
  };
  Row row(std::size_t point) const;
  /// What a bond from a point of the body to another place conducts over what the stencil says, over the volume of its
  /// beginning: at first, and how it changes.
  void look_up(const Grid& grid, const Point& from, const Point& to, double& share,
               std::vector<ShareKnot>& later) const;
  /// Share of a cell that belongs to a point besides what walls leave of it; 1 far from faces.
  double volume(std::size_t point) const;
  /// Numbers of the points concerned, ascending.
  std::span<const std::int64_t> points() const { return points_; }
  /// Number of an offset between points.
  std::uint32_t number_of(const GridIndex& offset) const { return number_of_(offset); }

  /// Which points could not be given mirrored bonds and keep cut ones.
  std::span<const std::int64_t> cut_points() const { return cut_points_; }
  double lowest_share() const { return lowest_; }
  /// Of all bonds at all times.
  double highest_share() const { return highest_; }

 private:
  std::ptrdiff_t find(std::size_t point) const;

  OffsetNumbers number_of_;
  std::vector<std::int64_t> points_, cut_points_;
  std::vector<double> volumes_;
  std::vector<std::size_t> end_;  ///< per point: end of its own in bonds_, shares_ and knot_end_
  std::vector<std::uint32_t> bonds_;
  std::vector<double> shares_;
  std::vector<std::size_t> knot_end_;
  std::vector<ShareKnot> knots_;
  double lowest_ = 1.0, highest_ = 1.0;
};

/// `shifts` per crack of the body: by how many spacings its effective tips are pulled back; negative: its bonds are
/// only cut. `horizon_ratio`: horizon over spacing. `end`: time beyond which nobody looks [s].
MirroredFaces mirror_faces(const Body& body, const Stencil& stencil, double horizon_ratio,
                           std::span<const double> shifts, double end = HUGE_VAL);

}  // namespace peritherm
