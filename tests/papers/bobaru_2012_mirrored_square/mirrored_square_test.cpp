#include <gtest/gtest.h>

#include <map>

#include "peritherm/studies/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/published.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

constexpr double tolerance = 1e-8;  ///< of the integrator

/// Examples 1 and 2 of the 2012 paper on a square of edge 1.
Problem make_example(const Published& published, std::size_t row) {
  Problem problem = unit_body(2, static_cast<int>(published.number(row, "cells")), 6.5);
  problem.body.points = PointPlacement::boundary;
  if (published.text(row, "kernel") == "constant") problem.nonlocality.kernel.form = ConstantKernel{};
  const Imposed imposed = published.text(row, "scheme") == "constant" ? Imposed::constant : Imposed::mirror;
  problem.time.integrator = RungeKuttaLegendre{tolerance};
  if (published.text(row, "example") == "1") {
    problem.materials["body"].conductivity = 1.14;
    problem.initial.temperature = 40.0;
    set_all_faces(problem, held_at(0.0, imposed));
  } else {
    set_face(problem, Face::x_min, held_at(1.0, imposed));
  }
  return problem;
}

double classical_value(const std::string& example, double x, double t) {
  if (example == "1") return 40.0 * square_with_held_sides({1.0, 1.14}, x, 0.5, t);
  return slab_heated_from_one_end({1.0, 1.0}, x, t);
}

double relative_difference(const March& run, const std::string& example, double t) {
  const std::vector<double> values = run.temperatures();
  double difference = 0.0;
  double size = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const Point x = run.position(n);
    if (std::abs(x[1] - 0.5) > 1e-9) continue;
    const double right = classical_value(example, x[0], t);
    difference += (values[n] - right) * (values[n] - right);
    size += right * right;
  }
  return std::sqrt(difference / size);
}

/// Errors in time add up over the steps at most, and the norms change with them one to one.
double error_in_time(const March& run) { return tolerance * static_cast<double>(run.count().accepted); }

TEST(MirroredSquare, differs_from_the_classical_solution_as_in_the_reference) {
  const Published published("bobaru_2012_mirrored_square");
  std::map<std::string, std::vector<double>> errors;
  std::map<std::string, std::vector<double>> spacings;
  for (std::size_t row = 0; row < published.size(); ++row) {
    const std::string example = published.text(row, "example");
    const double time = published.number(row, "time_s");
    March run(make_example(published, row));
    run.advance_to(time);
    const double value = relative_difference(run, example, time);
    const double allowed = published.number(row, "half_digit") + error_in_time(run);
    EXPECT_NEAR(value, published.number(row, "relative_difference"), allowed) << "row " << row;
    const std::string series =
        published.text(row, "scheme") + " " + example + " " + published.text(row, "kernel") + " t = " + published.text(row, "time_s");
    errors[series].push_back(value);
    spacings[series].push_back(run.grid().spacing);
  }
  for (const auto& [series, values] : errors) {
    const double expected = series.starts_with("constant") ? 1.0 : 2.0;
    EXPECT_NEAR(order_of_convergence(spacings[series], values), expected, 0.1) << series;
  }
}

}  // namespace
}  // namespace peritherm
