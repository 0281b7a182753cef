#include "peritherm/reduction/retained_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "support/assembled_case.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

const Grid retained_grid{2, 0.1, {10, 6, 1}, {}, PointPlacement::centres};
const std::vector<bool> all_points(60, true);

std::vector<std::int64_t> select(const RetainedPoints& choice) {
  return select_retained(choice, retained_grid, all_points, all_points).points;
}

/// The message, if the choice is refused.
std::string refusal(const RetainedPoints& choice, const std::vector<bool>& present = all_points,
                    const std::vector<bool>& is_free = all_points) {
  try {
    select_retained(choice, retained_grid, present, is_free);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

RetainedPoints retain_every(std::vector<int> every) {
  RetainedPoints choice;
  choice.every = std::move(every);
  return choice;
}

TEST(RetainedPoints, are_every_second_along_each_axis_by_default) {
  const std::vector<std::int64_t> points = select({});
  EXPECT_EQ(points.size(), 15U);
  EXPECT_EQ(points, select(retain_every({2})));
  EXPECT_EQ(points[5], 20);
  EXPECT_EQ(select(retain_every({5, 3})), (std::vector<std::int64_t>{0, 5, 30, 35}));
}

TEST(RetainedPoints, of_a_region_lie_on_the_same_lattice) {
  RetainedPoints choice;
  choice.regions = {{Box{{0.3, 0.2}, {0.6, 0.4}}, 1}};
  EXPECT_EQ(select(choice), (std::vector<std::int64_t>{23, 24, 25, 33, 34, 35}));
  choice.regions = {{Box{{0.3, 0.2}, {0.6, 0.4}}, 2}};
  EXPECT_EQ(select(choice), (std::vector<std::int64_t>{24}));
}

TEST(RetainedPoints, at_places_are_the_nearest) {
  RetainedPoints choice;
  choice.points = {{0.0, 0.0}, {0.58, 0.31}, {1.0, 0.6}};
  EXPECT_EQ(select(choice), (std::vector<std::int64_t>{0, 35, 59}));
}

TEST(RetainedPoints, of_several_keys_are_put_together) {
  RetainedPoints choice = retain_every({5, 6});
  choice.points = {{0.95, 0.55}};
  EXPECT_EQ(select(choice), (std::vector<std::int64_t>{0, 5, 59}));
}

TEST(RetainedPoints, at_random_are_as_many_as_asked_for_and_always_the_same) {
  RetainedPoints choice;
  choice.share = 0.25;
  const std::vector<std::int64_t> points = select(choice);
  EXPECT_EQ(points.size(), 15U);
  // By hand: the standard fixes the numbers of this engine.
  std::mt19937_64 engine(1);
  std::vector<std::int64_t> expected;
  for (std::uint64_t left = 60; left > 0; --left) {
    if (engine() % left < 15 - expected.size()) expected.push_back(static_cast<std::int64_t>(60 - left));
  }
  EXPECT_EQ(points, expected);
  choice.seed = 2;
  EXPECT_NE(select(choice), points);
}

TEST(RetainedPoints, that_are_held_are_told_of) {
  std::vector<bool> is_free = all_points;
  std::fill_n(is_free.begin(), 10, false);
  const RetainedSet set = select_retained(retain_every({2}), retained_grid, all_points, is_free);
  EXPECT_EQ(set.points.size(), 10U);
  ASSERT_EQ(set.notes.size(), 1U);
  EXPECT_NE(set.notes[0].find("10 in all, 5 of them"), std::string::npos) << set.notes[0];
}

TEST(RetainedPoints, that_select_nothing_are_refused) {
  RetainedPoints choice;
  choice.share = 0.0;
  EXPECT_NE(refusal(choice).find("selects no point"), std::string::npos) << refusal(choice);
  std::vector<bool> is_free = all_points;
  is_free[0] = false;
  EXPECT_NE(refusal(retain_every({10, 6}), all_points, is_free).find("held points only"), std::string::npos);
}

TEST(RetainedPoints, with_mistakes_are_refused_with_all_of_them) {
  RetainedPoints choice = retain_every({2, 2, 2});
  choice.points = {{0.5, 0.7}, {0.5}, {0.25, 0.05}};
  choice.regions = {{Ball{{0.2, 0.2}, 0.01}, 1}};
  std::vector<bool> present = all_points;
  present[2] = false;
  const std::string message = refusal(choice, present, present);
  for (const char* part :
       {"retained.every: needs one number", "points.0: (0.5, 0.7) lies outside the body", "from (0, 0) to (1, 0.6)",
        "points.1: needs 2 coordinates", "points.2: (0.25, 0.05)", "cut away", "region.0: holds no point"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " in\n" << message;
}

/// A plate whose right half is cut off by a crack, with every point right of it truncated.
TEST(RetainedPoints, must_anchor_every_piece_of_the_body) {
  Problem problem = unit_body(2, 10, 2.0);
  problem.cracks.emplace_back().points = {{0.7, 0.0}, {0.7, 1.0}};
  AssembledCase plate(problem);
  StaticCondensation method;
  method.retained.regions = {{Box{{0.0, 0.0}, {0.3, 1.0}}, 1}};
  try {
    reduce(method, plate.full());
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("30 points between (0.75, 0.05) and (0.95, 0.95)"), std::string::npos) << message;
    EXPECT_NE(message.find("(0.75, 0.05) [m]"), std::string::npos) << message;
  }
  method.retained.points = {{0.75, 0.05}};
  EXPECT_NO_THROW(reduce(method, plate.full()));
}

/// Sums that cancel leave rounding in the place of cut bonds; it anchors nothing.
TEST(RetainedPoints, must_anchor_a_point_that_lost_all_bonds) {
  Problem problem = unit_body(1, 5, 1.2855);
  problem.body.points = PointPlacement::boundary;
  problem.nonlocality.kernel = {ConstantKernel{}, 2};
  problem.materials["body"] = {0.13533, 0.5, 0.5};
  problem.cracks.emplace_back().points = {{0.81}};
  set_face(problem, Face::x_min, held_at(-1.0));
  AssembledCase bar(problem);
  StaticCondensation method;
  method.retained.every = std::vector<int>{2};
  try {
    reduce(method, bar.full());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a point at (1)"), std::string::npos) << error.what();
  }
}

TEST(RetainedPoints, need_not_anchor_what_is_held_or_cooled) {
  Problem problem = unit_body(2, 10, 2.0);
  problem.cracks.emplace_back().points = {{0.7, 0.0}, {0.7, 1.0}};
  set_face(problem, Face::x_max, Convection{1.0, 0.0});
  AssembledCase plate(problem);
  StaticCondensation method;
  method.retained.regions = {{Box{{0.0, 0.0}, {0.3, 1.0}}, 1}};
  EXPECT_NO_THROW(reduce(method, plate.full()));
}

}  // namespace
}  // namespace peritherm
