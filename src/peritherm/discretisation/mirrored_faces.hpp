#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "peritherm/discretisation/grid.hpp"

namespace peritherm {

struct Body;
struct Stencil;

/// What cracks with mirroring faces make of the bonds and cells of a body.
class MirroredFaces {
 public:
  /// Bonds of a point that conduct otherwise than the stencil says, by their number, ascending, and with which share.
  struct Row {
    std::span<const std::uint32_t> bonds;
    std::span<const double> shares;
    std::optional<double> find(std::uint32_t bond) const;
  };

  bool empty() const { return points_.empty(); }
  Row row(std::size_t point) const;
  /// What a bond from a point of the body to another place conducts over what the stencil says, over the volume of its
  /// beginning.
  double share_of(const Grid& grid, const Point& from, const Point& to) const;
  /// Share of a cell that belongs to a point besides what walls leave of it; 1 far from faces.
  double volume(std::size_t point) const;
  /// Numbers of the points concerned, ascending.
  std::span<const std::int64_t> points() const { return points_; }
  std::span<const double> volumes() const { return volumes_; }
  /// Number of an offset between points.
  std::uint32_t number_of(const GridIndex& offset) const;

  /// Which points could not be given mirrored bonds and keep cut ones.
  std::span<const std::int64_t> cut_points() const { return cut_points_; }
  double lowest_share() const { return lowest_; }
  double highest_share() const { return highest_; }

 private:
  friend MirroredFaces mirror_faces(const Body&, const Stencil&, double, std::span<const double>);
  int radius_ = 0;
  std::vector<std::int64_t> points_, cut_points_;
  std::vector<std::size_t> end_;
  std::vector<std::uint32_t> bonds_;
  std::vector<double> shares_, volumes_;
  double lowest_ = 1.0, highest_ = 1.0;
};

/// `shifts` per crack of the body: by how many spacings its effective tips are pulled back; negative: its bonds are
/// only cut. `horizon_ratio`: horizon over spacing.
MirroredFaces mirror_faces(const Body& body, const Stencil& stencil, double horizon_ratio,
                           std::span<const double> shifts);

}  // namespace peritherm
