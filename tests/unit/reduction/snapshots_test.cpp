#include "peritherm/reduction/snapshots.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "peritherm/reduction/heat_basis.hpp"

namespace peritherm {
namespace {

constexpr std::size_t points = 50, snapshot_count = 30;

FieldStorage snapshot_weights() {
  FieldStorage capacities(points);
  for (std::size_t n = 0; n < points; ++n) capacities[n] = n % 7 == 0 ? 0.0 : 1.0 + 0.1 * static_cast<double>(n);
  return capacities;
}

/// Sums of cosines whose sizes fall by 30 from one to the next, down to rounding.
std::vector<FieldStorage> decaying_snapshots() {
  std::vector<FieldStorage> snapshots;
  for (std::size_t j = 0; j < snapshot_count; ++j) {
    snapshots.emplace_back(points);
    for (std::size_t n = 0; n < points; ++n) {
      for (int k = 0; k < 9 && n % 7 != 0; ++k) {
        const double share = std::sin(1.0 + static_cast<double>(j * (k + 1)));
        snapshots.back()[n] += share * std::pow(30.0, -k) * std::cos(0.06 * static_cast<double>(n) * (k + 1));
      }
    }
  }
  return snapshots;
}

TEST(SnapshotDirections, are_orthonormal_and_make_up_the_snapshots) {
  const FieldStorage capacities = snapshot_weights();
  const std::vector<FieldStorage> snapshots = decaying_snapshots();
  const SnapshotDirections directions = find_directions(snapshots, capacities, 1e-11, 20);
  ASSERT_GE(directions.states.size(), 8U);
  const std::vector<ConstField> states(directions.states.begin(), directions.states.end());
  const Matrix products = weighted_products(capacities, states, states);
  for (std::size_t i = 0; i < products.rows; ++i) {
    for (std::size_t j = 0; j < products.columns; ++j) EXPECT_NEAR(products(i, j), i == j ? 1.0 : 0.0, 1e-13);
  }
  for (std::size_t j = 0; j < snapshot_count; ++j) {
    FieldStorage rest = snapshots[j];
    std::vector<double> shares(directions.shares.column(j).begin(), directions.shares.column(j).end());
    for (double& share : shares) share = -share;
    add_states(states, shares, rest);
    const ConstField own[] = {rest};
    // The Gram matrix alone would lose all below the root of rounding, 1e-7 of these sizes.
    EXPECT_LE(std::sqrt(weighted_products(capacities, own, own)(0, 0)), 1.1e-11 + 1e-13);
    EXPECT_LE(directions.rest[j], 1e-11);
  }
}

TEST(SnapshotDirections, come_in_the_order_of_what_they_carry) {
  const SnapshotDirections directions = find_directions(decaying_snapshots(), snapshot_weights(), 1e-11, 20);
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < directions.states.size(); ++k) {
    double sum = 0.0;
    for (std::size_t j = 0; j < snapshot_count; ++j) sum += std::pow(directions.shares(k, j), 2);
    EXPECT_LE(sum, before * (1.0 + 1e-12));
    before = sum;
  }
  EXPECT_EQ(find_directions(decaying_snapshots(), snapshot_weights(), 1e-11, 3).states.size(), 3U);
}

TEST(SnapshotDirections, are_none_where_nothing_varies) {
  std::vector<FieldStorage> zeros(4, FieldStorage(points));
  EXPECT_TRUE(find_directions(zeros, snapshot_weights(), 0.0, 5).states.empty());
}

TEST(SnapshotDirections, are_no_more_than_the_snapshots_even_where_no_rounding_is_negligible) {
  std::vector<FieldStorage> snapshots = decaying_snapshots();
  snapshots.resize(3);
  const SnapshotDirections directions = find_directions(snapshots, snapshot_weights(), 0.0, 20);
  EXPECT_EQ(directions.states.size(), 3U);
  EXPECT_EQ(directions.shares.rows, 3U);
}

}  // namespace
}  // namespace peritherm
