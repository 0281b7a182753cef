#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "peritherm/discretisation/bond_path.hpp"
#include "peritherm/geometry/vector.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

constexpr double inner_conductivity = 10.0;
constexpr double contact_value = 0.25;

/// A square of ten cells of edge 1, of conductivity 1 but in a shape; R = 0.25 between the two.
Body square_in_contact(const Shape& shape, double resistance = contact_value) {
  Body body;
  body.grid.dimension = 2;
  body.grid.cells = {10, 10, 1};
  body.materials = {{1.0, 1.0, 1.0}, {inner_conductivity, 1.0, 1.0}, {2.0, 1.0, 1.0}};
  body.regions = {{shape, 1}};
  body.contacts = {{0, 1, resistance}};
  body.assign_materials();
  return body;
}

double traced_conductivity(const Body& body, const Point& a, const Point& b) {
  BondPath path, back;
  const BondTracer tracer(body);
  tracer.trace(a, body.material_at(a), b, body.material_at(b), path);
  tracer.trace(b, body.material_at(b), a, body.material_at(a), back);
  EXPECT_EQ(path.conductivity, back.conductivity);
  return path.conductivity;
}

TEST(ContactPath, a_bond_across_gets_the_resistance_over_the_cosine_in_series) {
  const Body body = square_in_contact(HalfSpace{{1.0, 0.0}, 5.0});
  for (const double angle : {0.0, 0.3, -1.1, 1.5}) {
    const double inside = 0.7, outside = 1.1;  // along the bond
    const Point direction{std::cos(angle), std::sin(angle), 0.0};
    const Point a = difference({5.0, 5.0, 0.0}, scaled(direction, inside));
    const Point b = difference({5.0, 5.0, 0.0}, scaled(direction, -outside));
    const double series = inside / inner_conductivity + outside + contact_value / std::cos(angle);
    // Of the place of crossing rounding leaves some ε over the cosine.
    const double expected = (inside + outside) / series;
    EXPECT_NEAR(traced_conductivity(body, a, b), expected, rounding(10, expected) / std::cos(angle)) << angle;
  }
}

TEST(ContactPath, every_bond_across_carries_its_share_of_a_flux_straight_through) {
  const double slope = 0.4;
  const Point normal{std::cos(slope), std::sin(slope), 0.0};
  const Body body = square_in_contact(HalfSpace{{normal[0], normal[1]}, 6.0});
  const double flux = 3.0;
  const auto temperature = [&](const Point& x) {
    const double height = dot(normal, x) - 6.0;
    return height <= 0.0 ? -flux * height / inner_conductivity : -flux * (contact_value + height);
  };
  for (const Point& b : {Point{7.5, 5.5, 0.0}, Point{6.5, 7.5, 0.0}, Point{4.5, 6.5, 0.0}}) {
    const Point a{4.5, 4.5, 0.0};
    const double carried = traced_conductivity(body, a, b) * (temperature(a) - temperature(b));
    EXPECT_NEAR(carried, flux * dot(normal, difference(b, a)), rounding(20, flux * 3.0));
  }
}

TEST(ContactPath, a_bond_that_stays_on_one_side_meets_no_contact) {
  const Body body = square_in_contact(HalfSpace{{1.0, 0.0}, 5.0});
  EXPECT_DOUBLE_EQ(traced_conductivity(body, {2.5, 2.5, 0.0}, {4.5, 5.5, 0.0}), inner_conductivity);
  EXPECT_DOUBLE_EQ(traced_conductivity(body, {5.5, 2.5, 0.0}, {7.5, 5.5, 0.0}), 1.0);
}

TEST(ContactPath, a_bond_through_a_body_meets_it_twice) {
  const Body body = square_in_contact(Ball{{5.0, 5.0}, 1.0});
  const double chord = 1.2, cosine = 0.6;
  const double series = chord / inner_conductivity + (4.0 - chord) + 2.0 * contact_value / cosine;
  EXPECT_NEAR(traced_conductivity(body, {3.0, 5.8, 0.0}, {7.0, 5.8, 0.0}), 4.0 / series, rounding(20, 4.0 / series));
}

TEST(ContactPath, a_point_on_the_surface_belongs_to_one_side_and_meets_the_contact_towards_the_other) {
  const Body body = square_in_contact(Box{{2.5, 0.0}, {5.5, 10.0}});
  const Point on{5.5, 4.5, 0.0};
  EXPECT_DOUBLE_EQ(traced_conductivity(body, on, {7.5, 4.5, 0.0}), 2.0 / (2.0 + contact_value));
  EXPECT_DOUBLE_EQ(traced_conductivity(body, on, {3.5, 4.5, 0.0}), inner_conductivity);
  EXPECT_DOUBLE_EQ(traced_conductivity(body, on, {5.5, 7.5, 0.0}), inner_conductivity);
  EXPECT_DOUBLE_EQ(traced_conductivity(body, on, {2.5, 4.5, 0.0}), inner_conductivity);
}

TEST(ContactPath, a_grazing_bond_conducts_nothing_and_never_less) {
  const Body body = square_in_contact(HalfSpace{{1.0, 0.0}, 5.0});
  double before = std::numeric_limits<double>::infinity();
  for (const double rise : {1e-1, 1e-3, 1e-5, 1e-7}) {
    const double now = traced_conductivity(body, {5.0 - rise, 4.5, 0.0}, {5.0 + rise, 6.5, 0.0});
    EXPECT_GT(now, 0.0);
    EXPECT_LT(now, before);
    before = now;
  }
  EXPECT_LT(before, 1e-6);
  // Two points on the surface belong to the same side.
  EXPECT_DOUBLE_EQ(traced_conductivity(body, {5.0, 4.5, 0.0}, {5.0, 6.5, 0.0}), inner_conductivity);
}

TEST(ContactPath, mirrored_bonds_meet_the_mirrored_contact) {
  const Body body = square_in_contact(Box{{3.0, 0.0}, {8.0, 2.0}});
  const double length_across = std::sqrt(8.0);
  // The first passes the surface before the mirror at y = 0, the second behind it, the third where the two meet.
  for (const double x : {2.7, 2.3, 2.5}) {
    const double share = (3.0 - x) / 2.0;
    const double series = length_across * (share + (1.0 - share) / inner_conductivity) + contact_value * std::sqrt(2.0);
    BondPath path;
    BondTracer(body).trace({x, 0.5, 0.0}, 0, {x + 2.0, -1.5, 0.0}, 1, path);
    EXPECT_NEAR(path.conductivity, length_across / series, rounding(20, length_across / series)) << x;
  }
}

TEST(ContactPath, edges_of_a_surface_resist_as_its_face_that_the_bond_goes_through) {
  const Body body = square_in_contact(Box{{3.0, 0.0}, {8.0, 2.0}});
  const double elsewhere = traced_conductivity(body, {2.5, 1.0, 0.0}, {3.5, 1.0, 0.0});
  EXPECT_DOUBLE_EQ(traced_conductivity(body, {2.5, 0.0, 0.0}, {3.5, 0.0, 0.0}), elsewhere);
  EXPECT_DOUBLE_EQ(traced_conductivity(body, {2.5, 2.0, 0.0}, {3.5, 2.0, 0.0}), elsewhere);
  // A point on an edge belongs to the box.
  const double inclined = traced_conductivity(body, {2.5, 0.5, 0.0}, {3.0, 1.0, 0.0});
  EXPECT_DOUBLE_EQ(traced_conductivity(body, {2.5, 0.5, 0.0}, {3.0, 0.0, 0.0}), inclined);
  EXPECT_DOUBLE_EQ(traced_conductivity(body, {2.5, 1.5, 0.0}, {3.0, 2.0, 0.0}), inclined);
}

TEST(ContactPath, a_crack_along_the_surface_leaves_the_sides_of_its_points_alone) {
  Body body = square_in_contact(Box{{2.5, 0.0}, {5.5, 10.0}});
  const double without = traced_conductivity(body, {5.5, 4.5, 0.0}, {7.5, 4.5, 0.0});
  Crack crack;
  crack.points = {{5.5, 0.0}, {5.5, 10.0}};
  crack.transmission = 0.5;
  body.cracks.emplace_back(crack, 2, 1.0);
  EXPECT_EQ(traced_conductivity(body, {5.5, 4.5, 0.0}, {7.5, 4.5, 0.0}), without);
}

TEST(ContactPath, without_resistance_or_between_other_materials_nothing_changes) {
  Body body = square_in_contact(Ball{{5.0, 5.0}, 1.7}, 0.0);
  Body plain = body;
  plain.contacts.clear();
  Body other = plain;
  other.contacts = {{1, 2, contact_value}};
  const Point a{3.5, 4.5, 0.0}, b{5.5, 5.5, 0.0};
  const double expected = traced_conductivity(plain, a, b);
  EXPECT_EQ(traced_conductivity(body, a, b), expected);
  EXPECT_EQ(traced_conductivity(other, a, b), expected);
}

TEST(ContactPath, equal_conductivities_on_both_sides_resist_as_well) {
  Body body = square_in_contact(HalfSpace{{1.0, 0.0}, 5.0});
  body.materials[1] = body.materials[0];
  EXPECT_DOUBLE_EQ(traced_conductivity(body, {4.5, 4.5, 0.0}, {6.5, 4.5, 0.0}), 2.0 / (2.0 + contact_value));
}

}  // namespace
}  // namespace peritherm
