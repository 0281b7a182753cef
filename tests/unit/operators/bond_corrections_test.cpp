#include "peritherm/operators/bond_corrections.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>

#include "peritherm/operators/kernels.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

Problem plate(int cells = 60) { return unit_body(2, cells, 4.5); }

void add_polyline(Problem& problem, std::vector<Coordinates> points) {
  problem.cracks.emplace_back().points = std::move(points);
}

Problem plate_with_slanted_crack() {
  Problem problem = plate();
  add_polyline(problem, {{0.21, 0.3}, {0.8, 0.63}});
  return problem;
}

Problem plate_with_curved_crack() {
  Problem problem = plate();
  std::vector<Coordinates> arc;
  for (int k = 0; k <= 40; ++k) {
    const double angle = 0.04 * std::numbers::pi * k;
    arc.push_back({0.5 + 0.31 * std::cos(angle), 0.5 + 0.31 * std::sin(angle)});
  }
  add_polyline(problem, arc);
  return problem;
}

Problem plate_with_growing_crack() {
  Problem problem = plate_with_slanted_crack();
  problem.cracks.back().tip_speed = 1.0;
  return problem;
}

/// A problem's corrections and how many bonds they are.
struct Corrected {
  explicit Corrected(const Problem& problem, std::string_view kernel = "baseline")
      : geometry(make_geometry(problem)),
        layout(geometry.body.grid, geometry.stencil.radius),
        corrections(make_corrections(geometry.body, layout, geometry.stencil, geometry.held_by, kernel)) {}

  template <class Visit>
  void for_points(Visit&& visit) const {
    for (std::size_t n = 0; n < geometry.body.grid.size(); ++n) visit(layout.entry(geometry.body.grid.index(n)));
  }
  std::size_t bonds() const {
    std::size_t count = 0;
    for_points([&](std::size_t entry) { corrections.visit(entry, [&](std::int64_t, double) { ++count; }); });
    return count;
  }

  Geometry geometry;
  PaddedGrid layout;
  BondCorrections corrections;
};

std::vector<double> waves(std::size_t size) {
  std::vector<double> values(size);
  for (std::size_t n = 0; n < size; ++n) values[n] = std::sin(0.7 * static_cast<double>(n));
  return values;
}

void expect_sum_of_visited(const Corrected& body) {
  const std::vector<double> temperature = waves(body.layout.size());
  std::vector<double> result(temperature.size(), 0.5);
  body.corrections.apply(temperature, 2.0, result);
  const double inverse_capacity =
      1.0 / (volumetric_heat_capacity(body.geometry.body.materials[0]) * body.geometry.body.grid.cell_volume());
  body.for_points([&](std::size_t entry) {
    double sum = 0.0, size = 0.0;
    std::size_t count = 1;
    body.corrections.visit(entry, [&](std::int64_t distance, double difference) {
      const auto other = static_cast<std::size_t>(static_cast<std::int64_t>(entry) + distance);
      sum += difference * (temperature[other] - temperature[entry]);
      size = std::max(size, std::abs(difference));
      ++count;
    });
    EXPECT_NEAR(result[entry], 0.5 + 2.0 * inverse_capacity * sum,
                rounding(count, 0.5 + 4.0 * inverse_capacity * size));
  });
}

TEST(BondCorrections, every_instruction_set_adds_the_bonds_that_are_visited) {
  for (const Kernels& kernels : available_kernels()) {
    for (const Problem& problem : {plate_with_slanted_crack(), plate_with_curved_crack(), plate_with_growing_crack()}) {
      Corrected body(problem, kernels.name);
      body.corrections.average_over(0.2, 0.3);
      EXPECT_GT(body.bonds(), 100U);
      expect_sum_of_visited(body);
    }
  }
}

Problem with_cut_bonds(Problem problem) {
  problem.nonlocality.faces = Faces::cut;
  return problem;
}

TEST(BondCorrections, a_cut_bond_takes_at_most_eight_bytes) {
  Problem straight = plate();
  add_polyline(straight, {{0.25, 0.5}, {0.75, 0.5}});
  for (const Problem& problem : {straight, plate_with_slanted_crack(), plate_with_curved_crack()}) {
    const Corrected body(with_cut_bonds(problem));
    EXPECT_LE(body.corrections.bytes(), 8 * body.bonds());
  }
}

/// Those of a slanted crack are hardly ever alike; listed one by one they take twelve bytes.
TEST(BondCorrections, a_mirrored_bond_takes_at_most_eight_bytes) {
  const Corrected body(plate_with_slanted_crack());
  EXPECT_GT(body.bonds(), 10'000U);
  EXPECT_LE(body.corrections.bytes(), 8 * body.bonds());
}

TEST(BondCorrections, the_ends_of_a_mirrored_bond_exchange_the_same) {
  const Corrected body(plate_with_slanted_crack());
  const Body& what = body.geometry.body;
  const auto conductance = [&](std::size_t point, const StencilEntry& entry) {
    double sum = entry.conductance * what.materials[0].conductivity;
    body.corrections.visit(body.layout.entry(what.grid.index(point)), [&](std::int64_t way, double difference) {
      if (way == body.layout.distance(entry.offset)) sum += difference;
    });
    return sum * what.faces.volume(point);
  };
  for (const std::int64_t number : what.faces.points()) {
    const auto point = static_cast<std::size_t>(number);
    for (const auto& entry : body.geometry.stencil.entries) {
      const GridIndex p = what.grid.index(point);
      const GridIndex q{p[0] + entry.offset[0], p[1] + entry.offset[1], 0};
      if (!what.grid.contains(q)) continue;
      const double there = conductance(point, entry);
      const double back =
          conductance(what.grid.number(q), {{-entry.offset[0], -entry.offset[1], 0}, entry.conductance});
      EXPECT_NEAR(there, back, rounding(4, entry.conductance * what.materials[0].conductivity));
    }
  }
}

TEST(BondCorrections, threads_change_no_bit) {
  const Problem problem = plate_with_growing_crack();
  const int before = omp_get_max_threads();
  std::vector<double> first;
  for (const int threads : {1, 3}) {
    omp_set_num_threads(threads);
    const Corrected body(problem);
    const std::vector<double> temperature = waves(body.layout.size());
    std::vector<double> result(temperature.size(), 0.0);
    body.corrections.apply(temperature, 1.0, result);
    if (first.empty()) first = result;
    EXPECT_EQ(result, first);
  }
  omp_set_num_threads(before);
}

TEST(BondCorrections, the_ends_of_a_bond_are_corrected_alike) {
  const Corrected body(with_cut_bonds(plate_with_curved_crack()));
  const Grid& grid = body.geometry.body.grid;
  body.for_points([&](std::size_t entry) {
    body.corrections.visit(entry, [&](std::int64_t distance, double difference) {
      const auto other = static_cast<std::size_t>(static_cast<std::int64_t>(entry) + distance);
      if (!grid.contains(body.layout.index(other))) return;
      double back = 0.0;
      body.corrections.visit(other, [&](std::int64_t way, double d) { back += way == -distance ? d : 0.0; });
      EXPECT_EQ(back, difference);
    });
  });
}

TEST(BondCorrections, bonds_that_cracks_cut_are_counted_on_the_way) {
  for (const Problem& problem : {plate_with_curved_crack(), plate_with_growing_crack()}) {
    const Corrected body(problem);
    const CutBonds counted = find_cut_bonds(body.geometry.body, body.geometry.stencil);
    for (const double time : {0.0, 0.3, 1e9}) {
      EXPECT_EQ(body.corrections.cut_bonds().count_before(time), counted.count_before(time));
    }
  }
}

TEST(BondCorrections, a_body_without_cracks_and_walls_has_none) {
  const Corrected body(plate());
  EXPECT_TRUE(body.corrections.empty());
  EXPECT_EQ(body.bonds(), 0U);
}

}  // namespace
}  // namespace peritherm
