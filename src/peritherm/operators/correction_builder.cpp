#include <algorithm>
#include <limits>
#include <memory>
#include <unordered_map>
#include <utility>

#include "peritherm/discretisation/bonds.hpp"
#include "peritherm/operators/bond_corrections.hpp"

namespace peritherm {
namespace {

constexpr int longest_segment = BondCorrections::longest_segment;
constexpr int points_per_block = 2048;
constexpr int most_sharing = 3;              // points that share a list and are better off in bundles
constexpr std::int64_t blocks_at_once = 64;  // so many blocks' bonds are held in full before equal ones are shared

using Segment = BondCorrections::Segment;

/// The corrections of one block of points, its patterns numbered for itself.
struct BlockCorrections {
  struct Pattern {
    std::size_t begin, end;  ///< into bonds
    std::uint64_t hash;
    bool enumerable;
    double volume;  ///< of the point that it was first found at
  };
  std::vector<BondDifference> bonds;
  std::vector<Pattern> patterns;
  std::vector<Segment> segments;
  CorrectionBundles bundles;
  std::vector<BondCorrections::ChangingRow> rows;
  std::vector<std::int32_t> distances;
  std::vector<double> differences;
  CutSchedule cuts;
  CutBonds cut_bonds;
};

/// What all blocks are built from.
struct CorrectionPlan {
  CorrectionPlan(const Body& the_body, const PaddedGrid& the_layout, const Stencil& the_stencil)
      : body(the_body), layout(the_layout), stencil(the_stencil), tracer(the_body) {
    for (const FaceWalls& wall : body.walls) partly_held = partly_held || wall.partly_held;
    for (const FaceWalls& wall : body.walls) halves = halves || wall.open;
    halves = halves && body.grid.placement == PointPlacement::boundary;
    // Resistors in series depend on where the bond passes the interface, all else on what stands at its ends.
    enumerable = body.regions.empty() || body.interface != InterfaceRule::length_weighted_harmonic;
    std::vector<double> conductivities;
    for (const Material& material : body.materials) conductivities.push_back(material.conductivity);
    steps = std::make_shared<const BondSteps>(stencil, layout, conductivities);
  }
  const Body& body;
  const PaddedGrid& layout;
  const Stencil& stencil;
  BondTracer tracer;
  bool partly_held = false;
  bool halves = false;  ///< points on open faces count with a part of their cell
  bool enumerable;
  std::shared_ptr<const BondSteps> steps;
};

/// Tells in one look at a point which of its bonds to other points of the body may cross cracks.
class CrossingFilter {
 public:
  CrossingFilter(const Stencil& stencil, double spacing) : stencil_(stencil), spacing_(spacing) {}

  /// Cracks near the points that are asked about next.
  void prepare(const NearbyCracks& nearby) {
    planes_.clear();
    for (const auto& [crack, parts] : nearby.cracks) {
      for (const int part : parts) {
        Plane plane{crack, part, {}};
        const Point normal = crack->normal_of(part);
        for (const auto& [offset, conductance] : stencil_.entries) {
          plane.rises.push_back(spacing_ * (normal[0] * offset[0] + normal[1] * offset[1] + normal[2] * offset[2]));
        }
        planes_.push_back(std::move(plane));
      }
    }
    // Each crack moves points that lie on it by a millionth of the spacing.
    margin_ = spacing_ * (1e-6 + 4e-6 * static_cast<double>(nearby.cracks.size()));
  }

  void look(const Point& x) {
    may_cross_.assign(stencil_.entries.size(), 0);
    for (const Plane& plane : planes_) {
      const double height = plane.crack->height_above(plane.part, x);
      const double least = height > margin_ ? margin_ - height : -std::numeric_limits<double>::infinity();
      const double most = height < -margin_ ? -margin_ - height : std::numeric_limits<double>::infinity();
      // Above the plane a bond must fall to reach it, below it must rise.
      for (std::size_t k = 0; k < may_cross_.size(); ++k) {
        const double rise = plane.rises[k];
        const bool stays_above = height > margin_ && rise > least;
        const bool stays_below = height < -margin_ && rise < most;
        may_cross_[k] |= static_cast<std::uint8_t>(!(stays_above || stays_below));
      }
    }
  }

  bool may_cross(std::size_t k) const { return may_cross_[k] != 0; }

 private:
  struct Plane {
    const CrackSurface* crack;
    int part;
    std::vector<double> rises;  ///< of the height along each bond of the stencil [m]
  };
  const Stencil& stencil_;
  double spacing_;
  double margin_ = 0.0;
  std::vector<Plane> planes_;
  std::vector<std::uint8_t> may_cross_;
};

class BlockBuilder {
 public:
  BlockBuilder(const CorrectionPlan& plan, const HeldPoints& held_by)
      : plan_(plan), held_by_(held_by), filter_(plan.stencil, plan.body.grid.spacing) {}

  void add(const RowInterval& interval) {
    const Grid& grid = plan_.body.grid;
    const GridIndex first = first_point(grid, interval);
    GridIndex last = first;
    last[0] = interval.end - 1;
    Point lower = grid.position(first), upper = grid.position(last);
    for (int axis = 0; axis < grid.dimension; ++axis) {
      lower[axis] -= (plan_.stencil.radius + 0.01) * grid.spacing;
      upper[axis] += (plan_.stencil.radius + 0.01) * grid.spacing;
    }
    nearby_ = plan_.tracer.cracks_in(lower, upper);
    filter_.prepare(nearby_);
    for (GridIndex p = first; p[0] < interval.end; ++p[0]) add_point(p);
  }

  BlockCorrections take() {
    bundle_segments();
    return std::move(block_);
  }

 private:
  void add_point(const GridIndex& p) {
    const Body& body = plan_.body;
    const std::size_t point = body.grid.number(p);
    const MaterialIndex material = body.material_of[point];
    if (material == no_material) return;
    row_.clear();
    row_enumerable_ = true;
    begun_ = false;
    const std::size_t changing = block_.differences.size();
    const double own = body.materials[material].conductivity;
    filter_.look(body.grid.position(p));
    const BrokenBonds::Row broken = body.broken.row(point);
    const auto breaks = [&](const GridIndex& offset) {
      return !broken.bonds.empty() && broken.find(body.broken.number_of(offset)).has_value();
    };
    const MirroredFaces::Row faces = body.faces.row(point);
    const auto mirrored = [&](const GridIndex& offset) {
      return !faces.bonds.empty() && faces.find(body.faces.number_of(offset)).has_value();
    };
    volume_ = body.faces.empty() ? 1.0 : body.faces.volume(point);
    const bool parted = volume_ != 1.0;
    for (std::size_t k = 0; k < plan_.stencil.entries.size(); ++k) {
      const auto& [offset, conductance] = plan_.stencil.entries[k];
      const GridIndex q{p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]};
      // In a body of one material only cracks, elongation and walls make a difference.
      const bool plain = body.regions.empty() && !filter_.may_cross(k) && body.grid.contains(q) && !plan_.halves;
      if (plain && !parted && !breaks(offset) && !mirrored(offset)) continue;
      add_bond(p, material, q, own * conductance, conductance);
    }
    const bool free = held_by_[point] < 0;
    const auto scale = static_cast<std::uint16_t>(free ? material : body.materials.size());
    const auto entry = static_cast<std::int64_t>(plan_.layout.entry(p));
    if (!row_.empty()) add_segment(entry, scale);
    if (block_.differences.size() == changing) return;
    block_.rows.push_back({entry, static_cast<std::int64_t>(block_.differences.size()), scale});
  }

  void add_bond(const GridIndex& p, MaterialIndex material, const GridIndex& q, double stencil_conductance,
                double unit) {
    const Body& body = plan_.body;
    const bool inside = body.grid.contains(q);
    const MaterialIndex other = inside ? body.material_of[body.grid.number(q)] : body.material_of_extended(q);
    path_.conductivity = 0.0;
    path_.crossings.clear();
    path_.faces.clear();
    if (other != no_material) {
      plan_.tracer.trace(nearby_, body.grid.position(p), material, body.grid.position(q), other, path_);
    }
    if (inside && !path_.crossings.empty()) count_cut(p, path_.crossings.front().time);
    const double full = path_.conductivity * unit * body.source_share(q);
    const GridIndex partner = plan_.partly_held ? partner_of(body, p, q) : q;
    const bool other_partner = partner != q;
    if (other_partner) row_.push_back({-stencil_conductance, distance_between(p, q)});
    const double offset = other_partner ? 0.0 : -stencil_conductance;
    const double difference = offset + full * standing_share(path_);
    const bool changes = !path_.faces.empty() || std::any_of(path_.crossings.begin(), path_.crossings.end(),
                                                             [](const Crossing& crossing) { return crossing.in_time; });
    if (changes) {
      block_.cuts.add(block_.differences.size(), offset, full, path_);
      block_.distances.push_back(static_cast<std::int32_t>(distance_between(p, partner)));
      block_.differences.push_back(difference);
    } else if (difference != 0.0) {
      row_.push_back({difference, distance_between(p, partner)});
      row_enumerable_ = row_enumerable_ && (plan_.enumerable || difference == offset) && path_.face_share == 1.0;
    }
  }

  std::int64_t distance_between(const GridIndex& p, const GridIndex& q) const {
    return plan_.layout.distance({q[0] - p[0], q[1] - p[1], q[2] - p[2]});
  }

  void count_cut(const GridIndex& p, double time) {
    if (!begun_) block_.cut_bonds.begin_point(plan_.body.grid.number(p));
    begun_ = true;
    block_.cut_bonds.add(time);
  }

  void add_segment(std::int64_t entry, std::uint16_t scale) {
    const std::uint32_t pattern = pattern_number();
    if (!block_.segments.empty()) {
      Segment& last = block_.segments.back();
      if (last.pattern == pattern && last.scale == scale && last.entry + last.length == entry &&
          last.length < longest_segment) {
        ++last.length;
        return;
      }
    }
    block_.segments.push_back({entry, pattern, 1, scale});
  }

  /// Number of the pattern in row_ within the block.
  std::uint32_t pattern_number() {
    std::uint64_t hash = CorrectionPatterns::hash_of(row_);
    for (auto found = number_of_.find(hash); found != number_of_.end(); found = number_of_.find(++hash)) {
      const BlockCorrections::Pattern& known = block_.patterns[found->second];
      const auto begin = block_.bonds.begin() + static_cast<std::ptrdiff_t>(known.begin);
      const auto same = [](const BondDifference& a, const BondDifference& b) {
        return a.distance == b.distance && a.difference == b.difference;
      };
      if (std::equal(begin, block_.bonds.begin() + static_cast<std::ptrdiff_t>(known.end), row_.begin(), row_.end(),
                     same)) {
        return found->second;
      }
    }
    const auto number = static_cast<std::uint32_t>(block_.patterns.size());
    number_of_[hash] = number;
    const std::size_t begin = block_.bonds.size();
    block_.bonds.insert(block_.bonds.end(), row_.begin(), row_.end());
    block_.patterns.push_back({begin, block_.bonds.size(), hash, row_enumerable_, volume_});
    return number;
  }

  /// Moves neighbouring points whose bonds few others share from the segments into bundles.
  void bundle_segments() {
    std::vector<int> points(block_.patterns.size(), 0);
    for (const Segment& segment : block_.segments) points[segment.pattern] += segment.length;
    const auto fits = [&](const Segment& segment) {
      return points[segment.pattern] <= most_sharing && !block_.patterns[segment.pattern].enumerable &&
             segment.scale < plan_.body.materials.size() &&
             plan_.steps->can_count(segment.scale, corrections_of(segment.pattern));
    };
    block_.bundles = CorrectionBundles(plan_.steps);
    std::vector<Segment> kept;
    for (auto first = block_.segments.begin(); first != block_.segments.end();) {
      auto last = first;
      std::vector<PointCorrections> bundle;
      for (; last != block_.segments.end() && fits(*last); ++last) {
        const auto next = first->entry + static_cast<std::int64_t>(bundle.size());
        const bool room = bundle.size() + last->length <= CorrectionBundles::most_points;
        if (last->entry != next || last->scale != first->scale || !room) break;
        bundle.insert(bundle.end(), last->length, corrections_of(last->pattern));
      }
      if (bundle.empty() || !block_.bundles.add(first->entry, first->scale, bundle)) {
        last = std::max(last, first + 1);
        kept.insert(kept.end(), first, last);
      }
      first = last;
    }
    block_.segments = std::move(kept);
  }

  PointCorrections corrections_of(std::uint32_t number) const {
    const BlockCorrections::Pattern& pattern = block_.patterns[number];
    return {{block_.bonds.data() + pattern.begin, pattern.end - pattern.begin}, pattern.volume};
  }

  const CorrectionPlan& plan_;
  const HeldPoints& held_by_;
  BlockCorrections block_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_of_;
  NearbyCracks nearby_;
  CrossingFilter filter_;
  BondPath path_;
  std::vector<BondDifference> row_;
  bool row_enumerable_ = true;
  double volume_ = 1.0;
  bool begun_ = false;  ///< a cut bond of the point has been counted
};

void append_block(BlockCorrections block, BondCorrections::Parts& parts) {
  constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> numbers(block.patterns.size(), unknown);
  for (Segment& segment : block.segments) {
    const auto& pattern = block.patterns[segment.pattern];
    std::uint32_t& number = numbers[segment.pattern];
    const CorrectionPatterns::Bonds bonds(block.bonds.data() + pattern.begin, pattern.end - pattern.begin);
    if (number == unknown) number = parts.patterns.add(bonds, pattern.hash, pattern.enumerable);
    segment.pattern = number;
  }
  std::sort(block.segments.begin(), block.segments.end(), [](const Segment& a, const Segment& b) {
    return std::pair(a.pattern, a.entry) < std::pair(b.pattern, b.entry);
  });
  parts.segments.insert(parts.segments.end(), block.segments.begin(), block.segments.end());
  parts.begin.push_back(parts.segments.size());
  parts.bundles.append(block.bundles);
  parts.bundle_begin.push_back(parts.bundles.bundles().size());
  const std::size_t before = parts.differences.size();
  for (BondCorrections::ChangingRow row : block.rows) {
    row.end += static_cast<std::int64_t>(before);
    parts.rows.push_back(row);
  }
  parts.distances.insert(parts.distances.end(), block.distances.begin(), block.distances.end());
  parts.differences.insert(parts.differences.end(), block.differences.begin(), block.differences.end());
  parts.cuts.append(block.cuts, before);
  parts.cut_bonds.append(block.cut_bonds);
}

void finish(BondCorrections::Parts& parts) {
  parts.patterns.finish();
  parts.bundles.shrink_to_fit();
  parts.segments.shrink_to_fit();
  parts.rows.shrink_to_fit();
  parts.distances.shrink_to_fit();
  parts.differences.shrink_to_fit();
  parts.cuts.sort();
}

}  // namespace

BondCorrections make_corrections(const Body& body, const PaddedGrid& layout, const Stencil& stencil,
                                 const HeldPoints& held_by, std::string_view kernel) {
  BondCorrections::Parts parts;
  for (const Material& material : body.materials) {
    parts.scales.push_back(1.0 / (volumetric_heat_capacity(material) * body.grid.cell_volume()));
  }
  parts.scales.push_back(0.0);
  parts.begin.push_back(0);
  parts.bundle_begin.push_back(0);
  const CorrectionPlan plan(body, layout, stencil);
  const IntervalBlocks blocks = cut_into_blocks(find_special_points(body, stencil), longest_segment, points_per_block);
  const auto count = static_cast<std::int64_t>(blocks.size());
  std::vector<BlockCorrections> built(static_cast<std::size_t>(blocks_at_once));
  for (std::int64_t first = 0; first < count; first += blocks_at_once) {
    const std::int64_t last = std::min(count, first + blocks_at_once);
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t b = first; b < last; ++b) {
      BlockBuilder builder(plan, held_by);
      for (std::size_t k = blocks.begin[static_cast<std::size_t>(b)]; k < blocks.begin[static_cast<std::size_t>(b) + 1];
           ++k) {
        builder.add(blocks.intervals[k]);
      }
      built[static_cast<std::size_t>(b - first)] = builder.take();
    }
    for (std::int64_t b = first; b < last; ++b)
      append_block(std::move(built[static_cast<std::size_t>(b - first)]), parts);
  }
  finish(parts);
  return BondCorrections(std::move(parts), kernel);
}

}  // namespace peritherm
