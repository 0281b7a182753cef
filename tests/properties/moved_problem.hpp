#pragma once

#include <algorithm>
#include <utility>

#include "peritherm/simulation/problem.hpp"

namespace peritherm {

/// A shape whose corners and centres go where `move` puts them; boxes stay boxes.
template <class Move>
Shape moved_shape(Shape shape, const Move& move) {
  if (auto* box = std::get_if<Box>(&shape)) {
    box->from = move(box->from);
    box->to = move(box->to);
    for (std::size_t axis = 0; axis < box->from.size(); ++axis) {
      if (box->from[axis] > box->to[axis]) std::swap(box->from[axis], box->to[axis]);
    }
  }
  if (auto* ball = std::get_if<Ball>(&shape)) ball->centre = move(ball->centre);
  if (auto* polygon = std::get_if<Polygon>(&shape)) {
    for (Coordinates& corner : polygon->points) corner = move(corner);
  }
  return shape;
}

/// `move` must keep distances.
template <class Move>
Crack moved_crack(Crack crack, const Move& move) {
  for (Coordinates& point : crack.points) point = move(point);
  if (!crack.disc) return crack;
  Coordinates tip = crack.disc->centre;
  for (std::size_t axis = 0; axis < tip.size(); ++axis) tip[axis] += crack.disc->normal[axis];
  tip = move(tip);
  crack.disc->centre = move(crack.disc->centre);
  for (std::size_t axis = 0; axis < tip.size(); ++axis) crack.disc->normal[axis] = tip[axis] - crack.disc->centre[axis];
  return crack;
}

/// Everything inside the box goes where `move` puts it; the box itself stays, but for its lower corner.
template <class Move>
Problem with_contents_moved(Problem problem, const Move& move) {
  for (BodyRegion& region : problem.body.regions) region.shape = moved_shape(region.shape, move);
  for (Crack& crack : problem.cracks) crack = moved_crack(crack, move);
  for (HeatSource& source : problem.sources) {
    if (source.where) source.where = moved_shape(*source.where, move);
  }
  for (BoundaryOptions& boundary : problem.boundaries) {
    if (boundary.where) boundary.where = moved_shape(*boundary.where, move);
  }
  return problem;
}

template <class Shift>
Problem moved_problem(const Problem& problem, const Shift& shift) {
  Problem moved = with_contents_moved(problem, shift);
  moved.body.origin = shift(*problem.body.origin);
  return moved;
}

/// What lies left comes to lie right.
inline Problem mirrored_problem(const Problem& problem, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  const double sum = 2.0 * (*problem.body.origin)[a] + problem.body.size[a];
  Problem mirrored = with_contents_moved(problem, [a, sum](Coordinates place) {
    if (a < place.size()) place[a] = sum - place[a];
    return place;
  });
  for (BoundaryOptions& boundary : mirrored.boundaries) {
    if (boundary.face && axis_of(*boundary.face) == axis) boundary.face = make_face(axis, !is_upper(*boundary.face));
  }
  return mirrored;
}

inline Problem with_axes_exchanged(const Problem& problem, int first, int second) {
  const auto exchange = [first, second](auto values) {
    std::swap(values[static_cast<std::size_t>(first)], values[static_cast<std::size_t>(second)]);
    return values;
  };
  Problem exchanged = with_contents_moved(problem, exchange);
  exchanged.body.origin = exchange(*problem.body.origin);
  exchanged.body.size = exchange(problem.body.size);
  exchanged.body.cells = exchange(*problem.body.cells);
  for (BoundaryOptions& boundary : exchanged.boundaries) {
    if (!boundary.face) continue;
    const int axis = axis_of(*boundary.face);
    const int other = axis == first ? second : (axis == second ? first : axis);
    boundary.face = make_face(other, is_upper(*boundary.face));
  }
  return exchanged;
}

/// Numbers that lengths, conductivities and heat capacities are multiplied by.
struct Units {
  double length, conductivity, capacity;
  double time() const { return capacity * length * length / conductivity; }
};

inline void change_units(BoundaryCondition& condition, const Units& units) {
  const auto scale = [](Profile& profile, double factor) { profile.value = factor * std::get<double>(profile.value); };
  if (auto* flux = std::get_if<PrescribedFlux>(&condition)) scale(flux->value, units.conductivity / units.length);
  if (auto* convection = std::get_if<Convection>(&condition)) {
    convection->coefficient *= units.conductivity / units.length;
  }
  if (auto* held = std::get_if<HeldTemperature>(&condition); held != nullptr && held->thickness) {
    *held->thickness *= units.length;
  }
}

/// The same body measured in other units; temperatures stay.
inline Problem in_units(const Problem& problem, const Units& units) {
  const auto scale = [&units](Coordinates place) {
    for (double& coordinate : place) coordinate *= units.length;
    return place;
  };
  Problem scaled = with_contents_moved(problem, scale);
  for (BodyRegion& region : scaled.body.regions) {
    if (auto* ball = std::get_if<Ball>(&region.shape)) ball->radius *= units.length;
  }
  for (BoundaryOptions& boundary : scaled.boundaries) {
    if (boundary.where) {
      if (auto* ball = std::get_if<Ball>(&*boundary.where)) ball->radius *= units.length;
    }
    change_units(boundary.condition, units);
  }
  for (HeatSource& source : scaled.sources) {
    source.value = std::get<double>(source.value.value) * units.conductivity / (units.length * units.length);
  }
  for (Crack& crack : scaled.cracks) {
    if (crack.disc) crack.disc->radius *= units.length;
    if (crack.tip_speed) *crack.tip_speed *= units.length / units.time();
    crack.start_time *= units.time();
  }
  for (ContactOptions& contact : scaled.contacts) {
    auto& resistance = std::get<ContactResistance>(contact.law).value;
    resistance = std::get<double>(resistance.value) * units.length / units.conductivity;
  }
  for (auto& [name, material] : scaled.materials) {
    material.conductivity *= units.conductivity;
    material.specific_heat *= units.capacity;
  }
  scaled.body.origin = scale(*problem.body.origin);
  scaled.body.size = scale(problem.body.size);
  scaled.time.end *= units.time();
  return scaled;
}

}  // namespace peritherm
