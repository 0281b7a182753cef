#include <cmath>

#include "peritherm/output/figure.hpp"
#include "unit/output/output_fixture.hpp"
#include "unit/output/read_picture.hpp"

namespace peritherm {
namespace {

constexpr std::uint32_t black = 0x000000;
constexpr std::uint32_t cut_away = 0xe6e6e6;
constexpr std::uint32_t first_material = 0x9fb8d1;

class Picture : public OutputTest {
 protected:
  ReadPicture draw(const Snapshot& snapshot, const PictureOutput& options) {
    const auto observer = make_observer(options, folder_);
    observer->observe(snapshot);
    return ReadPicture(observer->files().at(0));
  }
  SampleBody plate(int columns, int rows) const {
    return {Grid{2, 1e-3, {columns, rows, 1}, {}, PointPlacement::centres},
            [](const Point& x) { return 1e4 * x[0] + 2e4 * x[1]; }};
  }
};

TEST_F(Picture, files_are_numbered_and_as_wide_as_asked_for) {
  const SampleBody body = plate(20, 20);
  PictureOutput options;
  options.width = 300;
  const auto observer = make_observer(options, folder_);
  observer->observe(body.snapshot(0.0));
  observer->observe(body.snapshot(1.0));
  EXPECT_EQ(observer->files(), (std::vector<std::filesystem::path>{folder_ / "pictures" / "temperature_0000.png",
                                                                   folder_ / "pictures" / "temperature_0001.png"}));
  const ReadPicture picture(observer->files()[1]);
  EXPECT_EQ(picture.width, 300);
  EXPECT_GT(picture.colours(), 100U);
}

TEST_F(Picture, long_and_tall_plates_keep_sensible_sizes) {
  PictureOutput options;
  options.width = 400;
  const ReadPicture strip = draw(plate(400, 4).snapshot(0.0), options);
  EXPECT_GE(strip.height, 54 + 100) << "the least plot at this width, and its labels";
  EXPECT_LT(strip.height, 400);
  const ReadPicture tall = draw(plate(4, 400).snapshot(0.0), options);
  EXPECT_EQ(tall.width, 400);
  EXPECT_LE(tall.height, 4 * 400);
}

TEST_F(Picture, cracks_are_black) {
  const SampleBody body = plate(20, 20);
  Snapshot snapshot = body.snapshot(0.0);
  EXPECT_EQ(draw(snapshot, {}).count(black), 0);
  snapshot.cracks = {{{5e-3, 5e-3, 0.0}, {15e-3, 5e-3, 0.0}}};
  // Half of a plot of at least 600 pixels, 3.4 pixels wide, of which at least two are covered whole.
  EXPECT_GT(draw(snapshot, {}).count(black), 600);
}

TEST_F(Picture, what_was_cut_away_is_grey_and_materials_have_their_colours) {
  const SampleBody body(Grid{2, 1e-3, {10, 10, 1}, {}, PointPlacement::centres},
                        [](const Point& x) { return x[0] < 5e-3 ? not_a_number : 1.0; });
  PictureOutput options;
  options.field = FieldName::material;
  const ReadPicture picture = draw(body.snapshot(0.0), options);
  // Half of a plot of at least 500 × 500 pixels each; hatching takes part of the grey.
  EXPECT_GT(picture.count(first_material), 500 * 250 - 5000);
  EXPECT_GT(picture.count(cut_away), 500 * 250 / 2);
}

TEST_F(Picture, a_given_range_fixes_the_colours) {
  const SampleBody body = plate(10, 10);
  PictureOutput narrow;
  narrow.isotherms = 0;
  narrow.range = Coordinates{1e5, 2e5};
  const ReadPicture picture = draw(body.snapshot(0.0), narrow);
  const std::uint32_t lowest = 0x001f51;
  EXPECT_GT(picture.count(lowest), 500 * 500) << "all values lie below the range";
}

TEST_F(Picture, isolines_add_dark_lines_only_when_asked_for) {
  const SampleBody body = plate(20, 20);
  PictureOutput none;
  none.isotherms = 0;
  PictureOutput many;
  many.isotherms = 15;
  const ReadPicture without = draw(body.snapshot(0.0), none);
  const ReadPicture with = draw(body.snapshot(0.0), many);
  std::size_t different = 0;
  for (std::size_t i = 0; i < with.pixels.size(); ++i) different += with.pixels[i] != without.pixels[i] ? 1U : 0U;
  EXPECT_GT(different, 15U * 300U);
}

TEST_F(Picture, values_that_differ_by_less_than_a_millionth_are_one_value) {
  PictureOutput flux;
  flux.field = FieldName::heat_flux;
  const ValueRange uniform = find_range({0.64516128, 0.6451613, not_a_number}, flux);
  EXPECT_EQ(uniform.low, 0.0);
  EXPECT_EQ(uniform.high, 0.6451613);
  const ValueRange warm = find_range({300.0, 300.0002}, {});
  EXPECT_LT(warm.high - warm.low, 0.1 * 300.1) << "as for one temperature";
  EXPECT_GT(warm.high - warm.low, 0.09 * 300.0);
  const ValueRange apart = find_range({300.0, 300.001}, {});
  EXPECT_LT(apart.high - apart.low, 0.0011);
}

TEST_F(Picture, every_field_of_every_dimension_can_be_drawn_even_if_it_is_constant) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (const double value : {0.0, 20.0, not_a_number}) {
      const GridIndex cells{3, dimension > 1 ? 3 : 1, dimension > 2 ? 1 : 1};
      const SampleBody body(Grid{dimension, 1e-6, cells, {}, PointPlacement::centres},
                            [value](const Point&) { return value; });
      for (const auto& [field, name] : EnumNames<FieldName>::values) {
        PictureOutput options;
        options.field = field;
        options.width = 200;
        EXPECT_EQ(draw(body.snapshot(0.0), options).width, 200) << name << " in " << dimension << "-D";
      }
    }
  }
}

TEST_F(Picture, slices_at_several_places_do_not_overwrite_each_other) {
  const SampleBody body(Grid{3, 0.1, {4, 4, 4}, {}, PointPlacement::centres}, [](const Point& x) { return x[2]; });
  PictureOutput low;
  low.at = 0.1;
  low.width = 200;
  PictureOutput across = low;
  across.normal = AxisName::x;
  draw(body.snapshot(0.0), low);
  draw(body.snapshot(0.0), across);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pictures" / "temperature_z_0.1_0000.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pictures" / "temperature_x_0.1_0000.png"));
}

TEST_F(Picture, the_curve_of_a_bar_shows_its_cracks) {
  const SampleBody bar(Grid{1, 1e-2, {30, 1, 1}, {}, PointPlacement::centres}, [](const Point& x) { return x[0]; });
  Snapshot snapshot = bar.snapshot(0.0);
  EXPECT_EQ(draw(snapshot, {}).count(black), 0);
  snapshot.cracks = {{{0.15, 0.0, 0.0}}};
  EXPECT_GT(draw(snapshot, {}).count(black), 100);
}

TEST_F(Picture, the_exact_curve_of_a_bar_is_drawn_beside_the_computed_one) {
  constexpr std::uint32_t exact_curve = 0xc8372d;
  const SampleBody body{Grid{1, 1e-3, {20, 1, 1}, {}, PointPlacement::centres}, [](const Point& x) { return x[0]; }};
  PictureOutput options;
  const ReadPicture without = draw(body.snapshot(1.0), options);
  EXPECT_EQ(without.count(exact_curve), 0);
  options.exact = LumpedBody{1.0, 0.0, 1.0};
  options.stem = "exact";
  const ReadPicture with = draw(body.snapshot(1.0), options);
  EXPECT_GT(with.count(exact_curve), 200);
  EXPECT_GT(with.height, without.height);
}

}  // namespace
}  // namespace peritherm
