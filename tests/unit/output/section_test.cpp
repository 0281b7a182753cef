#include "peritherm/output/section.hpp"

#include <cmath>

#include "support/tolerance.hpp"
#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

TEST(Section, a_slice_between_two_layers_is_their_mean) {
  const Grid grid{3, 1.0, {3, 4, 2}, {}, PointPlacement::centres};
  const SampleBody body(grid, [](const Point& x) { return x[0] + 10.0 * x[1] + 100.0 * x[2]; });
  const Section section = make_section(body.snapshot(0.0), {});
  EXPECT_EQ(section.x_name, "x");
  EXPECT_EQ(section.y_name, "y");
  EXPECT_EQ(section.place, "z = 1 m");
  EXPECT_EQ(section.x, (std::vector<double>{0.0, 0.5, 1.5, 2.5, 3.0}));
  // Nodes on faces carry the field on linearly.
  for (std::size_t j = 0; j < section.y.size(); ++j) {
    for (std::size_t i = 0; i < section.x.size(); ++i) {
      EXPECT_NEAR(section.value(i, j), section.x[i] + 10.0 * section.y[j] + 100.0, rounding(4, 200.0));
    }
  }
}

TEST(Section, a_slice_across_x_shows_y_and_z) {
  const Grid grid{3, 1.0, {3, 4, 2}, {}, PointPlacement::boundary};
  const SampleBody body(grid, [](const Point& x) { return x[0] + 10.0 * x[1] + 100.0 * x[2]; });
  PictureOutput options;
  options.normal = AxisName::x;
  options.at = 2.0;
  const Section section = make_section(body.snapshot(0.0), options);
  EXPECT_EQ(section.x_name, "y");
  EXPECT_EQ(section.y_name, "z");
  EXPECT_EQ(section.value(1, 2), 2.0 + 10.0 + 200.0);
}

TEST(Section, a_crack_polygon_is_drawn_where_it_meets_the_slice) {
  const std::vector<Point> square{{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 0.0, 2.0}, {0.0, 0.0, 2.0}};
  Section section;
  cut_cracks({square}, {2, 0, 1}, 0.5, 1e-9, section);
  ASSERT_EQ(section.cracks.size(), 1U);
  EXPECT_EQ(section.cracks[0], (Line{{0.0, 0.0}, {2.0, 0.0}}));
  Section beyond;
  cut_cracks({square}, {2, 0, 1}, 3.0, 1e-9, beyond);
  EXPECT_TRUE(beyond.cracks.empty());
  Section inside;
  cut_cracks({square}, {1, 0, 2}, 0.0, 1e-9, inside);
  EXPECT_TRUE(inside.cracks.empty());
  EXPECT_EQ(inside.outlines.size(), 1U);
}

TEST(Section, a_crack_with_a_notch_meets_the_slice_in_two_lines) {
  const std::vector<Point> notched{{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {4.0, 0.0, 2.0}, {2.0, 0.0, 0.5}, {0.0, 0.0, 2.0}};
  Section section;
  cut_cracks({notched}, {2, 0, 1}, 1.25, 1e-9, section);
  ASSERT_EQ(section.cracks.size(), 2U);
  EXPECT_DOUBLE_EQ(section.cracks[0][1].x, 1.0);
  EXPECT_DOUBLE_EQ(section.cracks[1][0].x, 3.0);
}

/// Hot above a horizontal crack, cold below; the crack stands on a row of points if its height is 1.
Section cracked_section(const SampleBody& body, double height) {
  Snapshot snapshot = body.snapshot(0.0);
  snapshot.cracks = {{{0.0, height, 0.0}, {4.0, height, 0.0}}};
  return make_section(snapshot, {});
}

TEST(Section, values_are_not_mixed_across_a_crack) {
  const SampleBody body(Grid{2, 1.0, {4, 4, 1}, {}, PointPlacement::boundary},
                        [](const Point& x) { return x[1] > 1.5 ? 100.0 : 0.0; });
  const Section section = cracked_section(body, 1.6);
  const SectionSampler sampler(section, Smoothing::bilinear);
  EXPECT_EQ(sampler({1.3, 1.59}), 0.0);
  EXPECT_EQ(sampler({1.3, 1.61}), 100.0);
}

TEST(Section, points_on_a_crack_belong_to_its_left) {
  const SampleBody body(Grid{2, 1.0, {4, 4, 1}, {}, PointPlacement::boundary},
                        [](const Point& x) { return x[1] > 0.5 ? 100.0 : 0.0; });
  const Section section = cracked_section(body, 1.0);
  const SectionSampler sampler(section, Smoothing::bilinear);
  EXPECT_EQ(sampler({1.3, 0.99}), 0.0);
  EXPECT_EQ(sampler({1.3, 1.01}), 100.0);
}

TEST(Section, beside_a_hole_values_come_from_the_points_that_exist) {
  const SampleBody body(Grid{2, 1.0, {2, 1, 1}, {}, PointPlacement::boundary},
                        [](const Point& x) { return x[0] > 1.5 ? not_a_number : 5.0; });
  const Section section = make_section(body.snapshot(0.0), {});
  const SectionSampler sampler(section, Smoothing::bilinear);
  EXPECT_DOUBLE_EQ(sampler({1.4, 0.5}), 5.0);
  EXPECT_TRUE(std::isnan(sampler({1.6, 0.5})));
  EXPECT_TRUE(std::isnan(sampler.between_points({1.4, 0.5})));
  EXPECT_DOUBLE_EQ(sampler.between_points({0.4, 0.5}), 5.0);
}

}  // namespace
}  // namespace peritherm
