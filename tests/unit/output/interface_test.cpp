#include <cmath>
#include <numbers>

#include "peritherm/output/interface_lines.hpp"
#include "peritherm/output/linear_fit.hpp"
#include "support/tolerance.hpp"
#include "unit/output/output_fixture.hpp"
#include "unit/output/read_picture.hpp"

namespace peritherm {
namespace {

using InsideShape = std::function<bool(const Point&)>;

double outside_slope(const Point& x) { return 300.0 + 3.0 * x[0] - 2.0 * x[1] + 0.5 * x[2]; }
double inside_slope(const Point& x) { return 20.0 - x[0] + 4.0 * x[1] + 7.0 * x[2]; }

/// A body with a part of material 1, linear in each, whose temperature jumps between them.
struct TouchingBody {
  TouchingBody(const Grid& grid, InsideShape shape)
      : inside(std::move(shape)), body(grid, [this](const Point& x) { return expected(x); }) {
    for (std::size_t n = 0; n < grid.size(); ++n) body.materials[n] = material_at(grid.position(grid.index(n)));
  }
  MaterialIndex material_at(const Point& x) const { return inside(x) ? 1 : 0; }
  double expected(const Point& x) const { return inside(x) ? inside_slope(x) : outside_slope(x); }
  Snapshot snapshot() const {
    Snapshot snapshot = body.snapshot(1.0);
    snapshot.jumps = {[this](const Point& x) { return material_at(x); },
                      [](MaterialIndex, MaterialIndex, const Point&) { return true; }};
    return snapshot;
  }
  InsideShape inside;
  SampleBody body;
};

Grid unit_grid(int dimension, int cells, PointPlacement placement = PointPlacement::centres) {
  return {dimension, 1.0 / cells, {cells, dimension > 1 ? cells : 1, dimension > 2 ? cells : 1}, {}, placement};
}

/// A ball, disc or piece of a bar, off the middle of everything.
constexpr Point ball_centre{0.51, 0.48, 0.53};
InsideShape ball(int dimension) {
  return [dimension](const Point& x) {
    double square = 0.0;
    for (int axis = 0; axis < dimension; ++axis) square += std::pow(x[axis] - ball_centre[axis], 2);
    return square < 0.09;
  };
}

/// Weights of a fit to some 64 points fall from 10¹² to 10⁻², which costs half of the digits at most beside a point.
constexpr double fit_rounding = 1e-8;

TEST(Interfaces, a_fit_meets_linear_fields_and_leaves_out_directions_without_points) {
  LinearFit fit(3);
  for (const Point& arm : {Point{0.2, 0.5, 0.1}, {1.2, 0.5, 0.1}, {0.2, 1.5, 0.1}, {-0.8, -0.5, 0.1}}) {
    fit.add(arm, 5.0 + 2.0 * arm[0] - arm[1]);
  }
  EXPECT_NEAR(fit.value(), 5.0, 1e-12) << "nothing is known along the third axis";
  LinearFit single(2);
  EXPECT_TRUE(single.empty());
  single.add({0.5, 0.5, 0.0}, 3.0);
  EXPECT_NEAR(single.value(), 3.0, rounding(4, 3.0));
}

TEST(Interfaces, places_beside_one_have_the_temperature_of_their_side) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (const PointPlacement placement : {PointPlacement::centres, PointPlacement::boundary}) {
      const TouchingBody touching(unit_grid(dimension, 10, placement), ball(dimension));
      const Snapshot snapshot = touching.snapshot();
      for (int k = 0; k < 60; ++k) {
        const double angle = 0.1 * k, rise = std::cos(0.37 * k);
        for (const double radius : {0.29, 0.2999, 0.3001, 0.31}) {
          Point x{0.51 + radius * (dimension == 1 ? (k % 2 == 0 ? 1.0 : -1.0) : std::cos(angle)), 0.0, 0.0};
          if (dimension == 2) x[1] = 0.48 + radius * std::sin(angle);
          if (dimension == 3) {
            const double across = std::sqrt(1.0 - rise * rise);
            x = {0.51 + radius * across * std::cos(angle), 0.48 + radius * across * std::sin(angle),
                 0.53 + radius * rise};
          }
          EXPECT_NEAR(temperature_at(snapshot, x), touching.expected(x), fit_rounding) << dimension;
        }
      }
    }
  }
}

TEST(Interfaces, a_perfect_contact_and_a_part_without_points_change_nothing) {
  const TouchingBody touching(unit_grid(2, 10), ball(2));
  Snapshot perfect = touching.snapshot();
  perfect.jumps.may_jump = [](MaterialIndex, MaterialIndex, const Point&) { return false; };
  const Point beside{0.51 + 0.299, 0.48, 0.0};
  EXPECT_EQ(temperature_at(perfect, beside), temperature_at(touching.body.snapshot(1.0), beside));
  const TouchingBody speck(unit_grid(2, 10), [](const Point& x) { return std::hypot(x[0] - 0.5, x[1] - 0.5) < 0.01; });
  const Point in_speck{0.5, 0.5, 0.0};
  EXPECT_NEAR(temperature_at(speck.snapshot(), in_speck), outside_slope(in_speck), rounding(8, 300.0));
}

TEST(Interfaces, sections_never_mix_the_sides_of_a_ball) {
  const TouchingBody touching(unit_grid(3, 10), ball(3));
  PictureOutput options;
  options.normal = AxisName::x;
  for (const double at : {0.55, 0.5, 0.53, 0.77}) {
    options.at = at;
    // Between layers of points, one of them may be all that stands on a side: then by at most half a spacing off in x,
    // which a fit may double.
    const double slack = at == 0.55 ? fit_rounding : 2.0 * 3.0 * 0.05;
    const Section section = make_section(touching.snapshot(), options);
    const SectionSampler sampler(section, Smoothing::bilinear);
    for (int j = 0; j <= 50; ++j) {
      for (int i = 0; i <= 50; ++i) {
        const Point x{at, 0.1 + 0.016 * i, 0.1 + 0.016 * j};
        EXPECT_NEAR(sampler({x[1], x[2]}), touching.expected(x), slack) << x[1] << ' ' << x[2];
      }
    }
  }
}

TEST(Interfaces, a_disc_has_one_closed_line_around_it) {
  const TouchingBody touching(unit_grid(2, 20), ball(2));
  const Section section = make_section(touching.snapshot(), {});
  const SectionSampler sampler(section, Smoothing::bilinear);
  const double step = 0.01;
  const InterfaceLines found = find_interfaces(sampler, {{0.0, 0.0}, {step, step}, 101, 101});
  double length = 0.0;
  for (const Line& line : found.lines) {
    ASSERT_EQ(line.size(), 2U);
    for (const Place& place : line) {
      // Ten halvings of an edge.
      EXPECT_NEAR(std::hypot(place.x - 0.51, place.y - 0.48), 0.3, step / 1024.0);
    }
    length += std::hypot(line[1].x - line[0].x, line[1].y - line[0].y);
  }
  // Chords of at most √2 steps are shorter than their arcs by 1/24 (chord / radius)²; their ends are off by a
  // thousandth.
  EXPECT_NEAR(length, 0.6 * std::numbers::pi, 0.6 * std::numbers::pi * (2.0 * step * step / 0.09 / 24.0 + 1e-3));
  EXPECT_EQ(static_cast<std::size_t>(std::count(found.crossed.begin(), found.crossed.end(), true)), found.lines.size());
}

TEST(Interfaces, the_end_of_a_shape_with_the_body_is_none) {
  const TouchingBody touching(unit_grid(2, 20),
                              [](const Point& x) { return x[0] >= 0.5 && x[0] <= 1.0 && x[1] >= 0.0 && x[1] <= 1.0; });
  const Section section = make_section(touching.snapshot(), {});
  const SectionSampler sampler(section, Smoothing::bilinear);
  // A lattice that goes on beyond the body, as that of a picture may.
  for (const Line& line : find_interfaces(sampler, {{-0.005, -0.005}, {0.01, 0.01}, 102, 102}).lines) {
    for (const Place& place : line) EXPECT_NEAR(place.x, 0.5, 0.01 / 1024.0);
  }
}

TEST(Interfaces, lines_meet_where_three_materials_do) {
  const Grid grid = unit_grid(2, 10);
  SampleBody body(grid, [](const Point&) { return 1.0; });
  const auto material = [](const Point& x) -> MaterialIndex { return x[1] > 0.5 ? 2 : x[0] > 0.5 ? 1 : 0; };
  for (std::size_t n = 0; n < grid.size(); ++n) body.materials[n] = material(grid.position(grid.index(n)));
  Snapshot snapshot = body.snapshot(0.0);
  snapshot.jumps = {material, [](MaterialIndex, MaterialIndex, const Point&) { return true; }};
  const Section section = make_section(snapshot, {});
  const SectionSampler sampler(section, Smoothing::bilinear);
  const InterfaceLines all = find_interfaces(sampler, {{0.005, 0.005}, {0.01, 0.01}, 100, 100});
  double length = 0.0;
  for (const Line& line : all.lines) length += std::hypot(line[1].x - line[0].x, line[1].y - line[0].y);
  // Lines of 0.99 and 0.495, to a cell of the lattice where they meet.
  EXPECT_NEAR(length, 0.99 + 0.495, 0.02);
}

TEST(Interfaces, a_bar_has_its_interface_where_the_shape_ends) {
  const TouchingBody touching(unit_grid(1, 10), [](const Point& x) { return x[0] >= 0.47; });
  const Section section = make_section(touching.snapshot(), {});
  ASSERT_EQ(section.cracks.size(), 1U);
  EXPECT_NEAR(section.cracks[0][0].x, 0.47, 1e-12);
  EXPECT_TRUE(separated_in_bar(section.cracks, 0.45, 0.55));
}

class InterfacePicture : public OutputTest {
 protected:
  /// Pixels of a colour in the rows from a third to a half of the height of a picture.
  static long pixels_between(const ReadPicture& picture, std::uint32_t colour) {
    const auto first = picture.pixels.begin() + picture.height / 3 * picture.width;
    return std::count(first, first + picture.height / 6 * picture.width, colour);
  }
};

TEST_F(InterfacePicture, a_disc_is_surrounded_by_a_black_line) {
  const TouchingBody touching(unit_grid(2, 20), ball(2));
  const auto observer = make_observer(PictureOutput{}, folder_);
  observer->observe(touching.snapshot());
  // π 0.6 of a plot of at least 600 pixels, 3.4 pixels wide, of which two are covered whole.
  EXPECT_GT(ReadPicture(observer->files().at(0)).count(0x000000), 2 * 600 * 1.8);
}

TEST_F(InterfacePicture, curves_of_a_line_break_at_a_jump_computed_and_exact) {
  const Grid grid = unit_grid(1, 20);
  SampleBody body(grid, [](const Point& x) { return x[0] < 0.5 ? 1.0 : 0.0; });
  const auto material = [](const Point& x) -> MaterialIndex { return x[0] < 0.5 ? 0 : 1; };
  for (std::size_t n = 0; n < grid.size(); ++n) body.materials[n] = material(grid.position(grid.index(n)));
  Snapshot snapshot = body.snapshot(1.0);
  LineOutput options;
  const auto drawn = [&](const std::string& stem) {
    options.stem = stem;
    const auto observer = make_observer(options, folder_);
    observer->observe(snapshot);
    return pixels_between(ReadPicture(observer->files().at(1)), 0x1d4e9e);
  };
  EXPECT_GT(drawn("across"), 0) << "a steep line where nothing is known of a jump";
  snapshot.jumps = {material, [](MaterialIndex, MaterialIndex, const Point&) { return true; }};
  EXPECT_EQ(drawn("broken"), 0);
  RampedLayers exact;
  exact.lengths = {0.5, 0.5};
  exact.conductivities = {1e3, 1e3};
  exact.heat_capacities = {1.0, 1.0};
  exact.resistances = std::vector<double>{1e9};
  exact.rise_time = 1e-3;
  exact.held = 1.0;
  options.exact = exact;
  EXPECT_EQ(drawn("exact"), 0);
}

}  // namespace
}  // namespace peritherm
