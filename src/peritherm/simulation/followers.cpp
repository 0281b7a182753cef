#include <algorithm>
#include <cstdlib>

#include "peritherm/base/error.hpp"
#include "peritherm/discretisation/bonds.hpp"
#include "peritherm/simulation/assemble.hpp"

namespace peritherm {
namespace {

/// Writes down what ties the points of one boundary.
class TieBuilder {
 public:
  TieBuilder(const Geometry& geometry, const PaddedGrid& layout, Face face, Followers& followers)
      : body_(geometry.body),
        layout_(layout),
        face_(face),
        stencil_(geometry.stencil),
        slaved_(slaved_points(geometry.stencil, geometry.stencil_options.horizon, geometry.body.grid.spacing)),
        tracer_(geometry.body),
        followers_(followers) {}

  /// T_i = T of the first point farther in than the horizon + distance · q / k [bobaru2010, eq. 22].
  void tie_to_first_free(const GridIndex& p, std::size_t boundary) {
    GridIndex source = p;
    source[axis()] = is_upper(face_) ? body_.grid.count(axis()) - 1 - slaved_ : slaved_;
    const MaterialIndex material = body_.material_of[body_.grid.number(source)];
    if (material == no_material) {
      throw Error("boundary." + std::to_string(boundary) +
                      ".imposed: where the body is cut away, points have no point farther in to follow",
                  "Keep cut-away parts a horizon off the face, or choose \"mirror\"");
    }
    const double distance = std::abs(source[axis()] - p[axis()]) * body_.grid.spacing;
    followers_.neighbours.push_back(static_cast<std::int64_t>(layout_.entry(source)));
    followers_.gains.push_back(body_.materials[material].conductivity / distance);
  }

  /// Σ over bonds of conductance · L (T_p − T_i) / volume is the heat flux at i along the inward normal
  /// [bobaru2012, section 3.2], L the component of a bond along it. What stands for a point's own cell has no part in
  /// it.
  void tie_by_flux(const GridIndex& p) {
    for (std::size_t k = 0; k < stencil_.entries.size(); ++k) {
      const auto& [offset, conductance] = stencil_.entries[k];
      const double bond = conductance - (stencil_.self.empty() ? 0.0 : stencil_.self[k]);
      const int inward = is_upper(face_) ? -offset[axis()] : offset[axis()];
      if (inward <= 0 || bond <= 0.0) continue;
      add_bond(p, {p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]},
               bond * inward * body_.grid.spacing / body_.grid.cell_volume());
    }
  }

 private:
  int axis() const { return axis_of(face_); }

  void add_bond(const GridIndex& p, const GridIndex& q, double unit) {
    const MaterialIndex other = body_.material_of_extended(q);
    if (other == no_material) return;
    tracer_.trace(body_.grid.position(p), body_.material_of[body_.grid.number(p)], body_.grid.position(q), other,
                  path_);
    const double full = unit * body_.source_share(q) * path_.conductivity;
    if (full == 0.0) return;
    followers_.cuts.add(followers_.gains.size(), 0.0, full, path_);
    followers_.neighbours.push_back(static_cast<std::int64_t>(layout_.entry(partner_of(body_, p, q))));
    followers_.gains.push_back(full * standing_share(path_));
  }

  const Body& body_;
  const PaddedGrid& layout_;
  Face face_;
  const Stencil& stencil_;
  int slaved_;
  BondTracer tracer_;
  Followers& followers_;
  BondPath path_;
};

/// The values of a prescribed flux at the places on the wall that the points of a boundary belong to.
class FluxSlots {
 public:
  explicit FluxSlots(const Profile* value, std::size_t first) : first_(first), value_(value) {
    uniform_ = value == nullptr || !CompiledProfile(*value).depends_on_place();
  }

  std::int64_t add(const Point& place) {
    if (value_ == nullptr) return -1;
    if (places_.empty() || !uniform_) {
      places_.push_back({1.0, place});
      begin_.push_back(static_cast<std::int64_t>(places_.size()));
    }
    return static_cast<std::int64_t>(first_ + places_.size()) - 1;
  }

  void hand_over(std::size_t boundary, PrescribedValues& values) const {
    if (value_ != nullptr) values.add(static_cast<int>(boundary), *value_, places_, begin_);
  }

 private:
  std::size_t first_;
  const Profile* value_;
  bool uniform_;
  std::vector<WallPlace> places_;
  std::vector<std::int64_t> begin_{0};
};

/// Conductances only fall, so a row that stands at the end stands throughout.
void refuse_rows_that_end(const Followers& followers, const Geometry& geometry, double end) {
  std::vector<double> gains = followers.gains;
  CutSchedule cuts = followers.cuts;
  cuts.average_over(end, end, gains);
  for (std::size_t row = 0; row < followers.size(); ++row) {
    const auto first = gains.begin() + static_cast<std::ptrdiff_t>(followers.row_begin[row]);
    const auto last = gains.begin() + static_cast<std::ptrdiff_t>(followers.row_begin[row + 1]);
    if (std::any_of(first, last, [](double gain) { return gain > 0.0; })) continue;
    const std::string name = geometry.boundary_names[static_cast<std::size_t>(followers.boundaries[row])];
    throw Error(
        "boundary \"" + name + "\": a point of the face has no neighbour farther in that it could follow up to the end",
        "Keep cracks, breaking bonds and cut-away parts off the face, or choose imposed = \"mirror\"");
  }
}

}  // namespace

int slaved_points(const Stencil& stencil, double horizon, double spacing) {
  return std::max(stencil.radius, static_cast<int>(horizon / spacing + 1e-9));
}

Followers make_followers(const Problem& problem, const Geometry& geometry, const PaddedGrid& layout,
                         PrescribedValues& fluxes) {
  Followers followers;
  const Grid& grid = geometry.body.grid;
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    const BoundaryOptions& boundary = problem.boundaries[b];
    if (!boundary.face || !ties_points(boundary.condition)) continue;
    const auto* flux = std::get_if<PrescribedFlux>(&boundary.condition);
    FluxSlots slots(flux != nullptr ? &flux->value : nullptr, fluxes.size());
    TieBuilder builder(geometry, layout, *boundary.face, followers);
    for (std::size_t n = 0; n < geometry.held_by.boundaries().size(); ++n) {
      if (geometry.held_by[n] != static_cast<int>(b)) continue;
      const GridIndex p = grid.index(n);
      followers.entries.push_back(static_cast<std::int64_t>(layout.entry(p)));
      followers.boundaries.push_back(static_cast<std::int16_t>(b));
      followers.fluxes.push_back(slots.add(grid.wall_position(*boundary.face, p)));
      if (outside_of(boundary.condition) == Outside::slaved) {
        builder.tie_to_first_free(p, b);
      } else {
        builder.tie_by_flux(p);
      }
      followers.row_begin.push_back(static_cast<BondIndex>(followers.gains.size()));
    }
    slots.hand_over(b, fluxes);
  }
  followers.cuts.sort();
  refuse_rows_that_end(followers, geometry, problem.time.end);
  return followers;
}

}  // namespace peritherm
