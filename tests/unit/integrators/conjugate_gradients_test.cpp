#include "peritherm/integrators/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include "peritherm/integrators/heat_paths.hpp"
#include "peritherm/integrators/loss_rates.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

TEST(SmallestRitzValue, of_one_iteration_is_the_inverse_length) {
  EXPECT_NEAR(smallest_ritz_value({0.25}, {}), 4.0, 0.04);
}

TEST(SmallestRitzValue, of_as_many_iterations_as_unknowns_is_the_smallest_eigenvalue) {
  // Conjugate gradients on diag(1, 2, 8) from (1, 1, 1), by hand in exact steps.
  const double diagonal[] = {1.0, 2.0, 8.0};
  double residual[] = {1.0, 1.0, 1.0}, direction[] = {1.0, 1.0, 1.0}, square = 3.0;
  std::vector<double> lengths, shares;
  for (int k = 0; k < 3; ++k) {
    double curvature = 0.0;
    for (int i = 0; i < 3; ++i) curvature += diagonal[i] * direction[i] * direction[i];
    lengths.push_back(square / curvature);
    double next = 0.0;
    for (int i = 0; i < 3; ++i) {
      residual[i] -= lengths.back() * diagonal[i] * direction[i];
      next += residual[i] * residual[i];
    }
    if (k < 2) shares.push_back(next / square);
    for (int i = 0; i < 3; ++i) direction[i] = residual[i] + next / square * direction[i];
    square = next;
  }
  EXPECT_NEAR(smallest_ritz_value(lengths, shares), 1.0, 0.011);
}

TEST(LossRates, are_the_diagonal_up_to_what_the_signs_of_neighbours_add) {
  Problem problem = unit_body(2, 12, 3.0);
  problem.materials["good"] = {100.0, 1.0, 1.0};
  problem.body.regions = {{"good", Box{{0.0, 0.0}, {1.0, 0.5}}}};
  set_face(problem, Face::x_min, held_at(1.0));
  const Assembly assembly = assemble(problem);
  HeatSystem& system = *assembly.system;
  std::vector<double> rates(system.size()), probe(system.size()), image(system.size());
  estimate_loss_rates(system, rates, probe, image);
  for (std::size_t n = 0; n < assembly.geometry.body.grid.size(); ++n) {
    const std::size_t entry = assembly.layout.entry(assembly.geometry.body.grid.index(n));
    std::fill(probe.begin(), probe.end(), 0.0);
    probe[entry] = 1.0;
    system.combine_linear(-1, probe, 1.0, {}, image, {});
    // Six standard deviations for the fewest bonds that any point has: a quarter of 28, and their mirror images double.
    const double spread = 6.0 / std::sqrt(7.0 / 2.0 * loss_rate_probes);
    EXPECT_NEAR(rates[entry] / -image[entry], 1.0, spread) << n;
  }
}

TEST(HeatPaths, lead_to_all_points_on_the_same_side_of_a_crack) {
  Problem problem = unit_body(2, 16, 2.5);
  problem.cracks.emplace_back().points = {{0.5, -0.1}, {0.5, 1.1}};
  set_face(problem, Face::x_min, held_at(1.0));
  const Assembly assembly = assemble(problem);
  std::vector<double> marks(assembly.system->size()), scratch(assembly.system->size());
  HeatPaths paths(*assembly.system);
  paths.mark_open(marks, scratch);
  for (std::size_t n = 0; n < assembly.geometry.body.grid.size(); ++n) {
    const GridIndex p = assembly.geometry.body.grid.index(n);
    EXPECT_EQ(marks[assembly.layout.entry(p)], p[0] < 8 ? 1.0 : 0.0) << n;
  }
  // One evaluation for each horizon of the half plate's width, one to begin with and one to see that no more is found.
  EXPECT_LE(paths.evaluations(), 6);
}

TEST(HeatPaths, lead_nowhere_from_an_insulated_body) {
  const Assembly assembly = assemble(unit_body(3, 5, 2.0));
  std::vector<double> marks(assembly.system->size()), scratch(assembly.system->size());
  HeatPaths(*assembly.system).mark_open(marks, scratch);
  EXPECT_EQ(std::count(marks.begin(), marks.end(), 0.0), static_cast<std::ptrdiff_t>(marks.size()));
}

}  // namespace
}  // namespace peritherm
