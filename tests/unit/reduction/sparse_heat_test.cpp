#include "peritherm/reduction/sparse_heat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/assembled_case.hpp"
#include "support/run_problem.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

Problem mixed_plate(BackendName backend) {
  Problem problem = unit_body(2, 12, 2.5);
  problem.materials["core"] = {5.0, 2.0, 1.0};
  problem.body.regions.push_back({"core", Box{{0.3, 0.3}, {0.6, 0.7}}});
  problem.body.regions.push_back({"void", Ball{{0.8, 0.2}, 0.12}});
  problem.cracks.emplace_back().points = {{0.1, 0.51}, {0.7, 0.51}};
  set_face(problem, Face::x_min, held_at(2.0));
  HeldTemperature held = held_at(1.0, Imposed::inner);
  held.thickness = 0.1;
  set_face(problem, Face::y_max, held);
  set_face(problem, Face::x_max, Convection{3.0, 1.0});
  problem.numerics.backend = backend;
  return problem;
}

/// The sparse product against the system's own rates.
void expect_same_rates(AssembledCase& plate) {
  const SparseHeat heat = plate.sparse_heat();
  const PaddedGrid& layout = plate.full().layout;
  std::vector<double> temperatures(heat.size());
  FieldStorage state(plate.system().size()), rates(plate.system().size());
  double largest = 0.0;
  for (std::size_t i = 0; i < heat.size(); ++i) {
    temperatures[i] = std::sin(1.7 * static_cast<double>(i * i % 101));
    state[layout.entry(layout.grid().index(static_cast<std::size_t>(heat.points[i])))] = temperatures[i];
  }
  plate.system().combine_linear(-1, state, 1.0, {}, rates);
  const std::vector<double> found = product(heat.conductances, temperatures);
  for (const double value : heat.conductances.values) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < heat.size(); ++i) {
    const double rate = rates[layout.entry(layout.grid().index(static_cast<std::size_t>(heat.points[i])))];
    EXPECT_NEAR(found[i], -heat.capacities[i] * rate, rounding(200, largest)) << i;
  }
}

TEST(SparseHeat, gives_the_rates_of_every_backend) {
  for (const BackendName backend : {BackendName::stencil, BackendName::bond}) {
    AssembledCase plate(mixed_plate(backend));
    expect_same_rates(plate);
  }
}

TEST(SparseHeat, is_symmetric_and_its_rows_sum_to_the_losses) {
  AssembledCase plate(mixed_plate(BackendName::stencil));
  const SparseHeat heat = plate.sparse_heat();
  const SparseMatrix& matrix = heat.conductances;
  const std::vector<double> sums = product(matrix, std::vector<double>(heat.size(), 1.0));
  std::vector<std::vector<double>> dense(heat.size(), std::vector<double>(heat.size(), 0.0));
  double largest = 0.0;
  for (std::size_t i = 0; i < heat.size(); ++i) {
    for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n) {
      dense[i][static_cast<std::size_t>(matrix.column_of[n])] = matrix.values[n];
      largest = std::max(largest, std::abs(matrix.values[n]));
    }
  }
  for (std::size_t i = 0; i < heat.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(dense[i][j], dense[j][i]);
    EXPECT_NEAR(sums[i], heat.losses[i], rounding(30, largest));
  }
}

TEST(SparseHeat, has_no_more_entries_than_there_are_bonds) {
  Problem problem = unit_body(2, 20, 3.0);
  set_all_faces(problem, Insulated{Outside::natural});
  problem.nonlocality.partial_volumes = PartialVolumes::whole;
  problem.nonlocality.kernel.form = ConstantKernel{};
  AssembledCase plate(problem);
  const SparseHeat heat = plate.sparse_heat();
  std::size_t pairs = 0;
  for (std::size_t a = 0; a < heat.size(); ++a) {
    for (std::size_t b = 0; b < heat.size(); ++b) {
      const GridIndex p = plate.grid().index(a), q = plate.grid().index(b);
      const int x = p[0] - q[0], y = p[1] - q[1];
      pairs += x * x + y * y <= 9 ? 1 : 0;
    }
  }
  EXPECT_EQ(heat.conductances.values.size(), pairs);
}

TEST(SparseHeat, needs_bonds_that_conduct_alike_both_ways) {
  Problem problem = unit_body(1, 20, 3.0);
  set_face(problem, Face::x_min, Insulated{Outside::slaved});
  AssembledCase bar(problem);
  EXPECT_THROW(bar.sparse_heat(), Error);
}

}  // namespace
}  // namespace peritherm
