#include "peritherm/discretisation/bond_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "peritherm/geometry/vector.hpp"

namespace peritherm {
namespace {

constexpr int most_images = 8;  // that a bond passes

}  // namespace

BondTracer::BondTracer(const Body& body) : body_(body) {
  for (int axis = 0; axis < body.grid.dimension; ++axis) {
    lower_[axis] = body.grid.origin[axis];
    upper_[axis] = body.grid.origin[axis] + body.grid.length(axis);
  }
  uniform_ = body.regions.empty();
  const std::size_t materials = body.materials.size();
  if (!body.contacts.empty()) contact_resistances_.resize(materials * materials);
  // Of a pair the first counts.
  for (auto contact = body.contacts.rbegin(); contact != body.contacts.rend(); ++contact) {
    contact_resistances_[contact->first * materials + contact->second] = contact->resistance;
    contact_resistances_[contact->second * materials + contact->first] = contact->resistance;
  }
  for (const CrackSurface& crack : body.cracks) {
    const auto box = crack.bounds();
    all_.cracks.push_back({&crack, crack.parts_in(box[0], box[1])});
  }
}

NearbyCracks BondTracer::cracks_in(const Point& lower, const Point& upper) const {
  NearbyCracks nearby;
  for (const CrackSurface& crack : body_.cracks) {
    std::vector<int> parts = crack.parts_in(lower, upper);
    if (!parts.empty()) nearby.cracks.push_back({&crack, std::move(parts)});
  }
  return nearby;
}

bool BondTracer::is_inside(const Point& x) const {
  for (int axis = 0; axis < body_.grid.dimension; ++axis) {
    if (x[axis] < lower_[axis] || x[axis] > upper_[axis]) return false;
  }
  return true;
}

/// Mirrors x by the reflections that bring `within` into the box.
Point BondTracer::fold(const Point& x, const Point& within) const {
  Point folded = x;
  for (int axis = 0; axis < body_.grid.dimension; ++axis) {
    if (within[axis] < lower_[axis]) folded[axis] = 2.0 * lower_[axis] - x[axis];
    if (within[axis] > upper_[axis]) folded[axis] = 2.0 * upper_[axis] - x[axis];
  }
  return folded;
}

/// What cracks do to the piece of a bond in an image of the body.
void BondTracer::append_crossings_of(const NearbyCracks& nearby, const Piece& piece, int image, BondPath& path) {
  int number = image;
  for (const auto& [crack, parts] : nearby.cracks) {
    number += most_images;
    const auto passage = crack->passage(piece.begin, piece.end, parts);
    if (!passage) continue;
    const double time = passage->time;
    // What mirroring faces leave of a bond is in its face share.
    if (crack->mirrors()) {
      path.crossings.push_back({time, 1.0, crack->grows(), false, number});
      continue;
    }
    const double open = crack->transmission(dot(piece.bond, crack->normal_of(passage->part)), path.conductivity);
    const auto with_contact = [open](double share) { return open + (1.0 - open) * share; };
    path.crossings.push_back({time, with_contact(crack->contact(time)), crack->grows(), false, number});
    for (const ContactChange& change : crack->contact_changes()) {
      if (change.time > time) path.crossings.push_back({change.time, with_contact(change.share), true, false, number});
    }
  }
}

/// A fictitious point moves as the mirror image of the point that it mirrors.
Point BondTracer::off_cracks(const NearbyCracks& nearby, const Point& x) const {
  Point shift{};
  if (is_inside(x)) {
    for (const auto& [crack, parts] : nearby.cracks) crack->nudge(x, shift, parts);
    return {x[0] + shift[0], x[1] + shift[1], x[2] + shift[2]};
  }
  const Point inside = fold(x, x);
  for (const auto& [crack, parts] : nearby.cracks) crack->nudge(inside, shift, parts);
  Point moved = x;
  for (int axis = 0; axis < body_.grid.dimension; ++axis) {
    const bool mirrored = x[axis] < lower_[axis] || x[axis] > upper_[axis];
    moved[axis] += mirrored ? -shift[axis] : shift[axis];
  }
  return moved;
}

void BondTracer::cut_at_walls(const Point& a, const Point& b, std::vector<Piece>& pieces) const {
  const Point bond = difference(b, a);
  if (is_inside(a) && is_inside(b)) {
    pieces.assign(1, {a, b, 1.0, bond});
    return;
  }
  thread_local std::vector<double> shares;
  shares.assign({0.0, 1.0});
  for (int axis = 0; axis < body_.grid.dimension; ++axis) {
    for (const double wall : {lower_[axis], upper_[axis]}) {
      if ((a[axis] < wall) != (b[axis] < wall)) {
        shares.push_back(std::clamp((wall - a[axis]) / bond[axis], 0.0, 1.0));
      }
    }
  }
  std::sort(shares.begin(), shares.end());
  pieces.clear();
  for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
    if (shares[k + 1] <= shares[k]) continue;
    const Point middle = between(a, b, 0.5 * (shares[k] + shares[k + 1]));
    Piece piece{fold(between(a, b, shares[k]), middle), fold(between(a, b, shares[k + 1]), middle),
                shares[k + 1] - shares[k], bond};
    for (int axis = 0; axis < body_.grid.dimension; ++axis) {
      if (middle[axis] < lower_[axis] || middle[axis] > upper_[axis]) piece.bond[axis] = -bond[axis];
    }
    pieces.push_back(piece);
  }
}

void BondTracer::cut_at_surfaces(const std::vector<Piece>& pieces, std::vector<Stretch>& stretches) const {
  thread_local std::vector<double> shares;
  stretches.clear();
  for (const Piece& piece : pieces) {
    shares.assign({0.0, 1.0});
    for (const MaterialRegion& region : body_.regions) {
      append_crossings(region.shape, piece.begin, piece.end, shares);
    }
    std::sort(shares.begin(), shares.end());
    for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
      const double length = shares[k + 1] - shares[k];
      if (length < 1e-9) continue;
      const Point middle = between(piece.begin, piece.end, 0.5 * (shares[k] + shares[k + 1]));
      stretches.push_back({between(piece.begin, piece.end, shares[k]), between(piece.begin, piece.end, shares[k + 1]),
                           piece.share * length, body_.region_at(middle), piece.bond});
    }
  }
}

double BondTracer::conductivity_along(const std::vector<Stretch>& stretches, MaterialIndex a, MaterialIndex b) const {
  double resistance = 0.0;
  double first = 0.0, last = 0.0;
  for (const Stretch& stretch : stretches) {
    const MaterialIndex material = body_.material_of_region(stretch.region);
    if (material == no_material) return 0.0;
    last = body_.materials[material].conductivity;
    if (first == 0.0) first = last;
    resistance += stretch.share / last;
  }
  if (body_.interface == InterfaceRule::length_weighted_harmonic) {
    if (!contact_resistances_.empty()) resistance += contact_resistance(stretches);
    return 1.0 / resistance;
  }
  if (body_.interface == InterfaceRule::sided_harmonic) return bond_conductivity(body_.interface, first, last);
  return bond_conductivity(body_.interface, body_.materials[a].conductivity, body_.materials[b].conductivity);
}

/// Σ R / (|ξ| cosθ) over the surfaces that a bond crosses [m K/W], those included that its ends stand on: a point on a
/// surface belongs to one side of it.
double BondTracer::contact_resistance(const std::vector<Stretch>& stretches) const {
  const Stretch& first = stretches.front();
  const Stretch& last = stretches.back();
  Stretch end = first;
  end.region = body_.region_at(first.begin);
  double sum = contact_resistance(end, first, first.begin);
  for (std::size_t k = 1; k < stretches.size(); ++k) {
    sum += contact_resistance(stretches[k - 1], stretches[k], stretches[k].begin);
  }
  end.bond = last.bond;
  end.region = body_.region_at(last.end);
  return sum + contact_resistance(last, end, last.end);
}

/// On a wall the body goes on as its mirror image, and so does the surface: its normal lies along the wall.
Point BondTracer::along_walls(Point normal, const Point& place) const {
  const double slack = 1e-9 * body_.grid.spacing;
  for (int axis = 0; axis < body_.grid.dimension; ++axis) {
    const bool on_wall = place[axis] <= lower_[axis] + slack || place[axis] >= upper_[axis] - slack;
    if (on_wall && std::abs(normal[axis]) < 1.0 - 1e-9) normal[axis] = 0.0;
  }
  return unit_vector(normal);
}

double BondTracer::contact_resistance(const Stretch& before, const Stretch& after, const Point& place) const {
  const MaterialIndex from = body_.material_of_region(before.region);
  const MaterialIndex to = body_.material_of_region(after.region);
  if (from == to || from == no_material || to == no_material) return 0.0;
  const double resistance = contact_resistances_[from * body_.materials.size() + to];
  if (resistance == 0.0) return 0.0;
  // The later region overwrites the other one, so the surface between the two is its own.
  const bool leaves = before.region > after.region;
  const Shape& shape = body_.regions[static_cast<std::size_t>(std::max(before.region, after.region))].shape;
  // A bond that meets surface and mirror in one place has two directions there; what counts is what they share.
  const Point bond = between(before.bond, after.bond, 0.5);
  const Point outwards = scaled(bond, leaves ? 1.0 : -1.0);
  const Point normal = along_walls(surface_normal(shape, place, outwards, 1e-6 * body_.grid.spacing), place);
  // One that only grazes the surface gets an infinite resistance.
  return resistance / std::abs(dot(normal, bond));
}

void BondTracer::trace(const NearbyCracks& nearby, Point a, MaterialIndex material_a, Point b, MaterialIndex material_b,
                       BondPath& path) const {
  trace_cracks(nearby, a, material_a, b, material_b, path);
  path.face_share = 1.0;
  path.faces.clear();
  if (!body_.faces.empty()) body_.faces.look_up(body_.grid, a, b, path.face_share, path.faces);
  if (path.conductivity != 0.0) {
    const auto time = body_.broken.time_of(a, b);
    if (time) path.crossings.push_back({std::max(*time, 0.0), body_.broken.transmission(), *time > 0.0, true});
  }
  if (path.crossings.size() < 2) return;
  std::stable_sort(path.crossings.begin(), path.crossings.end(),
                   [](const Crossing& first, const Crossing& second) { return first.time < second.time; });
}

void BondTracer::trace_cracks(const NearbyCracks& nearby, Point a, MaterialIndex material_a, Point b,
                              MaterialIndex material_b, BondPath& path) const {
  path.crossings.clear();
  path.conductivity = 0.0;
  if (material_a == no_material || material_b == no_material) return;
  if (b < a) {
    std::swap(a, b);
    std::swap(material_a, material_b);
  }
  path.conductivity = body_.materials[material_a].conductivity;
  if (uniform_ && nearby.empty()) return;
  thread_local std::vector<Piece> pieces;
  if (!uniform_) {
    thread_local std::vector<Stretch> stretches;
    cut_at_walls(a, b, pieces);
    cut_at_surfaces(pieces, stretches);
    path.conductivity = conductivity_along(stretches, material_a, material_b);
  }
  if (nearby.empty()) return;
  cut_at_walls(off_cracks(nearby, a), off_cracks(nearby, b), pieces);
  int image = 0;
  for (const Piece& piece : pieces) append_crossings_of(nearby, piece, image++, path);
}

void RemainingShare::pass(const Crossing& crossing) {
  if (crossing.by_elongation) {
    broken_ *= crossing.transmission;
    return;
  }
  const auto same = std::find_if(passed_.begin(), passed_.end(),
                                 [&](const Passed& passed) { return passed.crack == crossing.crack; });
  if (same == passed_.end()) {
    passed_.push_back({crossing.crack, crossing.transmission});
  } else {
    same->transmission = crossing.transmission;
  }
  cracks_ = 1.0;
  for (const Passed& passed : passed_) cracks_ *= passed.transmission;
}

double standing_share(const BondPath& path) {
  RemainingShare share;
  for (const Crossing& crossing : path.crossings) {
    if (!crossing.in_time) share.pass(crossing);
  }
  return path.face_share * share.value();
}

void append_changes(const BondPath& path, std::vector<ShareRamp>& ramps) {
  thread_local std::vector<double> times;
  times.clear();
  RemainingShare share;
  for (const Crossing& crossing : path.crossings) {
    if (crossing.in_time) {
      times.push_back(crossing.time);
    } else {
      share.pass(crossing);
    }
  }
  for (const ShareKnot& knot : path.faces) times.push_back(knot.time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const auto of_faces = [&path](double time, Side side) {
    return path.faces.empty() ? path.face_share : share_at(path.faces, time, side);
  };
  auto next = path.crossings.begin();
  double last = path.face_share * share.value();
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double before = of_faces(times[k], Side::before) * share.value();
    if (k > 0 && before != last) ramps.push_back({times[k - 1], times[k], last, before});
    for (; next != path.crossings.end() && next->time <= times[k]; ++next) {
      if (next->in_time) share.pass(*next);
    }
    const double after = of_faces(times[k], Side::after) * share.value();
    if (after != before) ramps.push_back({times[k], times[k], before, after});
    last = after;
  }
}

}  // namespace peritherm
