#include <cmath>
#include <sstream>

#include "unit/output/output_fixture.hpp"

namespace peritherm {
namespace {

/// Numbers of a CSV file without its heading.
std::vector<std::vector<double>> rows_of(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

class LineOutputTest : public OutputTest {
 protected:
  std::vector<std::vector<double>> write(const SampleBody& body, const LineOutput& options) {
    const auto observer = make_observer(options, folder_);
    observer->observe(body.snapshot(1.0));
    heading = read(observer->files().at(0));
    EXPECT_TRUE(std::filesystem::exists(observer->files().at(1)));
    return rows_of(heading);
  }
  std::string heading;
};

double slope_of_place(const Point& x) { return 1e4 * x[0] + 2e4 * x[1] + 3e4 * x[2]; }

TEST_F(LineOutputTest, stands_on_the_points_of_a_body_along_an_axis) {
  const SampleBody body{Grid{2, 1e-3, {10, 6, 1}, {}, PointPlacement::centres}, slope_of_place};
  const auto rows = write(body, {});
  EXPECT_EQ(heading.substr(0, heading.find('\n')), "time,x,y,temperature");
  // Two ends and ten points.
  ASSERT_EQ(rows.size(), 12U);
  EXPECT_EQ(rows[0][1], 0.0);
  EXPECT_DOUBLE_EQ(rows[1][1], 0.5e-3);
  EXPECT_DOUBLE_EQ(rows[11][1], 10e-3);
  for (const auto& row : rows) {
    EXPECT_EQ(row[0], 1.0);
    EXPECT_DOUBLE_EQ(row[2], 3e-3);
    EXPECT_NEAR(row[3], 1e4 * row[1] + 2e4 * row[2], 1e-10);
  }
}

TEST_F(LineOutputTest, goes_backwards_and_obliquely) {
  const SampleBody body{Grid{3, 1e-3, {8, 8, 8}, {}, PointPlacement::boundary}, slope_of_place};
  LineOutput options;
  options.from = Coordinates{8e-3, 0.0, 0.0};
  options.to = Coordinates{2e-3, 0.0, 0.0};
  const auto backwards = write(body, options);
  ASSERT_EQ(backwards.size(), 7U);
  EXPECT_DOUBLE_EQ(backwards[1][1], 7e-3);
  EXPECT_NEAR(backwards[1][4], 70.0, 1e-10);
  options.to = Coordinates{0.0, 8e-3, 8e-3};
  options.samples = 5;
  options.stem = "oblique";
  const auto oblique = write(body, options);
  ASSERT_EQ(oblique.size(), 5U);
  for (const auto& row : oblique) EXPECT_NEAR(row[4], slope_of_place({row[1], row[2], row[3]}), 1e-10);
}

TEST_F(LineOutputTest, sets_the_exact_temperature_beside) {
  const SampleBody body{Grid{1, 1e-2, {10, 1, 1}, {}, PointPlacement::centres}, [](const Point&) { return 3.0; }};
  LineOutput options;
  options.exact = LumpedBody{7.0, 3.0, 1.0};
  const auto rows = write(body, options);
  EXPECT_EQ(heading.substr(0, heading.find('\n')), "time,x,temperature,exact");
  for (const auto& row : rows) {
    EXPECT_DOUBLE_EQ(row[2], 3.0);
    EXPECT_DOUBLE_EQ(row[3], 3.0 + 4.0 * std::exp(-1.0));
  }
}

TEST_F(LineOutputTest, does_not_mix_values_across_a_crack) {
  const SampleBody body{Grid{2, 1e-3, {10, 10, 1}, {}, PointPlacement::centres},
                        [](const Point& x) { return x[0] < 5e-3 ? 0.0 : 100.0; }};
  Snapshot snapshot = body.snapshot(0.0);
  snapshot.cracks = {{{5e-3, 0.0, 0.0}, {5e-3, 10e-3, 0.0}}};
  LineOutput options;
  options.samples = 100;
  const auto observer = make_observer(options, folder_);
  observer->observe(snapshot);
  for (const auto& row : rows_of(read(observer->files().at(0))))
    EXPECT_NEAR(row[3], row[1] < 5e-3 ? 0.0 : 100.0, 1e-10) << row[1];
}

TEST_F(LineOutputTest, holds_nothing_where_the_body_was_cut_away) {
  const SampleBody body{Grid{1, 1e-2, {10, 1, 1}, {}, PointPlacement::centres},
                        [](const Point& x) { return x[0] < 5e-2 ? 3.0 : not_a_number; }};
  for (const auto& row : write(body, {})) EXPECT_EQ(std::isnan(row[2]), row[1] > 5e-2) << row[1];
}

TEST_F(LineOutputTest, tables_hold_every_time_and_pictures_a_few) {
  const SampleBody body{Grid{1, 1e-2, {10, 1, 1}, {}, PointPlacement::centres}, slope_of_place};
  LineOutput options;
  options.width = 300;
  const auto observer = make_observer(options, folder_);
  for (int k = 0; k < 20; ++k) observer->observe(body.snapshot(k));
  EXPECT_EQ(rows_of(read(observer->files().at(0))).size(), 20U * 12U);
}

}  // namespace
}  // namespace peritherm
