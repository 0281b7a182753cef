#include <gtest/gtest.h>

#include <cmath>

#include "peritherm/base/error.hpp"
#include "peritherm/reduction/answer.hpp"

namespace peritherm {
namespace {

std::vector<Point> line(std::size_t count) {
  std::vector<Point> places;
  for (std::size_t n = 0; n < count; ++n)
    places.push_back({static_cast<double>(n) / static_cast<double>(count - 1), 0, 0});
  return places;
}

/// Largest difference between a profile and what its inputs make of the shapes, over places and times.
double misfit(const Load& load, const Profile& profile, double level, double end) {
  LoadReader reader(load, profile, level, end);
  CompiledProfile compiled(profile);
  std::vector<CompiledProfile> shapes;
  for (const LoadShape& shape : load.shapes) shapes.emplace_back(shape.profile);
  std::vector<double> inputs(shapes.size());
  double largest = 0.0;
  for (int n = 0; n <= 50; ++n) {
    const double time = end * n / 50;
    reader.read(time, inputs);
    for (const Point& place : line(77)) {
      double value = load.kind == LoadKind::temperature ? level : 0.0;
      for (std::size_t k = 0; k < shapes.size(); ++k) value += inputs[k] * shapes[k](place, load.shapes[k].time);
      largest = std::max(largest, std::abs(value - compiled(place, time)));
    }
  }
  return largest;
}

TEST(FindLoad, takes_one_shape_where_one_will_do) {
  for (const LoadKind kind : {LoadKind::temperature, LoadKind::heat}) {
    for (const Profile& profile : {Profile(3.0), Profile("sin(t)*exp(-t)")}) {
      const Load load = find_load(profile, kind, line(30), 2.0);
      EXPECT_EQ(load.shapes.size(), 1U);
      EXPECT_EQ(load.shapes[0].profile, Profile(1.0));
      EXPECT_TRUE(load.places.empty());
      EXPECT_LE(misfit(load, profile, 1.5, 2.0), 1e-15);
    }
  }
  const Load heat = find_load(Profile("1 + x"), LoadKind::heat, line(30), 2.0);
  EXPECT_EQ(heat.shapes.size(), 1U);
  EXPECT_LE(misfit(heat, Profile("(1 + x)*t"), 1.5, 2.0), 1e-15);
}

TEST(FindLoad, lets_temperatures_make_a_constant) {
  const Load load = find_load(Profile("300*x"), LoadKind::temperature, line(30), 2.0);
  EXPECT_EQ(load.shapes.size(), 2U);
  EXPECT_LE(misfit(load, Profile("5 + 7*x*cos(t)"), 293.0, 2.0), 1e-12);
}

TEST(FindLoad, finds_as_many_shapes_as_a_load_has_products) {
  const Profile profile("sin(t)*x + cos(t)*x^2 + exp(-1000*t)*x^3");
  const Load heat = find_load(profile, LoadKind::heat, line(200), 3.0);
  EXPECT_EQ(heat.shapes.size(), 3U);
  EXPECT_LE(misfit(heat, profile, 0.0, 3.0), 1e-9);
  const Load held = find_load(profile, LoadKind::temperature, line(200), 3.0);
  EXPECT_EQ(held.shapes.size(), 4U);
  EXPECT_LE(misfit(held, profile, 20.0, 3.0), 1e-9);
  // A load that is no finite sum of products, to the tolerance asked for.
  const Profile travelling("exp(-(x - 0.3*t)^2)");
  const Load many = find_load(travelling, LoadKind::heat, line(200), 3.0, 1e-8, 16);
  EXPECT_LE(many.shapes.size(), 16U);
  EXPECT_LE(misfit(many, travelling, 0.0, 3.0), 1e-6);
}

TEST(FindLoad, gives_up_where_patterns_have_no_end) {
  EXPECT_THROW(find_load(Profile("abs(x - t) < 0.01"), LoadKind::heat, line(400), 1.0), Error);
}

TEST(LoadReader, refuses_loads_beyond_the_span) {
  const Load load = find_load(Profile("x"), LoadKind::temperature, line(30), 2.0);
  Load named = load;
  named.key = "boundary.2.value";
  try {
    LoadReader(named, Profile("x^2"), 0.0, 2.0);
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("boundary.2.value: is no combination of the patterns"), std::string::npos) << text;
    EXPECT_NE(text.find("reduce the case again with this load"), std::string::npos) << text;
  }
  // Within the span at first, beyond it later.
  LoadReader late(named, Profile("x + (t > 1)*x^2"), 0.0, 2.0);
  std::vector<double> inputs(2);
  late.read(0.5, inputs);
  EXPECT_NEAR(inputs[0] * 1.0 + inputs[1] * 0.5, 0.5, 1e-15);
  EXPECT_THROW(
      {
        for (int n = 0; n < 16; ++n) late.read(1.5, inputs);
      },
      Error);
}

TEST(LoadReader, takes_a_shape_of_zeros_for_what_it_is) {
  const Load load = find_load(Profile("0*x"), LoadKind::heat, line(10), 1.0);
  EXPECT_LE(misfit(load, Profile(4.0), 0.0, 1.0), 1e-15);
}

}  // namespace
}  // namespace peritherm
