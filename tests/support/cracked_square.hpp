#pragma once

#include <gtest/gtest.h>

#include "peritherm/discretisation/damage.hpp"
#include "support/published.hpp"
#include "support/run_problem.hpp"

namespace peritherm {

/// The plate of examples 3 to 5 of the 2012 paper: 2 cm x 2 cm, insulated sides, ±100 below and above; cracks only cut.
inline Problem cracked_square(int cells, double relative_tolerance) {
  Problem problem = unit_body(2, cells, 6.5);
  problem.body.origin = Coordinates{-0.01, -0.01};
  problem.body.size = {0.02, 0.02};
  problem.body.points = PointPlacement::boundary;
  problem.nonlocality.faces = Faces::cut;
  problem.materials["body"] = {114.0, 1e6, 1.0};
  set_face(problem, Face::y_min, held_at(-100.0));
  set_face(problem, Face::y_max, held_at(100.0));
  problem.time.end = 10.0;
  problem.time.integrator = RungeKuttaLegendre{relative_tolerance};
  return problem;
}

/// A crack between two places in centimetres.
inline void add_crack(Problem& problem, const Coordinates& from, const Coordinates& to) {
  problem.cracks.emplace_back().points = {{0.01 * from[0], 0.01 * from[1]}, {0.01 * to[0], 0.01 * to[1]}};
}

inline std::size_t count_of_cut_bonds(const Problem& problem) {
  const Geometry geometry = make_geometry(problem);
  return find_cut_bonds(geometry.body, geometry.stencil).size();
}

/// Compares every row of a table that belongs to a number of cells; rows are in the order of time.
inline void expect_published(const Problem& problem, const Published& published, double tolerance) {
  const int cells = problem.body.cells->front();
  March run(problem);
  std::size_t compared = 0;
  double largest = 0.0;
  for (std::size_t row = 0; row < published.size(); ++row) {
    if (published.number(row, "cells") != cells) continue;
    const double time = published.number(row, "time_s");
    run.advance_to(time);
    const Coordinates place{0.01 * published.number(row, "x_cm"), 0.01 * published.number(row, "y_cm")};
    const double value = run.at(place);
    const double right = published.number(row, "temperature");
    EXPECT_NEAR(value, right, tolerance) << "t = " << time << ", x = " << place[0] << ", y = " << place[1];
    largest = std::max(largest, std::abs(value - right));
    ++compared;
  }
  EXPECT_GT(compared, 0U);
  ::testing::Test::RecordProperty("largest_difference_" + std::to_string(cells), std::to_string(largest));
}

/// Largest difference between the probes of a table from this run and from one with a tenth of its tolerance.
inline double error_in_time(const Problem& problem, const Published& published) {
  Problem finer = problem;
  std::get<RungeKuttaLegendre>(finer.time.integrator).relative_tolerance *= 0.1;
  March run(problem);
  March reference(finer);
  double largest = 0.0;
  for (std::size_t row = 0; row < published.size(); ++row) {
    if (published.number(row, "cells") != problem.body.cells->front()) continue;
    run.advance_to(published.number(row, "time_s"));
    reference.advance_to(published.number(row, "time_s"));
    const Coordinates place{0.01 * published.number(row, "x_cm"), 0.01 * published.number(row, "y_cm")};
    largest = std::max(largest, std::abs(run.at(place) - reference.at(place)));
  }
  return largest;
}

}  // namespace peritherm
