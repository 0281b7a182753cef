#include "peritherm/discretisation/bond_classes.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {

double longest_offset(const Stencil& stencil) {
  double longest = 0.0;
  for (const StencilEntry& entry : stencil.entries) {
    longest = std::max(longest, std::hypot(entry.offset[0], entry.offset[1], entry.offset[2]));
  }
  return longest;
}

OffsetTable::OffsetTable(const Stencil& stencil) : number_of_(stencil.radius), entries_(number_of_.count(), -1) {
  for (std::size_t k = 0; k < stencil.entries.size(); ++k) {
    entries_[number_of_(stencil.entries[k].offset)] = static_cast<int>(k);
  }
}

int OffsetTable::operator[](const GridIndex& offset) const {
  return number_of_.contains(offset) ? entries_[number_of_(offset)] : -1;
}

BondClasses::BondClasses(const Body& body, const Stencil& stencil, const OffsetTable& table)
    : body_(body), stencil_(stencil), table_(table) {}

std::pair<GridIndex, int> BondClasses::reversed(const GridIndex& point, int k) const {
  const GridIndex& offset = stencil_.entries[static_cast<std::size_t>(k)].offset;
  const GridIndex end{point[0] + offset[0], point[1] + offset[1], point[2] + offset[2]};
  const GridIndex folded = body_.fold(end);
  GridIndex back{};
  for (int axis = 0; axis < 3; ++axis) back[axis] = folded[axis] == end[axis] ? -offset[axis] : offset[axis];
  return {folded, table_[back]};
}

void BondClasses::Members::sort() {
  const auto last = list_.begin() + static_cast<std::ptrdiff_t>(count_);
  std::sort(list_.begin(), last);
  count_ = static_cast<std::size_t>(std::unique(list_.begin(), last) - list_.begin());
}

BondClasses::Members BondClasses::members(const GridIndex& point, int k) const {
  const std::uint64_t count = stencil_.entries.size();
  Members found;
  const auto consider = [&](const GridIndex& p, int entry) {
    const GridIndex& offset = stencil_.entries[static_cast<std::size_t>(entry)].offset;
    int on_wall = 0;
    for (int axis = 0; axis < body_.grid.dimension && body_.grid.placement == PointPlacement::boundary; ++axis) {
      if (p[axis] == 0 || p[axis] == body_.grid.cells[axis]) on_wall |= 1 << axis;
    }
    for (int turned = 0; turned <= on_wall; ++turned) {
      if ((turned & ~on_wall) != 0) continue;
      GridIndex seen = offset;
      for (int axis = 0; axis < 3; ++axis) seen[axis] = (turned >> axis & 1) != 0 ? -offset[axis] : offset[axis];
      found.add({body_.grid.number(p) * count + static_cast<std::uint64_t>(table_[seen]), body_.grid.volume_share(p)});
    }
  };
  consider(point, k);
  const auto [other, back] = reversed(point, k);
  consider(other, back);
  found.sort();
  return found;
}

std::uint64_t BondClasses::key(const GridIndex& point, int k) const { return members(point, k).begin()->first; }

double BondClasses::weight(const GridIndex& point, int k) const {
  double ends = 0.0;
  for (const auto& [member, share] : members(point, k)) ends += share;
  return 0.5 * ends;
}

}  // namespace peritherm
