#include <algorithm>
#include <array>
#include <cmath>

#include "peritherm/discretisation/body.hpp"
#include "peritherm/discretisation/face_pieces.hpp"
#include "peritherm/geometry/polyline.hpp"
#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

constexpr double same_corner = 1e-6;  ///< spacings

/// A piece before it is known which of its ends are tips.
struct PieceDraft {
  std::size_t crack;
  std::vector<Point> corners;
  Point normal;
  double radius;
  std::vector<bool> joined;
};

constexpr double same_place = 1e-3;  ///< spacings; no grid tells such places apart

bool are_one(const Point& a, const Point& b) { return length(difference(a, b)) < same_place; }

/// What of a segment or polygon lies inside the box: Sutherland and Hodgman's clip, wall by wall.
std::vector<Point> clipped_to_box(const Body& body, std::vector<Point> corners, bool closed) {
  for (int face = 0; face < 2 * body.grid.dimension; ++face) {
    const int axis = face / 2;
    const double wall = face % 2 == 0 ? -body.grid.first_depth() : body.grid.cells[axis] - body.grid.first_depth();
    const auto depth = [&](const Point& x) { return face % 2 == 0 ? x[axis] - wall : wall - x[axis]; };
    std::vector<Point> inside;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (depth(corners[k]) >= 0.0) inside.push_back(corners[k]);
      if (!closed && k + 1 == corners.size()) break;
      const Point& next = corners[(k + 1) % corners.size()];
      const double here = depth(corners[k]), there = depth(next);
      if ((here >= 0.0) == (there >= 0.0)) continue;
      inside.push_back(between(corners[k], next, here / (here - there)));
    }
    corners = std::move(inside);
  }
  const auto same = [](const Point& a, const Point& b) { return length(difference(a, b)) < same_corner; };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  while (closed && corners.size() > 1 && same(corners.front(), corners.back())) corners.pop_back();
  return corners;
}

void append_drafts(const Body& body, std::size_t crack, std::vector<PieceDraft>& drafts) {
  const CrackSurface& surface = body.cracks[crack];
  std::vector<Point> corners = surface.corners(HUGE_VAL);
  for (Point& corner : corners) corner = in_spacings(body.grid, corner);
  if (corners.empty()) return;
  const double radius = surface.radius(HUGE_VAL) / body.grid.spacing;
  if (body.grid.dimension != 2) {
    if (body.grid.dimension == 3 && radius == 0.0) corners = clipped_to_box(body, std::move(corners), true);
    if (body.grid.dimension == 3 && radius == 0.0 && corners.size() < 3) return;
    std::vector<bool> joined(corners.size(), false);
    drafts.push_back({crack, std::move(corners), surface.normal_of(0), radius, std::move(joined)});
    return;
  }
  const bool closed = are_one(corners.front(), corners.back());
  corners.erase(std::unique(corners.begin(), corners.end(), are_one), corners.end());
  corners = simplified(corners, straight_within);
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    std::vector<Point> segment = clipped_to_box(body, {corners[k], corners[k + 1]}, false);
    if (segment.size() < 2 || are_one(segment[0], segment[1])) continue;
    const Point along = unit_vector(difference(corners[k + 1], corners[k]));
    drafts.push_back({crack,
                      std::move(segment),
                      {-along[1], along[0], 0.0},
                      0.0,
                      {k > 0 || closed, k + 2 < corners.size() || closed}});
  }
}

/// What of a segment another one does not cover.
std::vector<PieceDraft> uncovered(const PieceDraft& draft, const PieceDraft& other) {
  const Point along = unit_vector(difference(draft.corners[1], draft.corners[0]));
  const double whole = length(difference(draft.corners[1], draft.corners[0]));
  std::array<double, 2> covered{};
  for (std::size_t end = 0; end < 2; ++end) {
    covered[end] = dot(difference(other.corners[end], draft.corners[0]), along);
    if (!(std::abs(dot(difference(draft.corners[end], other.corners[0]), other.normal)) < same_place)) return {draft};
  }
  const double begin = std::clamp(std::min(covered[0], covered[1]), 0.0, whole);
  const double end = std::clamp(std::max(covered[0], covered[1]), 0.0, whole);
  if (end - begin < same_place) return {draft};
  std::vector<PieceDraft> left;
  if (begin > same_place) {
    left.push_back(draft);
    left.back().corners[1] = added(draft.corners[0], scaled(along, begin));
    left.back().joined[1] = true;
  }
  if (end < whole - same_place) {
    left.push_back(draft);
    left.back().corners[0] = added(draft.corners[0], scaled(along, end));
    left.back().joined[0] = true;
  }
  return left;
}

bool repeats(const PieceDraft& draft, const PieceDraft& other) {
  return std::abs(draft.radius - other.radius) < same_place &&
         std::abs(std::abs(dot(draft.normal, other.normal)) - 1.0) < 1e-9 &&
         std::is_permutation(draft.corners.begin(), draft.corners.end(), other.corners.begin(), other.corners.end(),
                             are_one);
}

/// Where cracks lie on top of each other, the one that conducts least counts; of plane polygons if they are the same.
std::vector<PieceDraft> without_repeats(const Body& body, std::span<const double> shifts,
                                        const std::vector<double>& blocked, std::vector<PieceDraft> drafts) {
  std::stable_sort(drafts.begin(), drafts.end(),
                   [&](const PieceDraft& a, const PieceDraft& b) { return blocked[a.crack] > blocked[b.crack]; });
  std::vector<PieceDraft> kept;
  for (const PieceDraft& draft : drafts) {
    std::vector<PieceDraft> parts{draft};
    for (std::size_t n = 0, known = kept.size(); n < known && shifts[draft.crack] >= 0.0; ++n) {
      if (shifts[kept[n].crack] < 0.0) continue;
      std::vector<PieceDraft> left;
      for (const PieceDraft& part : parts) {
        if (body.grid.dimension == 2) {
          for (PieceDraft& one : uncovered(part, kept[n])) left.push_back(std::move(one));
        } else if (!repeats(part, kept[n])) {
          left.push_back(part);
        }
      }
      parts = std::move(left);
    }
    kept.insert(kept.end(), parts.begin(), parts.end());
  }
  return kept;
}

/// Where an end is on a wall, on another crack or beyond, the crack has no tip.
class TipSearch {
 public:
  TipSearch(const Body& body, const std::vector<PieceDraft>& drafts, std::span<const double> shifts)
      : body_(body), drafts_(drafts), shifts_(shifts) {
    for (const PieceDraft& draft : drafts) {
      pieces_.emplace_back(body.grid.dimension, draft.corners, draft.normal, draft.radius, draft.joined, 0.0);
    }
    for (int axis = 0; axis < body.grid.dimension; ++axis) {
      lower_[axis] = -body.grid.first_depth();
      upper_[axis] = body.grid.cells[axis] - body.grid.first_depth();
    }
  }

  std::vector<bool> joined(std::size_t n) const {
    std::vector<bool> found = drafts_[n].joined;
    const std::vector<Point>& corners = drafts_[n].corners;
    for (std::size_t k = 0; k < found.size() && body_.grid.dimension > 1; ++k) {
      if (body_.grid.dimension == 2) {
        found[k] = found[k] || ends_on_something(n, corners[k]) || overshoots(n, corners[k], corners[1 - k]);
        continue;
      }
      const Point& next = corners[(k + 1) % corners.size()];
      found[k] = drafts_[n].radius == 0.0 && ends_on_something(n, corners[k]) && ends_on_something(n, next) &&
                 ends_on_something(n, between(corners[k], next, 0.5));
    }
    return found;
  }

  const Point& lower() const { return lower_; }
  const Point& upper() const { return upper_; }

 private:
  bool ends_on_something(std::size_t n, const Point& x) const {
    for (int axis = 0; axis < body_.grid.dimension; ++axis) {
      if (x[axis] < lower_[axis] + same_place || x[axis] > upper_[axis] - same_place) return true;
    }
    for (std::size_t other = 0; other < pieces_.size(); ++other) {
      if (!are_neighbours(n, other) && pieces_[other].touches(x, same_place)) return true;
    }
    return false;
  }

  /// Pieces of one polyline that share a corner, or are the same.
  bool are_neighbours(std::size_t n, std::size_t other) const {
    const std::size_t between_them = n > other ? n - other : other - n;
    return between_them == 0 || (between_them == 1 && drafts_[n].crack == drafts_[other].crack);
  }

  /// An end that juts out beyond another piece by less than tips are pulled back by would open the junction.
  bool overshoots(std::size_t n, const Point& end, const Point& inner) const {
    const double reach = std::max(0.0, shifts_[drafts_[n].crack]) + 1.0;
    const Point before = between(end, inner, std::min(1.0, reach / length(difference(inner, end))));
    for (std::size_t other = 0; other < pieces_.size(); ++other) {
      if (!are_neighbours(n, other) && pieces_[other].meets(before, end, 0.0)) return true;
    }
    return false;
  }

  const Body& body_;
  const std::vector<PieceDraft>& drafts_;
  std::span<const double> shifts_;
  std::vector<FacePiece> pieces_;
  Point lower_{}, upper_{};
};

/// Adds what mirrors show of the pieces, axis by axis; a piece in the wall itself lies on its image.
void append_images(const Body& body, const TipSearch& box, double reach, std::vector<FacePiece>& pieces) {
  for (int axis = 0; axis < body.grid.dimension; ++axis) {
    const std::size_t count = pieces.size();
    for (const int side : {0, 1}) {
      if (body.walls[2 * axis + side].open) continue;
      const double wall = side == 0 ? box.lower()[axis] : box.upper()[axis];
      for (std::size_t n = 0; n < count; ++n) {
        const auto bounds = pieces[n].bounds();
        const double gap = side == 0 ? bounds[0][axis] - wall : wall - bounds[1][axis];
        const double thickness = bounds[1][axis] - bounds[0][axis];
        const bool in_wall = thickness < 1e-6 && std::abs(gap) < 1e-6;
        if (in_wall) pieces[n].double_gap();
        if (gap < reach && !in_wall) pieces.push_back(pieces[n].image(axis, wall));
      }
    }
  }
}

}  // namespace

std::vector<FacePiece> make_face_pieces(const Body& body, std::span<const double> shifts, double reach,
                                        const CrackChoice& choice) {
  std::vector<PieceDraft> drafts;
  for (std::size_t crack = 0; crack < body.cracks.size(); ++crack) {
    if (choice.there.empty() || choice.there[crack]) append_drafts(body, crack, drafts);
  }
  std::vector<double> strengths, blocked;
  for (const CrackSurface& crack : body.cracks) {
    const double apart = 1.0 - (choice.touching ? crack.contact(choice.time) : 0.0);
    strengths.push_back(apart * (1.0 - crack.transmission()));
    blocked.push_back(apart * (1.0 - crack.transmission(body.grid.spacing, body.materials.front().conductivity)));
  }
  if (!choice.repeats) drafts = without_repeats(body, shifts, blocked, std::move(drafts));
  const TipSearch search(body, drafts, shifts);
  std::vector<FacePiece> pieces;
  for (std::size_t n = 0; n < drafts.size(); ++n) {
    const PieceDraft& draft = drafts[n];
    if (shifts[draft.crack] < 0.0) continue;
    const CrackSurface& crack = body.cracks[draft.crack];
    pieces.emplace_back(body.grid.dimension, draft.corners, draft.normal, draft.radius, search.joined(n),
                        shifts[draft.crack], strengths[draft.crack], crack.gap_coefficient() * body.grid.spacing);
    pieces.back().set_crack(draft.crack);
    pieces.back().confine(search.lower(), search.upper());
  }
  append_images(body, search, reach, pieces);
  return pieces;
}

}  // namespace peritherm
