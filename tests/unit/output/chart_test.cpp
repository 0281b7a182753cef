#include "peritherm/output/chart.hpp"

#include <cmath>

#include "unit/output/output_fixture.hpp"
#include "unit/output/read_picture.hpp"

namespace peritherm {
namespace {

constexpr std::uint32_t first_curve = 0x1d4e9e;
constexpr std::uint32_t second_curve = 0xc8372d;

class ChartTest : public OutputTest {
 protected:
  ReadPicture draw(const Chart& chart, int width = 600) {
    save_chart(chart, width, folder_ / "chart.png");
    return ReadPicture(folder_ / "chart.png");
  }
};

TEST_F(ChartTest, curves_have_colours_of_their_own_and_legends_make_it_taller) {
  Chart chart;
  chart.curves = {{"", {0.0, 1.0}, {0.0, 1.0}}, {"", {0.0, 1.0}, {1.0, 0.0}}};
  const ReadPicture bare = draw(chart);
  EXPECT_EQ(bare.width, 600);
  EXPECT_GT(bare.count(first_curve), 50);
  EXPECT_GT(bare.count(second_curve), 50);
  chart.curves[0].name = "first";
  chart.notes = {"what it says"};
  EXPECT_GT(draw(chart).height, bare.height);
  chart.curves[1].colour = 0;
  EXPECT_EQ(draw(chart).count(second_curve), 0);
}

TEST_F(ChartTest, a_power_is_a_straight_line_on_logarithmic_axes) {
  Chart line;
  line.curves = {{"", {0.0, 2.0}, {0.0, 4.0}}};
  line.x = {"x", AxisScale::linear, 0.0, 2.0};
  line.y = {"y", AxisScale::linear, 0.0, 4.0};
  Chart power;
  power.curves = {{"", {1.0, 10.0, 100.0}, {1.0, 100.0, 1e4}}};
  power.x = {"x", AxisScale::logarithmic, 1.0, 100.0};
  power.y = {"y", AxisScale::logarithmic, 1.0, 1e4};
  // Margins differ with the labels, by less than a tenth.
  const double ratio =
      static_cast<double>(draw(power).count(first_curve)) / static_cast<double>(draw(line).count(first_curve));
  EXPECT_NEAR(ratio, 1.0, 0.1);
}

TEST_F(ChartTest, missing_values_and_what_a_logarithm_cannot_show_interrupt_a_curve) {
  Chart chart;
  chart.y.scale = AxisScale::logarithmic;
  chart.curves = {{"", {0.0, 1.0, 2.0, 3.0, 4.0}, {1.0, 2.0, 3.0, 4.0, 5.0}}};
  const long whole = draw(chart).count(first_curve);
  chart.curves[0].y = {1.0, 2.0, 0.0, 4.0, 5.0};
  const long without_zero = draw(chart).count(first_curve);
  chart.curves[0].y = {1.0, 2.0, not_a_number, 4.0, 5.0};
  const long without_number = draw(chart).count(first_curve);
  EXPECT_LT(without_zero, 0.75 * whole);
  EXPECT_EQ(without_zero, without_number);
}

TEST_F(ChartTest, triangles_of_a_slope_stand_within_the_axes) {
  Chart chart;
  chart.x.scale = chart.y.scale = AxisScale::logarithmic;
  chart.curves = {{"", {1.0, 100.0}, {1.0, 1.0}}};
  chart.slopes = {{1.0, 10.0, 1e-4, 2.0, {}}};
  Chart axes = chart;
  axes.y.low = 1e-4 * std::pow(1e4, -0.06);
  axes.y.high = std::pow(1e4, 0.06);
  EXPECT_EQ(draw(chart).pixels, draw(axes).pixels);
  chart.slopes[0].slope = 6.0;
  axes.slopes[0].slope = 6.0;
  EXPECT_NE(draw(chart).pixels, draw(axes).pixels) << "the end of the long side counts as well";
}

TEST_F(ChartTest, charts_without_values_or_with_equal_ones_are_drawn) {
  Chart chart;
  EXPECT_EQ(draw(chart).width, 600);
  chart.curves = {{"one", {2.0}, {3.0}, CurveStyle::dots}};
  EXPECT_GT(draw(chart).count(first_curve), 10);
  chart.x.scale = chart.y.scale = AxisScale::logarithmic;
  EXPECT_GT(draw(chart).count(first_curve), 10);
}

TEST_F(ChartTest, long_titles_and_notes_are_wrapped_between_words) {
  const std::string text = "several words that do not fit on one line";
  const auto lines = wrapped(text, 20.0, 200.0);
  ASSERT_GT(lines.size(), 1U);
  std::string joined;
  for (const std::string& line : lines) {
    EXPECT_LE(text_width(line, 20.0), 200.0);
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, text);
}

}  // namespace
}  // namespace peritherm
