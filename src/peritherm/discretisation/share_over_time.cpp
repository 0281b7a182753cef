#include "peritherm/discretisation/share_over_time.hpp"

#include <algorithm>
#include <cassert>

namespace peritherm {

double share_at(std::span<const ShareKnot> knots, double time, Side side) {
  assert(!knots.empty());
  const auto is_over = [side](const ShareKnot& knot, double t) {
    return side == Side::before ? knot.time < t : knot.time <= t;
  };
  const auto next = std::lower_bound(knots.begin(), knots.end(), time, is_over);
  if (next == knots.begin()) return knots.front().share;
  const ShareKnot& last = *(next - 1);
  if (next == knots.end() || last.time == time) return last.share;
  if (next->time == time) return next->share;
  return last.share + (next->share - last.share) * (time - last.time) / (next->time - last.time);
}

}  // namespace peritherm
