#include "peritherm/reduction/retained_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {
namespace {

constexpr const char* retained_key = "reduction.retained";

std::string place_text(const Grid& grid, const Point& place) {
  std::vector<std::string> words;
  for (int axis = 0; axis < grid.dimension; ++axis) {
    // Sums of spacings leave rounding where 0 is meant.
    words.push_back(fmt::format("{:.6g}", std::abs(place[axis]) < 1e-9 * grid.spacing ? 0.0 : place[axis]));
  }
  return "(" + join(words) + ")";
}

/// Marks points that are selected, and says what is wrong with the choice.
class RetainedSelection {
 public:
  RetainedSelection(const Grid& grid, const std::vector<bool>& present)
      : grid_(grid), present_(present), selected_(grid.size(), false) {}

  void add_pattern(const std::vector<int>& every) {
    if (every.size() != 1 && every.size() != static_cast<std::size_t>(grid_.dimension)) {
      refuse(".every",
             "needs one number, or one for each of the " + std::to_string(grid_.dimension) + " axes. Got " +
                 std::to_string(every.size()),
             "[2] retains every second point along each axis");
      return;
    }
    GridIndex steps{1, 1, 1};
    for (int axis = 0; axis < grid_.dimension; ++axis)
      steps[axis] = every.size() == 1 ? every[0] : every[static_cast<std::size_t>(axis)];
    if (*std::min_element(steps.begin(), steps.end()) < 1) {
      refuse(".every", "must be 1 or more", "2 retains every second point");
      return;
    }
    for_present([&](std::size_t point, const GridIndex& p) {
      if (p[0] % steps[0] == 0 && p[1] % steps[1] == 0 && p[2] % steps[2] == 0) selected_[point] = true;
    });
  }

  void add_region(const RetainedRegion& region, std::size_t number) {
    const std::string key = ".region." + std::to_string(number);
    const std::string fault = find_fault(region.shape, grid_.dimension);
    if (!fault.empty()) {
      refuse(key + ".shape", fault, {});
      return;
    }
    const int every = std::max(1, region.every);
    std::size_t count = 0;
    for_present([&](std::size_t point, const GridIndex& p) {
      if (p[0] % every != 0 || p[1] % every != 0 || p[2] % every != 0) return;
      if (!contains(region.shape, grid_.position(p), 1e-9 * grid_.spacing)) return;
      selected_[point] = true;
      ++count;
    });
    if (count == 0) {
      refuse(key, "holds no point that it could retain",
             "Points stand " + shortest(grid_.spacing) + " m apart; a region of 'every = 1' takes all that lie in it");
    }
  }

  void add_place(const Coordinates& place, std::size_t number) {
    const std::string key = ".points." + std::to_string(number);
    if (place.size() != static_cast<std::size_t>(grid_.dimension)) {
      refuse(key, "needs " + std::to_string(grid_.dimension) + " coordinates. Got " + std::to_string(place.size()), {});
      return;
    }
    const Point x = to_point(place);
    GridIndex p{};
    bool inside = true;
    for (int axis = 0; axis < grid_.dimension; ++axis) {
      const double depth = (x[axis] - grid_.origin[axis]) / grid_.spacing;
      inside = inside && depth >= -1e-9 && depth <= grid_.cells[axis] + 1e-9;
      if (!inside) break;
      p[axis] = std::clamp(static_cast<int>(std::lround(depth - grid_.first_depth())), 0, grid_.count(axis) - 1);
    }
    const std::size_t point = inside ? grid_.number(p) : 0;
    if (!inside) {
      Point end = grid_.origin;
      for (int axis = 0; axis < grid_.dimension; ++axis) end[axis] += grid_.length(axis);
      refuse(key, place_text(grid_, x) + " lies outside the body",
             "The body reaches from " + place_text(grid_, grid_.origin) + " to " + place_text(grid_, end));
    } else if (!present_[point]) {
      refuse(key, place_text(grid_, x) + " lies where the body is cut away", "Choose a place in the material");
    } else {
      selected_[point] = true;
    }
  }

  /// Selection sampling [knuth1997, sec. 3.4.2, algorithm S].
  void add_share(double share, int seed) {
    auto left = static_cast<std::uint64_t>(std::count(present_.begin(), present_.end(), true));
    auto needed = static_cast<std::uint64_t>(std::llround(share * static_cast<double>(left)));
    std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
    for (std::size_t point = 0; point < present_.size(); ++point) {
      if (!present_[point]) continue;
      if (engine() % left < needed) {
        selected_[point] = true;
        --needed;
      }
      --left;
    }
  }

  void refuse(const std::string& key, const std::string& problem, const std::string& hint) {
    issues_.push_back({{{}, retained_key + key, 0, 0}, problem, hint});
  }
  void throw_issues() const {
    if (!issues_.empty()) throw Error(issues_);
  }
  const std::vector<bool>& selected() const { return selected_; }

 private:
  template <class Visit>
  void for_present(const Visit& visit) const {
    for (std::size_t point = 0; point < present_.size(); ++point) {
      if (present_[point]) visit(point, grid_.index(point));
    }
  }

  const Grid& grid_;
  const std::vector<bool>& present_;
  std::vector<bool> selected_;
  std::vector<Issue> issues_;
};

/// Pieces of a body, by what exchanges heat.
class Pieces {
 public:
  explicit Pieces(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

/// The box around some points, as a user would look for it.
std::string box_text(const Grid& grid, const std::vector<std::int64_t>& points) {
  Point low = grid.position(grid.index(static_cast<std::size_t>(points.front())));
  Point high = low;
  for (const std::int64_t point : points) {
    const Point x = grid.position(grid.index(static_cast<std::size_t>(point)));
    for (int axis = 0; axis < grid.dimension; ++axis) {
      low[axis] = std::min(low[axis], x[axis]);
      high[axis] = std::max(high[axis], x[axis]);
    }
  }
  if (points.size() == 1) return "a point at " + place_text(grid, low);
  return std::to_string(points.size()) + " points between " + place_text(grid, low) + " and " + place_text(grid, high);
}

/// Truncated points by piece, of pieces that nothing decides the temperature of.
std::vector<std::vector<std::int64_t>> find_loose_pieces(const SparseHeat& heat,
                                                         const std::vector<std::int32_t>& truncated) {
  constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  std::vector<std::size_t> number_of(heat.size(), nowhere);
  for (std::size_t k = 0; k < truncated.size(); ++k) number_of[static_cast<std::size_t>(truncated[k])] = k;
  Pieces pieces(truncated.size());
  std::vector<bool> anchored(truncated.size(), false);
  const SparseMatrix& matrix = heat.conductances;
  for (std::size_t k = 0; k < truncated.size(); ++k) {
    const auto i = static_cast<std::size_t>(truncated[k]);
    if (heat.losses[i] != 0.0) anchored[k] = true;
    for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n) {
      const auto j = static_cast<std::size_t>(matrix.column_of[n]);
      if (j == i || matrix.values[n] == 0.0) continue;
      if (number_of[j] == nowhere) {
        anchored[k] = true;
      } else {
        pieces.join(k, number_of[j]);
      }
    }
  }
  std::vector<bool> piece_anchored(truncated.size(), false);
  for (std::size_t k = 0; k < truncated.size(); ++k) {
    if (anchored[k]) piece_anchored[pieces.find(k)] = true;
  }
  std::vector<std::vector<std::int64_t>> loose(truncated.size());
  for (std::size_t k = 0; k < truncated.size(); ++k) {
    const std::size_t piece = pieces.find(k);
    if (!piece_anchored[piece]) loose[piece].push_back(heat.points[static_cast<std::size_t>(truncated[k])]);
  }
  std::erase_if(loose, [](const auto& piece) { return piece.empty(); });
  return loose;
}

}  // namespace

RetainedSet select_retained(const RetainedPoints& choice, const Grid& grid, const std::vector<bool>& present,
                            const std::vector<bool>& is_free) {
  RetainedSelection selection(grid, present);
  const bool nothing_said = !choice.every && choice.regions.empty() && choice.points.empty() && !choice.share;
  if (nothing_said) selection.add_pattern({2});
  if (choice.every) selection.add_pattern(*choice.every);
  for (std::size_t k = 0; k < choice.regions.size(); ++k) selection.add_region(choice.regions[k], k);
  for (std::size_t k = 0; k < choice.points.size(); ++k) selection.add_place(choice.points[k], k);
  if (choice.share) selection.add_share(*choice.share, choice.seed);
  RetainedSet set;
  std::size_t held = 0;
  for (std::size_t point = 0; point < grid.size(); ++point) {
    if (!selection.selected()[point]) continue;
    if (is_free[point]) {
      set.points.push_back(static_cast<std::int64_t>(point));
    } else {
      ++held;
    }
  }
  if (set.points.empty()) {
    selection.refuse("", held > 0 ? "selects held points only" : "selects no point",
                     "Retain more: every = [2] takes every second point along each axis");
  }
  selection.throw_issues();
  std::size_t held_in_all = 0;
  for (std::size_t point = 0; point < grid.size(); ++point) held_in_all += present[point] && !is_free[point] ? 1 : 0;
  if (held_in_all > 0) {
    set.notes.push_back("held points follow their boundary and are no unknowns: " + std::to_string(held_in_all) +
                        " in all, " + std::to_string(held) + " of them among the points to retain");
  }
  return set;
}

void require_anchors(const SparseHeat& heat, const std::vector<std::int32_t>& truncated, const Grid& grid) {
  const std::vector<std::vector<std::int64_t>> loose = find_loose_pieces(heat, truncated);
  if (loose.empty()) return;
  std::vector<std::string> places;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, loose.size()); ++k) places.push_back(box_text(grid, loose[k]));
  if (loose.size() > places.size()) places.push_back(std::to_string(loose.size() - places.size()) + " more");
  const Point inside = grid.position(grid.index(static_cast<std::size_t>(loose.front().front())));
  const std::string what = loose.size() == 1 ? "a piece" : "pieces";
  throw Error(
      {Issue{{{}, retained_key, 0, 0},
             "leaves " + what +
                 " of the body without any retained point, and nothing decides the temperature: " + join(places, "; "),
             "Cracks or voids cut it off. Retain a point of each piece, such as the one at " +
                 place_text(grid, inside) + " [m]"}});
}

}  // namespace peritherm
