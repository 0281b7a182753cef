#include <cmath>
#include <optional>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/assemble.hpp"

namespace peritherm {
namespace {

/// What is exchanged: a flux, or heat by convection.
struct Exchange {
  const Profile* value = nullptr;
  double coefficient = 0.0;  ///< h [W/(m² K)]; 0 for a flux
};

std::optional<Exchange> exchange_of(const BoundaryCondition& condition) {
  if (ties_points(condition)) return std::nullopt;
  if (const auto* flux = std::get_if<PrescribedFlux>(&condition)) return Exchange{&flux->value, 0.0};
  if (const auto* convection = std::get_if<Convection>(&condition)) {
    return Exchange{&convection->ambient, convection->coefficient};
  }
  return std::nullopt;
}

class ExchangeBuilder {
 public:
  ExchangeBuilder(const Geometry& geometry, const PaddedGrid& layout, std::size_t boundary, const Exchange& exchange)
      : geometry_(geometry),
        body_(geometry.body),
        layout_(layout),
        boundary_(boundary),
        exchange_(exchange),
        uniform_(!CompiledProfile(*exchange.value).depends_on_place()) {}

  /// Heat through a face is spread over the points within a horizon as mirrored fictitious points with the gradient q/k
  /// would spread it; its sum over a column of points is q times the column's area.
  void add_face(Face face) {
    const int axis = axis_of(face);
    const std::vector<double> shares = depth_shares(axis);
    GridIndex low{}, high{};
    for (int a = 0; a < 3; ++a) high[a] = a == axis ? 1 : body_.grid.count(a);
    for (low[2] = 0; low[2] < high[2]; ++low[2]) {
      for (low[1] = 0; low[1] < high[1]; ++low[1]) {
        for (low[0] = 0; low[0] < high[0]; ++low[0]) {
          if (body_.boundary_at(face, low) == static_cast<int>(boundary_)) add_column(face, low, shares);
        }
      }
    }
  }

  /// Selected points exchange heat through their cells' faces towards what is missing. On a staircase a face counts
  /// with the share of its area that looks along the surface's normal, so that slanted and curved surfaces keep their
  /// area.
  void add_selection(const Shape& where) {
    for (std::size_t n = 0; n < body_.grid.size(); ++n) {
      const GridIndex p = body_.grid.index(n);
      if (body_.material_of[n] == no_material) continue;
      if (!contains(where, body_.grid.position(p), 1e-9 * body_.grid.spacing)) continue;
      const double area = open_area(p);
      if (area > 0.0) add_point(p, area, 0.0, body_.grid.position(p), true);
    }
  }

  std::vector<SurfaceExchange> exchanges;
  std::vector<WallPlace> places;
  std::vector<std::int64_t> begin{0};

 private:
  double face_area() const { return body_.grid.cell_volume() / body_.grid.spacing; }

  /// Share of a wall's heat that each depth of points takes, Σ = 1.
  std::vector<double> depth_shares(int axis) const {
    std::vector<double> shares(static_cast<std::size_t>(geometry_.stencil.radius), 0.0);
    double sum = 0.0;
    for (std::size_t depth = 0; depth < shares.size(); ++depth) {
      const double own = static_cast<double>(depth) + body_.grid.first_depth();
      for (const StencilEntry& entry : geometry_.stencil.entries) {
        // A neighbour this far out mirrors a point at the depth offset − own.
        const double outside = entry.offset[axis] - own;
        if (entry.offset[axis] > static_cast<int>(depth)) shares[depth] += 2.0 * entry.conductance * outside;
      }
      if (own == 0.0) shares[depth] *= 0.5;
      sum += shares[depth];
    }
    for (double& value : shares) value /= sum;
    return shares;
  }

  void add_column(Face face, const GridIndex& foot, const std::vector<double>& shares) {
    const int axis = axis_of(face);
    std::vector<GridIndex> column;
    double sum = 0.0;
    for (std::size_t depth = 0; depth < shares.size() && static_cast<int>(depth) < body_.grid.count(axis); ++depth) {
      GridIndex p = foot;
      p[axis] = is_upper(face) ? body_.grid.count(axis) - 1 - static_cast<int>(depth) : static_cast<int>(depth);
      if (body_.material_of[body_.grid.number(p)] == no_material) break;
      column.push_back(p);
      sum += shares[depth];
    }
    if (column.empty()) return;
    const double area = face_area() * share_along_face(axis, column[0]);
    const Point wall = body_.grid.wall_position(face, column[0]);
    for (std::size_t depth = 0; depth < column.size(); ++depth) {
      const double distance = (static_cast<double>(depth) + body_.grid.first_depth()) * body_.grid.spacing;
      add_point(column[depth], area * shares[depth] / sum, distance, wall, depth == 0);
    }
  }

  /// Surface and depth are resistors in series: h_eff = 1 / (1/h + depth/k), exact for a linear profile.
  void add_point(const GridIndex& p, double area, double depth, const Point& wall, bool new_place) {
    const std::size_t n = body_.grid.number(p);
    if (body_.material_of[n] == no_material) return;
    if ((new_place && !uniform_) || places.empty()) {
      places.push_back({1.0, wall});
      begin.push_back(static_cast<std::int64_t>(places.size()));
    }
    if (geometry_.held_by[n] >= 0) return;
    const Material& material = body_.materials[body_.material_of[n]];
    SurfaceExchange point;
    point.entry = static_cast<std::int64_t>(layout_.entry(p));
    point.value = static_cast<std::int64_t>(places.size()) - 1;
    point.boundary = static_cast<std::int16_t>(boundary_);
    point.convective = exchange_.coefficient > 0.0;
    point.gain = point.convective ? area / (1.0 / exchange_.coefficient + depth / material.conductivity) : area;
    point.inverse_capacity =
        1.0 / (volumetric_heat_capacity(material) * body_.grid.cell_volume() * body_.volume_share(p));
    exchanges.push_back(point);
  }

  /// Faces of the box without a boundary of their own are open, too.
  double open_area(const GridIndex& p) const {
    double area = 0.0;
    for (int axis = 0; axis < body_.grid.dimension; ++axis) {
      for (const int side : {-1, 1}) {
        GridIndex q = p;
        q[axis] += side;
        if (!body_.grid.contains(q)) {
          if (body_.boundary_at(make_face(axis, side > 0), p) < 0) area += face_area() * share_along_face(axis, p);
        } else if (body_.material_of[body_.grid.number(q)] == no_material) {
          area += face_area() * share_along_face(axis, p) * std::abs(normal_of_void(p)[axis]);
        }
      }
    }
    return area;
  }

  /// Share of a whole cell's face across an axis that belongs to a point.
  double share_along_face(int axis, const GridIndex& p) const {
    const bool on_face =
        body_.grid.placement == PointPlacement::boundary && (p[axis] == 0 || p[axis] == body_.grid.cells[axis]);
    return body_.grid.volume_share(p) * (on_face ? 2.0 : 1.0);
  }

  /// Unit vector towards the voids within a point's horizon, from the bonds that end there.
  std::array<double, 3> normal_of_void(const GridIndex& p) const {
    std::array<double, 3> sum{};
    for (const StencilEntry& entry : geometry_.stencil.entries) {
      const GridIndex q = body_.fold({p[0] + entry.offset[0], p[1] + entry.offset[1], p[2] + entry.offset[2]});
      if (body_.material_of[body_.grid.number(q)] != no_material) continue;
      for (int axis = 0; axis < 3; ++axis) sum[axis] += entry.offset[axis];
    }
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    if (length == 0.0) return {1.0, 1.0, 1.0};
    return {sum[0] / length, sum[1] / length, sum[2] / length};
  }

  const Geometry& geometry_;
  const Body& body_;
  const PaddedGrid& layout_;
  std::size_t boundary_;
  Exchange exchange_;
  bool uniform_;
};

}  // namespace

std::vector<SurfaceExchange> make_exchanges(const Problem& problem, const Geometry& geometry, const PaddedGrid& layout,
                                            PrescribedValues& values) {
  std::vector<SurfaceExchange> all;
  for (std::size_t b = 0; b < problem.boundaries.size(); ++b) {
    const BoundaryOptions& boundary = problem.boundaries[b];
    const std::optional<Exchange> exchange = exchange_of(boundary.condition);
    if (!exchange) continue;
    ExchangeBuilder builder(geometry, layout, b, *exchange);
    if (boundary.face) {
      builder.add_face(*boundary.face);
    } else {
      builder.add_selection(*boundary.where);
    }
    if (builder.exchanges.empty()) {
      throw Error("boundary." + std::to_string(b) + ": acts on nothing, for no surface of the body is open there",
                  "Choose a part at the body's surface that no other boundary holds");
    }
    for (SurfaceExchange& point : builder.exchanges) {
      point.value += static_cast<std::int64_t>(values.size());
      all.push_back(point);
    }
    values.add(static_cast<int>(b), *exchange->value, builder.places, builder.begin);
  }
  return all;
}

}  // namespace peritherm
