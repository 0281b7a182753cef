#include "peritherm/output/section.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "peritherm/output/labels.hpp"

namespace peritherm {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The axes of a section: across it, then its first and second one.
using PlaneAxes = std::array<int, 3>;

PlaneAxes plane_axes(const Grid& grid, AxisName normal) {
  if (grid.dimension < 3 || normal == AxisName::z) return {2, 0, 1};
  return normal == AxisName::y ? PlaneAxes{1, 0, 2} : PlaneAxes{0, 1, 2};
}

using ValueAt = std::function<double(std::size_t)>;

double size_of(const Point& flux) { return std::hypot(flux[0], flux[1], flux[2]); }

/// A slice of a cube needs the flux of few points; a plate that of all.
ValueAt flux_values(const Snapshot& snapshot) {
  if (snapshot.grid.dimension == 3) {
    return [&snapshot](std::size_t i) {
      Point flux{};
      snapshot.heat_flux(i, std::span(&flux, 1));
      return size_of(flux);
    };
  }
  std::vector<Point> flux(snapshot.grid.size());
  snapshot.heat_flux(0, flux);
  return [flux = std::move(flux)](std::size_t i) { return size_of(flux[i]); };
}

ValueAt field_values(const Snapshot& snapshot, FieldName field) {
  switch (field) {
    case FieldName::heat_flux:
      return flux_values(snapshot);
    case FieldName::damage:
      return [damage = snapshot.damage()](std::size_t i) { return damage[i]; };
    case FieldName::material:
      return [materials = snapshot.materials](std::size_t i) { return static_cast<double>(materials[i]); };
    case FieldName::temperature:
      break;
  }
  return [temperature = snapshot.temperature](std::size_t i) { return temperature[i]; };
}

/// The two layers of points around a slice.
struct Layers {
  int lower = 0;
  int upper = 0;
  double share = 0.0;  ///< of the upper one
};

Layers find_layers(const Grid& grid, int axis, double at) {
  const int last = grid.count(axis) - 1;
  const double place =
      std::clamp((at - grid.origin[axis]) / grid.spacing - grid.first_depth(), 0.0, static_cast<double>(last));
  const int lower = std::min(static_cast<int>(place), std::max(0, last - 1));
  return {lower, std::min(lower + 1, last), place - lower};
}

bool is_smooth(FieldName field) { return field == FieldName::temperature || field == FieldName::heat_flux; }

/// A value and the material of the points that it is from.
struct SliceValue {
  double value = nothing;
  MaterialIndex material = no_material;
};

/// Makes the values of a slice from those of the layers beside it.
class Slicer {
 public:
  Slicer(const Snapshot& snapshot, FieldName field, int axis, const Layers& layers)
      : snapshot_(snapshot), field_(field), axis_(axis), layers_(layers), value_at_(field_values(snapshot, field)) {}

  SliceValue operator()(GridIndex p) const {
    const bool lower_is_near = layers_.share <= 0.5;
    const GridIndex near = moved(p, lower_is_near ? layers_.lower : layers_.upper);
    const GridIndex far = moved(p, lower_is_near ? layers_.upper : layers_.lower);
    const double share = lower_is_near ? layers_.share : 1.0 - layers_.share;
    if (share > 0.0 && snapshot_.jumps && field_ != FieldName::material) {
      Point place = snapshot_.grid.position(near);
      place[axis_] += share * (snapshot_.grid.position(far)[axis_] - place[axis_]);
      if (snapshot_.jumps.between(material(near), material(far), place)) return beside_jump(near, far, share, place);
    }
    const double a = value(near);
    const double b = share > 0.0 && field_ != FieldName::material ? value(far) : a;
    return {std::isnan(b) ? a : a + share * (b - a), material(near)};
  }

 private:
  GridIndex moved(GridIndex p, int layer) const {
    p[axis_] = layer;
    return p;
  }
  MaterialIndex material(const GridIndex& p) const { return snapshot_.materials[snapshot_.grid.number(p)]; }
  double value(const GridIndex& p) const {
    const std::size_t i = snapshot_.grid.number(p);
    return std::isnan(snapshot_.temperature[i]) ? nothing : value_at_(i);
  }

  /// From the layer on the side of the place, carried on from the one behind it.
  SliceValue beside_jump(const GridIndex& near, const GridIndex& far, double share, const Point& place) const {
    const MaterialIndex here = snapshot_.jumps.material_at(place);
    const bool with_far =
        snapshot_.jumps.between(here, material(near), place) && !snapshot_.jumps.between(here, material(far), place);
    const GridIndex& from = with_far ? far : near;
    const GridIndex behind = moved(from, 2 * from[axis_] - (with_far ? near : far)[axis_]);
    SliceValue found{value(from), material(from)};
    if (!is_smooth(field_) || !snapshot_.grid.contains(behind)) return found;
    if (std::isnan(value(behind)) || snapshot_.jumps.between(material(from), material(behind), place)) return found;
    found.value += (with_far ? 1.0 - share : share) * (found.value - value(behind));
    if (field_ == FieldName::heat_flux) found.value = std::max(0.0, found.value);
    return found;
  }

  const Snapshot& snapshot_;
  FieldName field_;
  int axis_;
  Layers layers_;
  ValueAt value_at_;
};

/// Values at the points of a slice, x fastest.
std::vector<SliceValue> slice_values(const Snapshot& snapshot, FieldName field, const PlaneAxes& axes,
                                     const Layers& layers) {
  const Slicer slicer(snapshot, field, axes[0], layers);
  std::vector<SliceValue> values;
  GridIndex p{};
  for (p[axes[2]] = 0; p[axes[2]] < snapshot.grid.count(axes[2]); ++p[axes[2]]) {
    for (p[axes[1]] = 0; p[axes[1]] < snapshot.grid.count(axes[1]); ++p[axes[1]]) values.push_back(slicer(p));
  }
  return values;
}

/// Places of the nodes along an axis; the faces are added where the points do not stand on them.
std::vector<double> node_places(const Grid& grid, int axis) {
  std::vector<double> places;
  const bool faces = grid.first_depth() > 0.0;
  if (faces) places.push_back(grid.origin[axis]);
  for (int i = 0; i < grid.count(axis); ++i) {
    places.push_back(grid.origin[axis] + (i + grid.first_depth()) * grid.spacing);
  }
  if (faces) places.push_back(grid.origin[axis] + grid.length(axis));
  return places;
}

/// Value on a face, half a spacing beyond the last point: carried on from the two last points if nothing parts them.
double face_value(const Section& section, std::size_t node, std::size_t inner, FieldName field) {
  const std::size_t columns = section.x.size();
  const double a = section.values[node];
  const double b = section.values[inner];
  const Place here{section.x[node % columns], section.y[node / columns]};
  const Place there{section.x[inner % columns], section.y[inner / columns]};
  if (!is_smooth(field) || std::isnan(b)) return a;
  if (section.jumps && section.jumps.between(section.materials[node], section.materials[inner], section.lift(here))) {
    return a;
  }
  for (const Line& crack : section.cracks) {
    if (separated(crack, here, there, section.spacing)) return a;
  }
  if (section.y.size() == 1 && separated_in_bar(section.cracks, std::min(here.x, there.x), std::max(here.x, there.x))) {
    return a;
  }
  const double carried_on = 1.5 * a - 0.5 * b;
  // The size of a flux stays one.
  return field == FieldName::heat_flux ? std::max(0.0, carried_on) : carried_on;
}

void fill_face(Section& section, std::size_t face, std::size_t node, std::size_t inner, FieldName field) {
  section.values[face] = face_value(section, node, inner, field);
  section.materials[face] = section.materials[node];
}

void fill_faces(Section& section, FieldName field) {
  const std::size_t columns = section.x.size();
  const std::size_t rows = section.y.size();
  const auto number = [columns](std::size_t i, std::size_t j) { return j * columns + i; };
  const bool has_y = rows > 1;
  const std::size_t x_step = columns > 3 ? 1 : 0;
  const std::size_t y_step = rows > 3 ? 1 : 0;
  for (std::size_t j = has_y ? 1 : 0; j < (has_y ? rows - 1 : rows); ++j) {
    const std::size_t right = columns - 2;
    fill_face(section, number(0, j), number(1, j), number(1 + x_step, j), field);
    fill_face(section, number(right + 1, j), number(right, j), number(right - x_step, j), field);
  }
  for (std::size_t i = 0; has_y && i < columns; ++i) {
    const std::size_t top = rows - 2;
    fill_face(section, number(i, 0), number(i, 1), number(i, 1 + y_step), field);
    fill_face(section, number(i, top + 1), number(i, top), number(i, top - y_step), field);
  }
}

void fill_nodes(Section& section, const Grid& grid, const PlaneAxes& axes, const std::vector<SliceValue>& values,
                FieldName field) {
  const auto points = static_cast<std::size_t>(grid.count(axes[1]));
  const std::size_t x_shift = section.x.size() > points ? 1 : 0;
  const std::size_t y_shift = section.y.size() > values.size() / points ? 1 : 0;
  section.values.assign(section.x.size() * section.y.size(), nothing);
  section.materials.assign(section.values.size(), no_material);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t node = (i / points + y_shift) * section.x.size() + i % points + x_shift;
    section.values[node] = values[i].value;
    section.materials[node] = values[i].material;
  }
  if (x_shift > 0) fill_faces(section, field);
}

/// Takes over what the snapshot says of interfaces. `at`: the place of the section across its plane.
void lift_section(const Snapshot& snapshot, const PlaneAxes& axes, double at, FieldName field, Section& section) {
  section.jumps = snapshot.jumps;
  section.lift = [axes, at](const Place& place) {
    Point lifted{};
    lifted[axes[0]] = at;
    lifted[axes[1]] = place.x;
    lifted[axes[2]] = place.y;
    return lifted;
  };
  if (field == FieldName::heat_flux || field == FieldName::damage) section.lowest = 0.0;
  if (field == FieldName::damage) section.highest = 1.0;
}

/// A bar's interfaces are places that separate, as cracks are.
void add_interfaces_of_bar(Section& section) {
  for (std::size_t i = 0; i + 1 < section.x.size(); ++i) {
    const Point from = section.lift({section.x[i], 0.0}), to = section.lift({section.x[i + 1], 0.0});
    if (!section.jumps.between(section.materials[i], section.materials[i + 1], from)) continue;
    section.cracks.push_back({{find_change(section.jumps, from, to).second[0], 0.0}});
  }
}

}  // namespace

bool separated_in_bar(const std::vector<Line>& cracks, double a, double b) {
  return std::any_of(cracks.begin(), cracks.end(),
                     [&](const Line& crack) { return crack.size() == 1 && crack[0].x > a && crack[0].x <= b; });
}

void cut_cracks(const std::vector<std::vector<Point>>& cracks, const std::array<int, 3>& plane, double at, double slack,
                Section& section) {
  const auto flat = [&plane](const Point& p) { return Place{p[plane[1]], p[plane[2]]}; };
  for (const std::vector<Point>& crack : cracks) {
    const auto height = [&crack, &plane, at](std::size_t i) { return crack[i % crack.size()][plane[0]] - at; };
    Line meets;
    bool inside = true;
    for (std::size_t i = 0; i < crack.size(); ++i) {
      inside = inside && std::abs(height(i)) <= slack;
      if ((height(i) < 0.0) == (height(i + 1) < 0.0)) continue;
      const double share = height(i) / (height(i) - height(i + 1));
      const Place a = flat(crack[i]);
      const Place b = flat(crack[(i + 1) % crack.size()]);
      meets.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    }
    if (inside) {
      Line outline;
      for (std::size_t i = 0; i <= crack.size() && !crack.empty(); ++i)
        outline.push_back(flat(crack[i % crack.size()]));
      section.outlines.push_back(outline);
      continue;
    }
    // A plane polygon meets the slice in one line; it enters and leaves the polygon alternately.
    std::sort(meets.begin(), meets.end(), [](Place a, Place b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    for (std::size_t i = 0; i + 1 < meets.size(); i += 2) section.cracks.push_back({meets[i], meets[i + 1]});
  }
}

Section make_section(const Snapshot& snapshot, const PictureOutput& options) {
  const Grid& grid = snapshot.grid;
  const PlaneAxes axes = plane_axes(grid, options.normal);
  Section section;
  section.spacing = grid.spacing;
  section.x_name = EnumNames<AxisName>::values[static_cast<std::size_t>(axes[1])].second;
  if (grid.dimension > 1) section.y_name = EnumNames<AxisName>::values[static_cast<std::size_t>(axes[2])].second;
  section.x = node_places(grid, axes[1]);
  section.y = grid.dimension > 1 ? node_places(grid, axes[2]) : std::vector<double>{0.0};
  Layers layers;
  double at = 0.0;
  if (grid.dimension == 3) {
    at = options.at.value_or(grid.origin[axes[0]] + 0.5 * grid.length(axes[0]));
    layers = find_layers(grid, axes[0], at);
    cut_cracks(snapshot.cracks, axes, at, 1e-6 * grid.spacing, section);
    const Unit unit = length_unit(std::max({grid.length(0), grid.length(1), grid.length(2)}));
    section.place = std::string(EnumNames<AxisName>::values[static_cast<std::size_t>(axes[0])].second) + " = " +
                    rounded_text(at / unit.size, 4) + ' ' + std::string(unit.symbol);
  } else {
    for (const std::vector<Point>& crack : snapshot.cracks) {
      Line line;
      for (const Point& p : crack) line.push_back({p[0], p[1]});
      section.cracks.push_back(std::move(line));
    }
  }
  lift_section(snapshot, axes, at, options.field, section);
  fill_nodes(section, grid, axes, slice_values(snapshot, options.field, axes, layers), options.field);
  if (grid.dimension == 1 && section.jumps) add_interfaces_of_bar(section);
  if (grid.dimension == 1 || !section.jumps) section.materials.clear();
  return section;
}

}  // namespace peritherm
