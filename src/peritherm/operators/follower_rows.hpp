#pragma once

#include <vector>

#include "peritherm/discretisation/followers.hpp"

namespace peritherm {

/// What stands in for a fictitious point: T = sign · T[entry] + Σ wall_weight · wall.
struct Stand {
  std::int64_t entry = 0;
  double sign = 1.0;
  struct Wall {
    std::int64_t wall;  ///< index into the wall temperatures
    double weight;
  };
  std::vector<Wall> walls;
};

/// Fills points that follow others. Where followers of two faces meet, they follow one another: their relations are
/// swept so often that what is left of any start is below rounding; the weights are never negative and sum to at most
/// 1, so how often is known beforehand.
class FollowerRows {
 public:
  FollowerRows() = default;
  /// `stands`: per neighbour of the followers. Throws Error if a follower has nothing to follow.
  FollowerRows(Followers followers, const std::vector<Stand>& stands);

  bool empty() const { return followers_.entries.empty(); }
  const Followers& points() const { return followers_; }

  /// Everything but followers and fictitious points must be filled.
  void fill(ConstField walls, ConstField fluxes, Field field) const;

  /// Gains that change in time take their mean over [from, to]. True if any is another than before.
  bool average_over(double from, double to);
  bool changes_within(double from, double to) const { return followers_.cuts.changes_within(from, to); }

  std::size_t bytes() const;

 private:
  struct WallTerm {
    BondIndex gain;
    std::int64_t wall;
    double weight;
  };
  double value(std::size_t row, ConstField walls, ConstField fluxes, const double* field) const;
  void sort_rows();
  void weigh();
  void count_sweeps();

  Followers followers_;
  std::vector<double> signs_;             ///< per gain: 1, −1 or 0
  std::vector<WallTerm> wall_terms_;      ///< row by row
  std::vector<BondIndex> wall_begin_;     ///< rows + 1
  std::vector<double> resistances_;       ///< 1 / Σ g per row [m² K/W]
  std::vector<std::uint32_t> apart_;      ///< rows that follow no follower
  std::vector<std::uint32_t> together_;   ///< the others
  std::vector<std::int64_t> references_;  ///< per row: an entry to measure differences from; −1: none is left as it is
  int sweeps_ = 0;
};

}  // namespace peritherm
