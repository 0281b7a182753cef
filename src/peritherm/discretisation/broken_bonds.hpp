#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "peritherm/base/field.hpp"
#include "peritherm/discretisation/grid.hpp"
#include "peritherm/discretisation/offset_numbers.hpp"

namespace peritherm {

struct Body;
struct Displacements;
struct Stencil;

/// Bonds of the points of a body that break for good because they were stretched too far, and when.
class BrokenBonds {
 public:
  /// One direction of a bond.
  struct Break {
    std::int64_t point;  ///< its beginning
    std::uint32_t bond;  ///< its offset, see `number_of`
    double time;         ///< [s]; 0 or less: broken from the start
  };
  /// The points of a body, and which of their bonds are broken at what times.
  struct Row {
    std::span<const std::uint32_t> bonds;  ///< ascending
    std::span<const double> times;
    std::optional<double> find(std::uint32_t bond) const;
  };

  BrokenBonds() = default;
  /// `transmission`: share of its conductance that a broken bond keeps. `breaks`: each once, in any order.
  BrokenBonds(const Grid& grid, int radius, double transmission, std::vector<Break> breaks);

  bool empty() const { return points_.empty(); }
  double transmission() const { return transmission_; }

  /// The bonds of a point that break; none for most points.
  Row row(std::size_t point) const;
  /// Number of an offset between points.
  std::uint32_t number_of(const GridIndex& offset) const { return number_of_(offset); }
  /// When the bond from a point of the body to another place, which may lie beyond mirrored faces, breaks [s].
  std::optional<double> time_of(const Point& from, const Point& to) const;

  /// Numbers of the points with a bond that breaks, ascending.
  std::span<const std::int64_t> points() const { return points_; }
  /// Directed bonds that break.
  std::size_t size() const { return times_.size(); }
  std::size_t bytes() const { return points_.size() * 16 + bonds_.size() * 12; }
  /// How many different times after `from` and before `to` a bond breaks at.
  std::size_t count_times(double from, double to) const;

 private:
  GridIndex index_at(const Point& place) const;

  Grid grid_;
  OffsetNumbers number_of_;
  double transmission_ = 0.0;
  std::vector<std::int64_t> points_;
  std::vector<std::size_t> end_;  ///< per point: end of its own in bonds_ and times_
  std::vector<std::uint32_t> bonds_;
  std::vector<double> times_;
};

/// Fills the displacements of the next time, which must be later than the last; false if there are no more.
using DisplacementSeries = std::function<bool(Displacements&)>;

/// When a bond breaks, and what that leaves of it.
struct BreakRule {
  double critical_elongation;  ///< e₀; a bond breaks when (|ξ + η| − |ξ|)/|ξ| reaches it [bobaru2010, eqs. 13 to 15]
  double transmission;         ///< α [bobaru2012, eq. 10]
  double end;                  ///< time beyond which nobody looks [s]
  std::size_t most;            ///< directed bonds; more are refused
};

/// Looks at all bonds of a body at each time of a series. Between two times displacements are linear in time, hence
/// |ξ + η(t)|² is a convex parabola: it is largest at one of the two, so that no break is missed, and the time of a
/// break is the root of a quadratic equation. Bonds within 1e-9 e₀ of the critical elongation break, so that rounding
/// parts no bonds that are alike. Throws Error (Fault::machine) if more bonds break than `rule.most`.
BrokenBonds find_broken_bonds(const Body& body, const Stencil& stencil, const BreakRule& rule,
                              const DisplacementSeries& series);

/// Memory for each directed bond that breaks, with what schedules and corrections keep of it [B].
inline constexpr double bytes_per_broken_bond = 128.0;

/// Memory while bonds are looked at, besides those that break [B].
double bytes_of_break_search(const Grid& grid, const Stencil& stencil);

}  // namespace peritherm
