#include <gtest/gtest.h>

#include <map>

#include "peritherm/solutions/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/published.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

constexpr double end = 8.0;
constexpr Slab bar{10.0, 1.14};

/// Examples 1 and 2 of the 2010 paper, in centimetres.
Problem make_example(const std::string& example, const std::string& kernel, int cells) {
  Problem problem = unit_body(1, cells, 4.0);
  problem.body.size = {bar.length};
  problem.body.points = PointPlacement::boundary;
  problem.materials["body"].conductivity = bar.diffusivity;
  problem.nonlocality.partial_volumes = PartialVolumes::half;
  if (kernel == "constant") problem.nonlocality.kernel.form = ConstantKernel{};
  problem.time.end = end;
  problem.time.integrator = RungeKuttaLegendre{1e-10};
  if (example == "1") {
    problem.initial.temperature = 100.0;
    set_all_faces(problem, held_at(0.0));
  } else {
    problem.initial.temperature = Profile("abs(x - 5) < 1e-9 ? 30 : 60*(x < 5)");
    set_face(problem, Face::x_max, held_at(100.0));
  }
  return problem;
}

double classical_value(const std::string& example, double x) {
  if (example == "1") return 100.0 * slab_with_held_ends(bar, x, end);
  return slab_with_step_start(bar, {60.0, 0.0, 5.0}, 100.0, x, end);
}

double rms_relative_difference(const March& run, const std::string& example) {
  const std::vector<double> values = run.temperatures();
  const std::size_t first = example == "1" ? 1 : 0;
  double sum = 0.0;
  for (std::size_t n = first; n + 1 < values.size(); ++n) {
    const double right = classical_value(example, run.position(n)[0]);
    sum += std::pow(values[n] / right - 1.0, 2);
  }
  return std::sqrt(sum / static_cast<double>(values.size() - 1 - first));
}

TEST(MirroredBar, differs_from_the_classical_solution_as_in_the_reference) {
  const Published published("bobaru_2010_mirrored_bar");
  std::map<std::string, std::vector<double>> errors;
  std::map<std::string, std::vector<double>> spacings;
  for (std::size_t row = 0; row < published.size(); ++row) {
    const std::string example = published.text(row, "example");
    const std::string kernel = published.text(row, "kernel");
    March run(make_example(example, kernel, static_cast<int>(published.number(row, "cells"))));
    run.advance_to(end);
    const double value = rms_relative_difference(run, example);
    const double error_in_time = 1e-10 * static_cast<double>(run.count().accepted);
    EXPECT_NEAR(value, published.number(row, "rms"), published.number(row, "half_digit") + error_in_time) << row;
    errors[example + " " + kernel].push_back(value);
    spacings[example + " " + kernel].push_back(run.grid().spacing);
  }
  for (const auto& [series, values] : errors) {
    EXPECT_NEAR(order_of_convergence(spacings[series], values), 2.0, 0.1) << series;
  }
}

}  // namespace
}  // namespace peritherm
