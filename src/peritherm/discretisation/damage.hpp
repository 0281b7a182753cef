#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "peritherm/discretisation/bond_path.hpp"
#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {

/// How many bonds between points of the body cracks cut, and when; partly conducting cracks cut as well.
class CutBonds {
 public:
  /// A bond of the point that was begun last; both of its ends must be told. `time`: when the first crack passes [s].
  void add(double time);
  /// Points in ascending order.
  void begin_point(std::size_t point);
  /// Takes those of points that all come later.
  void append(const CutBonds& others);

  /// Bonds that are ever cut, each once.
  std::size_t size() const { return count_before(std::numeric_limits<double>::infinity()); }
  /// Bonds that are cut up to a time, each once.
  std::size_t count_before(double time) const;

  /// Calls visit(point, number of its bonds that are cut up to a time).
  template <class Visit>
  void for_points(double time, Visit&& visit) const {
    for (std::size_t k = 0; k < points_.size(); ++k) visit(static_cast<std::size_t>(points_[k]), cut_at(k, time));
  }

  std::size_t bytes() const;

 private:
  std::size_t cut_at(std::size_t k, double time) const;

  std::vector<std::int64_t> points_;     ///< with a bond that is cut
  std::vector<std::uint32_t> standing_;  ///< per point: bonds cut from the start
  std::vector<std::int64_t> end_;        ///< per point: end of its own in later_
  std::vector<double> later_;            ///< times when bonds are cut [s]
};

/// Follows all bonds near cracks.
CutBonds find_cut_bonds(const Body& body, const Stencil& stencil);

/// Pairs of points of the body within each other's reach, cut ones included.
std::size_t count_bonds(const Body& body, const Stencil& stencil);

/// Share of each point's bonds that are cut at a time, 0 to 1; NaN where cut away.
std::vector<double> damage(const Body& body, const Stencil& stencil, const CutBonds& cuts, double time);

}  // namespace peritherm
