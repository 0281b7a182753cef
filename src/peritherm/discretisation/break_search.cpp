#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>

#include "peritherm/base/error.hpp"
#include "peritherm/discretisation/broken_bonds.hpp"
#include "peritherm/discretisation/displacements.hpp"
#include "peritherm/discretisation/point_blocks.hpp"
#include "peritherm/discretisation/stencil.hpp"

namespace peritherm {
namespace {

constexpr double critical_slack = 1e-9;  // of the critical elongation

/// |ξ + η|² − |ξ|² in the form that keeps its digits when elongations are small.
double square_growth(const Point& bond, const Point& relative) {
  double growth = 0.0;
  for (std::size_t c = 0; c < 3; ++c) growth += relative[c] * (2.0 * bond[c] + relative[c]);
  return growth;
}

/// Where in [0, 1] the square growth, from below the critical one, comes to it; η goes from `first` to `second`.
double share_until(const Point& bond, const Point& first, const Point& second, double critical) {
  double a = 0.0, b = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double change = second[c] - first[c];
    a += change * change;
    b += change * (bond[c] + first[c]);
  }
  const double rest = critical - square_growth(bond, first);
  const double root = std::sqrt(b * b + a * rest);
  const double share = b > 0.0 ? rest / (b + root) : (root - b) / a;
  return share < 1.0 ? std::max(share, 0.0) : 1.0;
}

/// Looks at all bonds of a body, time after time.
class BreakSearch {
 public:
  BreakSearch(const Body& body, const Stencil& stencil, const BreakRule& rule)
      : body_(body),
        stencil_(stencil),
        numbers_(body.grid, stencil.radius, 0.0, {}),
        most_(rule.most),
        critical_elongation_(rule.critical_elongation),
        words_((stencil.entries.size() + 63) / 64),
        broken_(words_ * body.grid.size(), 0) {
    for (const StencilEntry& entry : stencil.entries) {
      Point bond{};
      double square = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        bond[c] = entry.offset[c] * body.grid.spacing;
        square += bond[c] * bond[c];
      }
      bonds_.push_back(bond);
      critical_.push_back(square * rule.critical_elongation * (2.0 + rule.critical_elongation));
    }
  }

  /// `before`: displacements at the time looked at last; none at first.
  void look(const Displacements* before, const Displacements& now) {
    const PointBlocks blocks(body_.grid);
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic) if (blocks.size() > 1)
    for (std::int64_t b = 0; b < blocks.size(); ++b) {
      try {
        if (count_ <= most_) search(blocks[b], before, now);
      } catch (...) {
#pragma omp critical
        failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
    if (count_ <= most_) return;
    throw Error("damage: more than " + std::to_string(most_ / 2) + " bonds break, which the memory cannot hold",
                "Choose fewer cells, a smaller horizon or a larger critical_elongation", Fault::machine);
  }

  std::vector<BrokenBonds::Break> take() { return std::move(breaks_); }

 private:
  using Breaks = std::vector<BrokenBonds::Break>;

  void search(const PointBlock& block, const Displacements* before, const Displacements& now) {
    if (!may_break(block, now)) return;
    Breaks found;
    for (int z = block.low[2]; z < block.high[2]; ++z) {
      for (int y = block.low[1]; y < block.high[1]; ++y) {
        for (int x = block.low[0]; x < block.high[0]; ++x) search_point({x, y, z}, before, now, found);
      }
    }
    if (found.empty()) return;
    count_ += found.size();
    // An exception must not leave a critical section.
    const std::scoped_lock lock(mutex_);
    breaks_.insert(breaks_.end(), found.begin(), found.end());
  }

  /// No bond grows by more than |η|, and the shortest is as long as the spacing.
  bool may_break(const PointBlock& block, const Displacements& now) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Grid& grid = body_.grid;
    Point least{infinity, infinity, infinity}, most{-infinity, -infinity, -infinity};
    const auto width = static_cast<std::size_t>(grid.dimension);
    const auto include = [&](const std::vector<double>& values, std::size_t place) {
      for (std::size_t c = 0; c < width; ++c) {
        least[c] = std::min(least[c], values[place * width + c]);
        most[c] = std::max(most[c], values[place * width + c]);
      }
    };
    GridIndex low = block.low, high = block.high;
    bool at_wall = false;
    for (int axis = 0; axis < grid.dimension; ++axis) {
      at_wall = at_wall || low[axis] <= stencil_.radius || high[axis] >= grid.count(axis) - stencil_.radius;
      low[axis] = std::max(0, low[axis] - stencil_.radius);
      high[axis] = std::min(grid.count(axis), high[axis] + stencil_.radius);
    }
    for (int z = low[2]; z < high[2]; ++z) {
      for (int y = low[1]; y < high[1]; ++y) {
        for (int x = low[0]; x < high[0]; ++x) {
          const GridIndex p{x, y, z};
          if (body_.material_of[grid.number(p)] == no_material) continue;
          include(now.points, grid.number(p));
          for (int f = 0; at_wall && f < 2 * grid.dimension; ++f) {
            const Face face = static_cast<Face>(f);
            if (p[axis_of(face)] != (is_upper(face) ? grid.count(axis_of(face)) - 1 : 0)) continue;
            include(now.walls[static_cast<std::size_t>(f)], body_.wall_place(face, p));
          }
        }
      }
    }
    double square = 0.0;
    for (std::size_t c = 0; c < width && most[c] >= least[c]; ++c)
      square += (most[c] - least[c]) * (most[c] - least[c]);
    // Bonds through faces go piece by piece, and to places beyond the outermost points.
    const double reach = at_wall ? 3.0 * (grid.dimension + 1) : 1.0;
    return reach * std::sqrt(square) >= 0.999 * critical_elongation_ * grid.spacing;
  }

  void search_point(const GridIndex& p, const Displacements* before, const Displacements& now, Breaks& found) {
    const Grid& grid = body_.grid;
    const std::size_t point = grid.number(p);
    if (body_.material_of[point] == no_material) return;
    const std::size_t half = stencil_.entries.size() / 2;
    for (std::size_t k = 0; k < stencil_.entries.size(); ++k) {
      const GridIndex& offset = stencil_.entries[k].offset;
      const GridIndex q{p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]};
      const bool inside = grid.contains(q);
      // Bonds inside are looked at from their lower end, those through faces from both.
      if ((inside && k < half) || is_marked(point, k)) continue;
      if ((inside ? body_.material_of[grid.number(q)] : body_.material_of_extended(q)) == no_material) continue;
      const DirectedBond bond = inside ? DirectedBond{p, q} : representative(body_, p, q);
      const Point relative =
          inside ? difference_inside(now, point, grid.number(q)) : relative_displacement(body_, now, bond);
      const Point vector = inside || bond.from == p ? bonds_[k] : vector_of(bond);
      if (square_growth(vector, relative) < critical_[k] * (1.0 - critical_slack)) continue;
      double time = now.time;
      if (before != nullptr) {
        const Point earlier = relative_displacement(body_, *before, bond);
        const double share = share_until(vector, earlier, relative, critical_[k]);
        time = share < 1.0 ? before->time + share * (now.time - before->time) : now.time;
      }
      mark(point, k);
      found.push_back({static_cast<std::int64_t>(point), numbers_.number_of(offset), time});
      if (!inside) continue;
      const GridIndex back{-offset[0], -offset[1], -offset[2]};
      found.push_back({static_cast<std::int64_t>(grid.number(q)), numbers_.number_of(back), time});
    }
  }

  Point difference_inside(const Displacements& now, std::size_t from, std::size_t to) const {
    Point relative{};
    const auto width = static_cast<std::size_t>(body_.grid.dimension);
    for (std::size_t c = 0; c < width; ++c) relative[c] = now.points[to * width + c] - now.points[from * width + c];
    return relative;
  }

  Point vector_of(const DirectedBond& bond) const {
    Point vector{};
    for (std::size_t c = 0; c < 3; ++c) vector[c] = (bond.to[c] - bond.from[c]) * body_.grid.spacing;
    return vector;
  }

  bool is_marked(std::size_t point, std::size_t k) const {
    return (broken_[point * words_ + k / 64] >> (k % 64) & 1U) != 0;
  }
  void mark(std::size_t point, std::size_t k) { broken_[point * words_ + k / 64] |= std::uint64_t{1} << (k % 64); }

  const Body& body_;
  const Stencil& stencil_;
  BrokenBonds numbers_;  ///< none; it numbers offsets
  std::size_t most_;
  double critical_elongation_;
  std::vector<Point> bonds_;
  std::vector<double> critical_;  ///< per bond of the stencil: |ξ + η|² − |ξ|² at which it breaks [m²]
  std::size_t words_;             ///< per point, with a bit for each bond
  std::vector<std::uint64_t> broken_;
  std::atomic<std::size_t> count_ = 0;
  std::mutex mutex_;  ///< guards breaks_
  Breaks breaks_;
};

}  // namespace

BrokenBonds find_broken_bonds(const Body& body, const Stencil& stencil, const BreakRule& rule,
                              const DisplacementSeries& series) {
  BreakSearch search(body, stencil, rule);
  Displacements before = Displacements::of(body), now = Displacements::of(body);
  bool first = true;
  while ((first || before.time < rule.end) && series(now)) {
    search.look(first ? nullptr : &before, now);
    std::swap(before, now);
    first = false;
  }
  return {body.grid, stencil.radius, rule.transmission, search.take()};
}

double bytes_of_break_search(const Grid& grid, const Stencil& stencil) {
  const auto points = static_cast<double>(grid.size());
  return points * (16.0 * grid.dimension + 8.0 * static_cast<double>((stencil.entries.size() + 63) / 64));
}

}  // namespace peritherm
