#include "peritherm/operators/follower_rows.hpp"

#include <gtest/gtest.h>

#include "peritherm/base/error.hpp"

namespace peritherm {
namespace {

/// A row of a table of followers: who follows whom, with which gains.
struct Tie {
  std::int64_t entry;
  std::vector<std::pair<std::int64_t, double>> neighbours;
  std::int64_t flux = -1;
};

Followers followers_of(const std::vector<Tie>& ties) {
  Followers followers;
  for (const Tie& tie : ties) {
    followers.entries.push_back(tie.entry);
    followers.boundaries.push_back(0);
    followers.fluxes.push_back(tie.flux);
    for (const auto& [entry, gain] : tie.neighbours) {
      followers.neighbours.push_back(entry);
      followers.gains.push_back(gain);
    }
    followers.row_begin.push_back(static_cast<BondIndex>(followers.gains.size()));
  }
  return followers;
}

FollowerRows rows_of(const std::vector<Tie>& ties) {
  Followers followers = followers_of(ties);
  std::vector<Stand> stands;
  for (const std::int64_t entry : followers.neighbours) stands.push_back({entry, 1.0, {}});
  return FollowerRows(std::move(followers), stands);
}

TEST(FollowerRows, one_temperature_everywhere_stays_to_the_bit) {
  const FollowerRows rows = rows_of({{0, {{2, 0.1}, {3, 0.7}}}, {1, {{0, 0.3}, {2, 0.9}}}});
  std::vector<double> field{0.0, 0.0, 293.15, 293.15};
  rows.fill({}, {}, field);
  EXPECT_EQ(field, (std::vector<double>{293.15, 293.15, 293.15, 293.15}));
}

TEST(FollowerRows, points_that_follow_one_another_satisfy_both_relations) {
  // T0 = (T1 + T2)/2 and T1 = (T0 + T3)/2: T0 = (2 T2 + T3)/3.
  const FollowerRows rows = rows_of({{0, {{1, 1.0}, {2, 1.0}}}, {1, {{0, 1.0}, {3, 1.0}}}});
  std::vector<double> field{0.0, 0.0, 10.0, 40.0};
  rows.fill({}, {}, field);
  EXPECT_NEAR(field[0], 20.0, 1e-14 * 40.0);
  EXPECT_NEAR(field[1], 30.0, 1e-14 * 40.0);
}

TEST(FollowerRows, a_flux_raises_what_it_enters) {
  const FollowerRows rows = rows_of({{0, {{1, 2.0}, {2, 2.0}}, 0}});
  std::vector<double> field{0.0, 10.0, 20.0};
  const std::vector<double> fluxes{8.0};
  rows.fill({}, fluxes, field);
  EXPECT_EQ(field[0], 15.0 + 8.0 / 4.0);
}

TEST(FollowerRows, fictitious_neighbours_count_with_what_they_stand_for) {
  // One neighbour is itself, the other its image about a wall at 5: (3 + (2 · 5 − 3)) / 2.
  Followers followers = followers_of({{0, {{1, 1.0}, {1, 1.0}}}});
  const FollowerRows rows(std::move(followers), {{1, 1.0, {}}, {1, -1.0, {{0, 2.0}}}});
  std::vector<double> field{0.0, 3.0};
  const std::vector<double> walls{5.0};
  rows.fill(walls, {}, field);
  EXPECT_EQ(field[0], 5.0);
}

TEST(FollowerRows, nothing_to_follow_is_refused) {
  EXPECT_THROW(rows_of({{0, {}}}), Error);
  EXPECT_THROW(rows_of({{0, {{1, 1.0}}}, {1, {{0, 1.0}}}}), Error);
}

}  // namespace
}  // namespace peritherm
