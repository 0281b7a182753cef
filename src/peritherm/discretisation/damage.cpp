#include "peritherm/discretisation/damage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "peritherm/discretisation/row_intervals.hpp"

namespace peritherm {
namespace {

/// The neighbours that come later in the numbering, so that each bond is met once.
std::vector<StencilEntry> forward_half(const Stencil& stencil) {
  return {stencil.entries.begin() + static_cast<std::ptrdiff_t>(stencil.entries.size() / 2), stencil.entries.end()};
}

GridIndex shifted(const GridIndex& p, const GridIndex& offset) {
  return {p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]};
}

bool is_inside(const Body& body, const GridIndex& p) {
  return body.grid.contains(p) && body.material_of[body.grid.number(p)] != no_material;
}

/// Stretches of points that are not cut away, row by row.
struct SolidRows {
  std::vector<std::size_t> begin{0};  ///< rows + 1
  std::vector<std::array<int, 2>> stretches;
};

SolidRows solid_rows(const Body& body) {
  SolidRows rows;
  const int length = body.grid.count(0);
  for (std::size_t n = 0; n < body.grid.size(); n += static_cast<std::size_t>(length)) {
    const MaterialIndex* const material = body.material_of.data() + n;
    for (int x = 0; x < length; ++x) {
      if (material[x] == no_material) continue;
      const int first = x;
      while (x < length && material[x] != no_material) ++x;
      rows.stretches.push_back({first, x});
    }
    rows.begin.push_back(rows.stretches.size());
  }
  return rows;
}

/// Points x of one row whose partner x + shift stands in another one.
std::size_t common_points(const SolidRows& rows, std::size_t row, std::size_t other, int shift) {
  std::size_t count = 0;
  std::size_t b = rows.begin[other];
  for (std::size_t a = rows.begin[row]; a < rows.begin[row + 1]; ++a) {
    const auto [first, last] = rows.stretches[a];
    while (b < rows.begin[other + 1] && rows.stretches[b][1] - shift <= first) ++b;
    for (std::size_t c = b; c < rows.begin[other + 1] && rows.stretches[c][0] - shift < last; ++c) {
      const int low = std::max(first, rows.stretches[c][0] - shift);
      const int high = std::min(last, rows.stretches[c][1] - shift);
      count += static_cast<std::size_t>(std::max(0, high - low));
    }
  }
  return count;
}

}  // namespace

void CutBonds::begin_point(std::size_t point) {
  points_.push_back(static_cast<std::int64_t>(point));
  standing_.push_back(0);
  end_.push_back(static_cast<std::int64_t>(later_.size()));
}

void CutBonds::add(double time) {
  if (time <= 0.0) {
    ++standing_.back();
  } else {
    later_.push_back(time);
    ++end_.back();
  }
}

void CutBonds::append(const CutBonds& others) {
  const auto before = static_cast<std::int64_t>(later_.size());
  points_.insert(points_.end(), others.points_.begin(), others.points_.end());
  standing_.insert(standing_.end(), others.standing_.begin(), others.standing_.end());
  later_.insert(later_.end(), others.later_.begin(), others.later_.end());
  for (const std::int64_t end : others.end_) end_.push_back(before + end);
}

std::size_t CutBonds::cut_at(std::size_t k, double time) const {
  if (!(time >= 0.0)) return 0;
  const auto begin = later_.begin() + (k == 0 ? 0 : end_[k - 1]);
  return standing_[k] + static_cast<std::size_t>(
                            std::count_if(begin, later_.begin() + end_[k], [time](double cut) { return cut <= time; }));
}

std::size_t CutBonds::count_before(double time) const {
  std::size_t directed = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) directed += cut_at(k, time);
  return directed / 2;
}

std::size_t CutBonds::bytes() const {
  return points_.capacity() * sizeof(points_[0]) + standing_.capacity() * sizeof(standing_[0]) +
         end_.capacity() * sizeof(end_[0]) + later_.capacity() * sizeof(later_[0]);
}

CutBonds find_cut_bonds(const Body& body, const Stencil& stencil) {
  CutBonds cuts;
  const BondTracer tracer(body);
  BondPath path;
  for (const RowInterval& interval : points_near_cracks(body, stencil.radius)) {
    for (GridIndex p = first_point(body.grid, interval); p[0] < interval.end; ++p[0]) {
      if (!is_inside(body, p)) continue;
      const std::size_t point = body.grid.number(p);
      bool begun = false;
      for (const StencilEntry& entry : stencil.entries) {
        const GridIndex q = shifted(p, entry.offset);
        if (!is_inside(body, q)) continue;
        tracer.trace(body.grid.position(p), body.material_of[point], body.grid.position(q),
                     body.material_of[body.grid.number(q)], path);
        if (path.crossings.empty()) continue;
        if (!begun) cuts.begin_point(point);
        begun = true;
        cuts.add(path.crossings.front().time);
      }
    }
  }
  return cuts;
}

std::size_t count_bonds(const Body& body, const Stencil& stencil) {
  const Grid& grid = body.grid;
  const std::vector<StencilEntry> forward = forward_half(stencil);
  std::size_t count = 0;
  if (!body.has_voids()) {
    for (const StencilEntry& entry : forward) {
      std::size_t pairs = 1;
      for (int axis = 0; axis < 3; ++axis) {
        pairs *= static_cast<std::size_t>(std::max(0, grid.count(axis) - std::abs(entry.offset[axis])));
      }
      count += pairs;
    }
    return count;
  }
  const SolidRows rows = solid_rows(body);
  const std::int64_t row_count = static_cast<std::int64_t>(grid.count(1)) * grid.count(2);
#pragma omp parallel for schedule(static) reduction(+ : count)
  for (std::int64_t row = 0; row < row_count; ++row) {
    const GridIndex p{0, static_cast<int>(row % grid.count(1)), static_cast<int>(row / grid.count(1))};
    for (const StencilEntry& entry : forward) {
      const GridIndex q{0, p[1] + entry.offset[1], p[2] + entry.offset[2]};
      if (!grid.contains(q)) continue;
      const std::int64_t other = q[1] + static_cast<std::int64_t>(grid.count(1)) * q[2];
      count += common_points(rows, static_cast<std::size_t>(row), static_cast<std::size_t>(other), entry.offset[0]);
    }
  }
  return count;
}

std::vector<double> damage(const Body& body, const Stencil& stencil, const CutBonds& cuts, double time) {
  std::vector<double> result(body.grid.size(), 0.0);
  if (body.has_voids()) {
    const auto count = static_cast<std::int64_t>(result.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t n = 0; n < count; ++n) {
      const auto point = static_cast<std::size_t>(n);
      if (body.material_of[point] == no_material) result[point] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  cuts.for_points(time, [&](std::size_t point, std::size_t cut) {
    if (cut == 0) return;
    const GridIndex p = body.grid.index(point);
    double bonds = 0.0;
    for (const StencilEntry& entry : stencil.entries) bonds += is_inside(body, shifted(p, entry.offset)) ? 1.0 : 0.0;
    result[point] = static_cast<double>(cut) / bonds;
  });
  return result;
}

}  // namespace peritherm
