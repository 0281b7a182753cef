#include "peritherm/operators/ghost_layer.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

namespace peritherm {
namespace {

double sign_of(WallKind kind) {
  if (kind == WallKind::even) return 1.0;
  return kind == WallKind::odd ? -1.0 : 0.0;
}

/// The runs that fill fictitious points, by the first entry that each fills.
class RunsByTarget {
 public:
  RunsByTarget(std::span<const GhostRun> runs) {
    for (const GhostRun& run : runs) by_target_[run.target] = &run;
  }

  /// Fictitious points stand for points of the body, in corners by way of one another.
  Stand stand(std::int64_t entry) const {
    Stand stand{entry, 1.0, {}};
    for (const GhostRun* run = find(stand.entry); run != nullptr && stand.sign != 0.0; run = find(stand.entry)) {
      const std::int64_t k = stand.entry - run->target;
      if (run->boundary >= 0) stand.walls.push_back({run->wall + k * run->wall_step, stand.sign * run->wall_weight});
      stand.sign *= run->sign;
      stand.entry = run->source + k * run->step;
    }
    return stand;
  }

 private:
  const GhostRun* find(std::int64_t entry) const {
    const auto next = by_target_.upper_bound(entry);
    if (next == by_target_.begin()) return nullptr;
    const GhostRun* const run = std::prev(next)->second;
    return entry < run->target + run->length ? run : nullptr;
  }

  std::map<std::int64_t, const GhostRun*> by_target_;
};

}  // namespace

GhostLayer::GhostLayer(const Body& body, const PaddedGrid& layout, const HeldPoints& held_by,
                       const std::vector<bool>& depends_on_place) {
  slots_.resize(depends_on_place.size());
  for (std::size_t b = 0; b < slots_.size(); ++b) {
    slots_[b].boundary = static_cast<int>(b);
    slots_[b].uniform = !depends_on_place[b];
  }
  add_held(body, layout, held_by);
  end_stage();
  for (int axis = 0; axis < body.grid.dimension; ++axis) {
    add_face(body, layout, make_face(axis, false));
    add_face(body, layout, make_face(axis, true));
    end_stage();
  }
  for (WallSlots& slots : slots_) {
    slots.first = static_cast<std::int64_t>(wall_count_);
    wall_count_ += slots.begin.size() - 1;
  }
  for (GhostRun& run : runs_) {
    if (run.boundary >= 0) run.wall += slots_[run.boundary].first;
  }
}

void GhostLayer::append(GhostRun run, const std::vector<WallPlace>& places) {
  if (run.boundary >= 0) {
    WallSlots& slots = slots_[run.boundary];
    const auto here = static_cast<std::int64_t>(slots.begin.size()) - 1;
    if (!slots.uniform || here == 0) {
      slots.places.insert(slots.places.end(), places.begin(), places.end());
      slots.begin.push_back(static_cast<std::int64_t>(slots.places.size()));
      run.wall = here;
    }
  }
  if (!runs_.empty() && stage_begin_.back() < runs_.size()) {
    GhostRun& last = runs_.back();
    const bool continues =
        last.boundary == run.boundary && last.sign == run.sign && last.target + last.length == run.target &&
        (last.sign == 0.0 || last.length == 1 || last.source + last.length * last.step == run.source) &&
        (run.boundary < 0 || run.wall == last.wall + last.length * last.wall_step ||
         (last.length == 1 && run.wall == last.wall + 1));
    const std::int64_t step = last.length == 1 && run.sign != 0.0 ? run.source - last.source : last.step;
    if (continues && (step == 1 || step == -1)) {
      if (last.length == 1 && run.boundary >= 0) last.wall_step = static_cast<std::int8_t>(run.wall - last.wall);
      last.step = static_cast<std::int8_t>(step);
      ++last.length;
      return;
    }
  }
  run.length = 1;
  runs_.push_back(run);
}

void GhostLayer::add_held(const Body& body, const PaddedGrid& layout, const HeldPoints& held_by) {
  const std::size_t count = held_by.boundaries().size();
  for (std::size_t n = 0; n < count; ++n) {
    if (held_by[n] < 0) continue;
    const GridIndex p = body.grid.index(n);
    GhostRun run;
    run.target = static_cast<std::int64_t>(layout.entry(p));
    run.boundary = held_by[n];
    run.sign = 0.0;
    run.wall_weight = 1.0;
    append(run, {{1.0, body.grid.position(p)}});
  }
}

/// The wall's temperature beside the edge of a face: the neighbouring face's own continuation of it.
std::vector<WallPlace> GhostLayer::places_at(const Body& body, Face face, const GridIndex& p) const {
  std::vector<std::pair<double, GridIndex>> terms{{1.0, p}};
  std::vector<WallPlace> places;
  std::vector<std::array<int, 3>> edges(1, {0, 0, 0});
  for (int axis = 0; axis < axis_of(face); ++axis) {
    const GridIndex folded = body.fold(p);
    if (folded[axis] == p[axis]) continue;
    const Face side = make_face(axis, p[axis] > folded[axis]);
    const double sign = sign_of(body.wall_kind_at(side, p));
    const std::size_t count = terms.size();
    for (std::size_t k = 0; k < count; ++k) {
      if (sign != 1.0) {
        auto edge = terms[k];
        edge.first *= 1.0 - sign;
        auto marks = edges[k];
        marks[axis] = is_upper(side) ? 1 : -1;
        terms.push_back(edge);
        edges.push_back(marks);
      }
      terms[k].first *= sign;
      terms[k].second[axis] = folded[axis];
    }
  }
  for (std::size_t k = 0; k < terms.size(); ++k) {
    if (terms[k].first == 0.0) continue;
    Point x = body.grid.wall_position(face, terms[k].second);
    for (int axis = 0; axis < 3; ++axis) {
      if (edges[k][axis] < 0) x[axis] = body.grid.origin[axis];
      if (edges[k][axis] > 0) x[axis] = body.grid.origin[axis] + body.grid.length(axis);
    }
    places.push_back({terms[k].first, x});
  }
  return places;
}

void GhostLayer::add_line(const Body& body, const PaddedGrid& layout, Face face, const GridIndex& first, int length) {
  const int axis = axis_of(face);
  for (int k = 0; k < length; ++k) {
    GridIndex p = first;
    p[0] += k;
    if (body.material_of_extended(p) == no_material) continue;
    const WallKind kind = body.wall_kind_at(face, p);
    GridIndex source = p;
    source[axis] = body.fold(p)[axis];
    GhostRun run;
    run.target = static_cast<std::int64_t>(layout.entry(p));
    run.source = static_cast<std::int64_t>(layout.entry(source));
    run.sign = sign_of(kind);
    run.wall_weight = 1.0 - run.sign;
    if (is_held(kind)) run.boundary = static_cast<std::int16_t>(body.boundary_at(face, p));
    const bool needs_place =
        run.boundary >= 0 && (!slots_[run.boundary].uniform || slots_[run.boundary].begin.size() == 1);
    append(run, needs_place ? places_at(body, face, p) : std::vector<WallPlace>{});
  }
}

/// Faces are filled axis by axis, each over the fictitious points of the axes before it, so corners are complete.
void GhostLayer::add_face(const Body& body, const PaddedGrid& layout, Face face) {
  if (body.walls[static_cast<int>(face)].open) return;
  const int axis = axis_of(face);
  GridIndex low{}, high{};
  for (int a = 0; a < 3; ++a) {
    const int beyond = a < axis ? layout.padding(a) : 0;
    low[a] = -beyond;
    high[a] = body.grid.count(a) + beyond;
  }
  low[axis] = is_upper(face) ? body.grid.count(axis) : -layout.padding(axis);
  high[axis] = low[axis] + layout.padding(axis);
  for (int z = low[2]; z < high[2]; ++z) {
    for (int y = low[1]; y < high[1]; ++y) add_line(body, layout, face, {low[0], y, z}, high[0] - low[0]);
  }
}

void GhostLayer::add_followers(Followers followers) {
  if (followers.size() == 0) return;
  const RunsByTarget runs(std::span<const GhostRun>(runs_).subspan(stage_begin_[1]));
  std::vector<Stand> stands;
  for (const std::int64_t entry : followers.neighbours) stands.push_back(runs.stand(entry));
  followers_ = FollowerRows(std::move(followers), stands);
}

void GhostLayer::fill(ConstField wall_temperatures, ConstField fluxes, Field field) const {
  fill_stage(0, wall_temperatures.data(), field.data());
  if (!followers_.empty()) followers_.fill(wall_temperatures, fluxes, field);
  for (std::size_t stage = 1; stage + 1 < stage_begin_.size(); ++stage) {
    fill_stage(stage, wall_temperatures.data(), field.data());
  }
}

void GhostLayer::fill_stage(std::size_t stage, const double* walls, double* values) const {
  const auto begin = static_cast<std::int64_t>(stage_begin_[stage]);
  const auto end = static_cast<std::int64_t>(stage_begin_[stage + 1]);
#pragma omp parallel for schedule(static) if (end - begin > 64)
  for (std::int64_t r = begin; r < end; ++r) {
    const GhostRun& run = runs_[static_cast<std::size_t>(r)];
    double* const target = values + run.target;
    const double* const source = values + run.source;
    if (run.boundary < 0 && run.step == 1) {
      std::copy_n(source, run.length, target);
    } else if (run.boundary < 0) {
      for (int k = 0; k < run.length; ++k) target[k] = source[k * run.step];
    } else if (run.sign == 0.0) {
      for (int k = 0; k < run.length; ++k) target[k] = walls[run.wall + k * run.wall_step];
    } else {
      for (int k = 0; k < run.length; ++k) {
        target[k] = run.sign * source[k * run.step] + run.wall_weight * walls[run.wall + k * run.wall_step];
      }
    }
  }
}

std::size_t GhostLayer::bytes() const {
  std::size_t bytes = runs_.capacity() * sizeof(GhostRun) + followers_.bytes();
  for (const WallSlots& slots : slots_) {
    bytes += slots.places.capacity() * sizeof(WallPlace) + slots.begin.capacity() * sizeof(std::int64_t);
  }
  return bytes;
}

}  // namespace peritherm
