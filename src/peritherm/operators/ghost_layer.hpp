#pragma once

#include <cstdint>
#include <vector>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/held_points.hpp"
#include "peritherm/discretisation/padded_grid.hpp"
#include "peritherm/operators/follower_rows.hpp"

namespace peritherm {

/// Entries target, target + 1, … of a field that are not integrated but follow from others:
///   T[target + k] = sign · T[source + k · step] + wall_weight · wall[wall + k · wall_step]
struct GhostRun {
  std::int64_t target = 0;
  std::int64_t source = 0;
  std::int64_t wall = 0;  ///< index into the wall temperatures
  std::int32_t length = 0;
  std::int16_t boundary = -1;
  std::int8_t step = 1;
  std::int8_t wall_step = 0;
  double sign = 1.0;
  double wall_weight = 0.0;
};

/// One temperature that a boundary prescribes: a weighted sum of its profile's values at places. Beyond the edge of a
/// face the wall's temperature is continued as the neighbouring face continues the body's.
struct WallPlace {
  double weight;
  Point position;
};

/// Wall temperatures of one boundary, as they are laid out behind one another.
struct WallSlots {
  int boundary = -1;
  std::int64_t first = 0;              ///< index of its first wall temperature
  bool uniform = true;                 ///< one slot for all of the boundary
  std::vector<std::int64_t> begin{0};  ///< slots + 1, into places
  std::vector<WallPlace> places;
};

/// Fills held and fictitious points before each evaluation.
class GhostLayer {
 public:
  /// `depends_on_place` per boundary: whether its wall temperatures differ from place to place.
  GhostLayer(const Body& body, const PaddedGrid& layout, const HeldPoints& held_by,
             const std::vector<bool>& depends_on_place);

  /// Points that follow others; they must not be held. To be called once. Throws Error if one has nothing to follow.
  void add_followers(Followers followers);

  /// `fluxes`: what followers call their q [W/m²].
  void fill(ConstField wall_temperatures, ConstField fluxes, Field field) const;

  /// Ties of followers that change in time take their mean over [from, to]. True if any is another than before.
  bool average_over(double from, double to) { return followers_.average_over(from, to); }
  bool changes_within(double from, double to) const { return followers_.changes_within(from, to); }
  const Followers& followers() const { return followers_.points(); }

  const std::vector<WallSlots>& slots() const { return slots_; }
  std::size_t wall_count() const { return wall_count_; }
  const std::vector<GhostRun>& runs() const { return runs_; }
  std::size_t bytes() const;

 private:
  void add_held(const Body& body, const PaddedGrid& layout, const HeldPoints& held_by);
  void add_face(const Body& body, const PaddedGrid& layout, Face face);
  void add_line(const Body& body, const PaddedGrid& layout, Face face, const GridIndex& first, int length);
  void append(GhostRun run, const std::vector<WallPlace>& places);
  std::vector<WallPlace> places_at(const Body& body, Face face, const GridIndex& p) const;
  void fill_stage(std::size_t stage, const double* walls, double* values) const;
  void end_stage() { stage_begin_.push_back(runs_.size()); }

  std::vector<GhostRun> runs_;
  std::vector<std::size_t> stage_begin_{0};  ///< runs of a stage do not depend on one another
  FollowerRows followers_;                   ///< filled after the first stage, which fills what is held
  std::vector<WallSlots> slots_;
  std::size_t wall_count_ = 0;
};

}  // namespace peritherm
