#include <gtest/gtest.h>

#include "support/divided_body.hpp"

namespace peritherm {
namespace {

const PartBackground around_grids{"substrate", 0, 0.3};

PartRegion own_grid(Box box, double spacing, const std::string& name = "film") {
  PartRegion made;
  made.shape = std::move(box);
  made.name = name;
  made.material = 1;
  made.spacing = spacing;
  return made;
}

std::size_t contacts_in(const DividedBody& body) {
  std::size_t count = 0;
  for (const SurfacePoint& point : body.surface) count += point.second >= 0;
  return count;
}

double sum_of_contacts(const DividedBody& body) {
  double sum = 0.0;
  for (const SurfacePoint& point : body.surface) sum += point.second >= 0 ? point.area : 0.0;
  return sum;
}

std::string problems_of(const Grid& grid, const std::vector<PartRegion>& regions) {
  try {
    divide_body(grid, around_grids, regions);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(OwnGrids, a_region_may_have_a_finer_grid_with_surface_points_of_the_coarser_one) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    Box upper{Coordinates(static_cast<std::size_t>(dimension), 0.0),
              Coordinates(static_cast<std::size_t>(dimension), 1.0)};
    upper.from.back() = 0.5;
    const DividedBody body = divide_body(unit_box(dimension, 6), around_grids, {own_grid(upper, 1.0 / 12)});
    ASSERT_EQ(body.parts.size(), 2u);
    EXPECT_EQ(body.parts[1].spacing, 1.0 / 12);
    EXPECT_EQ(static_cast<double>(body.parts[1].size()),
              std::pow(2.0, dimension) * static_cast<double>(body.parts[0].size()));
    EXPECT_EQ(contacts_in(body), std::size_t{dimension == 1 ? 1u : dimension == 2 ? 6u : 36u});
    EXPECT_NEAR(sum_of_contacts(body), 1.0, rounding(36, 1.0));
    expect_closed(body);
  }
}

TEST(OwnGrids, spacings_need_not_be_multiples_of_each_other) {
  for (int dimension = 2; dimension <= 3; ++dimension) {
    Box block{Coordinates(static_cast<std::size_t>(dimension), 1.0 / 3),
              Coordinates(static_cast<std::size_t>(dimension), 2.0 / 3)};
    const DividedBody body = divide_body(unit_box(dimension, 6), around_grids, {own_grid(block, 1.0 / 9)});
    ASSERT_EQ(body.parts.size(), 2u);
    EXPECT_EQ(contacts_in(body), std::size_t{dimension == 2 ? 8u : 24u});
    EXPECT_NEAR(sum_of_contacts(body), 2 * dimension * std::pow(1.0 / 3, dimension - 1), rounding(24, 1.0));
    expect_closed(body);
  }
}

TEST(OwnGrids, grids_of_their_own_may_meet_each_other_and_contain_one_another) {
  const DividedBody body = divide_body(unit_box(2, 6), around_grids,
                                       {own_grid(Box{{0.0, 0.5}, {0.5, 1.0}}, 1.0 / 12, "left"),
                                        own_grid(Box{{0.5, 0.5}, {1.0, 1.0}}, 1.0 / 18, "right"),
                                        own_grid(Box{{0.5, 0.5}, {1.0, 2.0 / 3}}, 1.0 / 24, "seam")});
  ASSERT_EQ(body.parts.size(), 4u);
  EXPECT_EQ(body.parts[3].name, "seam");
  EXPECT_NEAR(sum_of_contacts(body), 1.0 + 0.5 + 0.5, rounding(30, 1.0));
  expect_closed(body);
}

TEST(OwnGrids, other_regions_and_what_is_cut_away_pass_through_all_grids) {
  PartRegion fibre;
  fibre.shape = Ball{{0.5, 0.7}, 0.15};
  fibre.name = "fibre";
  fibre.material = 2;
  PartRegion slot;
  slot.shape = Box{{0.0, 0.0}, {1.0 / 6, 0.5}};
  slot.material = no_material;
  const DividedBody body =
      divide_body(unit_box(2, 12), around_grids, {own_grid(Box{{0.0, 0.5}, {1.0, 1.0}}, 1.0 / 24), slot, fibre});
  ASSERT_EQ(body.parts.size(), 3u);
  EXPECT_EQ(body.parts[2].name, "fibre");
  EXPECT_EQ(body.parts[2].spacing, 1.0 / 24);
  double bare = 0.0;
  for (const SurfacePoint& point : body.surface) bare += point.second < 0 && point.face < 0 ? point.area : 0.0;
  EXPECT_NEAR(bare, 0.5 + 1.0 / 6, rounding(100, 1.0));
  expect_closed(body);
}

TEST(OwnGrids, what_does_not_fit_is_refused_with_what_would) {
  const std::string uneven = problems_of(unit_box(2, 6), {own_grid(Box{{0.0, 0.5}, {1.0, 1.0}}, 0.12)});
  EXPECT_NE(uneven.find("no whole number of its spacings"), std::string::npos) << uneven;
  EXPECT_NE(uneven.find("Use a spacing of 0.125 m"), std::string::npos) << uneven;
  const std::string beside = problems_of(unit_box(2, 4), {own_grid(Box{{0.0, 0.6}, {1.0, 1.0}}, 0.1)});
  EXPECT_NE(beside.find("cuts through cells"), std::string::npos) << beside;
  EXPECT_NE(beside.find("0.5 or 0.75 m"), std::string::npos) << beside;
  PartRegion ball = own_grid(Box{}, 0.05);
  ball.shape = Ball{{0.5, 0.5}, 0.3};
  EXPECT_NE(problems_of(unit_box(2, 6), {ball}).find("no box"), std::string::npos);
  EXPECT_NE(problems_of(unit_box(2, 6), {own_grid(Box{{2.0, 2.0}, {3.0, 3.0}}, 0.1)}).find("outside"),
            std::string::npos);
}

TEST(OwnGrids, a_curved_surface_stays_away_from_the_border_of_a_grid) {
  PartRegion fibre;
  fibre.shape = Ball{{0.5, 0.5}, 0.2};
  fibre.name = "fibre";
  fibre.material = 2;
  const std::string problem = problems_of(unit_box(2, 12), {own_grid(Box{{0.0, 0.5}, {1.0, 1.0}}, 1.0 / 24), fibre});
  EXPECT_NE(problem.find("meets the border of a grid"), std::string::npos) << problem;
}

}  // namespace
}  // namespace peritherm
