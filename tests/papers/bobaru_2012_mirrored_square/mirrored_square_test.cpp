#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "peritherm/solutions/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/published.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// Of the integrator; the finest grid costs most, and its value is given to two digits only.
double tolerance_for(double cells) { return cells > 200 ? 1e-7 : 1e-8; }

/// Examples 1 and 2 of the 2012 paper on a square of edge 1.
Problem make_example(const Published& published, std::size_t row) {
  Problem problem = unit_body(2, static_cast<int>(published.number(row, "cells")), 6.5);
  problem.body.points = PointPlacement::boundary;
  if (published.text(row, "kernel") == "constant") problem.nonlocality.kernel.form = ConstantKernel{};
  const Imposed imposed = published.text(row, "scheme") == "constant" ? Imposed::constant : Imposed::mirror;
  problem.time.integrator = RungeKuttaLegendre{tolerance_for(published.number(row, "cells"))};
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

/// Rows of one problem follow each other in the order of time.
bool same_problem(const Published& published, std::size_t first, std::size_t second) {
  for (const char* column : {"example", "scheme", "kernel", "cells"}) {
    if (published.text(first, column) != published.text(second, column)) return false;
  }
  return true;
}

using Series = std::map<std::string, std::vector<double>>;

std::string series_name(const Published& published, std::size_t row) {
  return published.text(row, "scheme") + ", example " + published.text(row, "example") + ", " +
         published.text(row, "kernel") + ", t = " + published.text(row, "time_s");
}

void expect_orders(const Series& spacings, const Series& errors) {
  for (const auto& [name, values] : errors) {
    const double expected = name.starts_with("constant") ? 1.0 : 2.0;
    EXPECT_NEAR(order_of_convergence(spacings.at(name), values), expected, 0.1) << name;
  }
}

TEST(MirroredSquare, differs_from_the_classical_solution_as_in_the_reference) {
  const Published published("bobaru_2012_mirrored_square");
  Series errors;
  Series spacings;
  std::optional<March> run;
  for (std::size_t row = 0; row < published.size(); ++row) {
    const double time = published.number(row, "time_s");
    if (row == 0 || !same_problem(published, row - 1, row)) run.emplace(make_example(published, row));
    run->advance_to(time);
    const double value = relative_difference(*run, published.text(row, "example"), time);
    // Errors per step add up at most, and norms change with them one to one.
    const double error_in_time =
        tolerance_for(published.number(row, "cells")) * static_cast<double>(run->count().accepted);
    EXPECT_NEAR(value, published.number(row, "relative_difference"),
                published.number(row, "half_digit") + error_in_time)
        << series_name(published, row);
    errors[series_name(published, row)].push_back(value);
    spacings[series_name(published, row)].push_back(run->grid().spacing);
  }
  expect_orders(spacings, errors);
}

}  // namespace
}  // namespace peritherm
