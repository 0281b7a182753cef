#include "peritherm/reduction/micro_conductivity.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/assembled_case.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

/// Figures 4 and 5 of the paper: 100 points over 1 m, horizon 0.4 m, nothing outside.
Problem kernel_bar(Kernel kernel, double conductivity) {
  Problem problem = unit_body(1, 100, 40.0);
  problem.materials["body"].conductivity = conductivity;
  problem.nonlocality.kernel = kernel;
  problem.nonlocality.partial_volumes = PartialVolumes::whole;
  problem.nonlocality.calibration = Calibration::continuum;
  set_all_faces(problem, Insulated{Outside::natural});
  return problem;
}

RetainedPoints every_fourth() {
  RetainedPoints choice;
  choice.every = std::vector<int>{4};
  return choice;
}

/// Σ_j of the 13th retained point, point 48, times the volume of a point: the diagonal of the paper's matrices.
struct DiagonalSums {
  double full = 0.0, condensed = 0.0;
};
DiagonalSums diagonal_sums(const Problem& problem) {
  AssembledCase bar(problem);
  const std::vector<double> volumes(100, 0.01);
  DiagonalSums sums;
  for (const MicroConductivity& pair : condensed_micro_conductivity(every_fourth(), bar.full(), volumes)) {
    if (pair.first != 48 && pair.second != 48) continue;
    sums.full += 0.01 * pair.full;
    sums.condensed += 0.01 * pair.condensed;
  }
  return sums;
}

TEST(MicroConductivity, of_condensed_bars_is_that_of_the_reference) {
  // Conductivities for which κ(0) is 2k/δ² with k = 1, and for the linear and quadratic kernels 2k/δ and 15k/(8δ), as
  // the paper takes them: fitted to 1/|ξ|², used with 1/|ξ|. Half a unit of the last digit given.
  const double all = 12.5 * 0.4 * 0.4 * 0.4 / 3.0;
  EXPECT_NEAR(diagonal_sums(kernel_bar({ConstantKernel{}, 0}, all)).condensed, 9.60701164, 5e-9);
  EXPECT_NEAR(diagonal_sums(kernel_bar({ConstantKernel{}, 1}, 1.0)).condensed, 98.19632237, 5e-9);
  EXPECT_NEAR(diagonal_sums(kernel_bar({LinearKernel{}, 1}, 5.0 / 37.5)).condensed, 28.66526086, 5e-9);
  EXPECT_NEAR(diagonal_sums(kernel_bar({QuadraticKernel{}, 1}, 4.6875 / 37.5)).condensed, 28.98850966, 5e-9);
}

TEST(MicroConductivity, of_the_full_bar_is_that_of_its_kernel) {
  AssembledCase bar(kernel_bar({ConstantKernel{}, 1}, 1.0));
  const std::vector<double> volumes(100, 0.01);
  std::size_t wider = 0;
  for (const MicroConductivity& pair : condensed_micro_conductivity(every_fourth(), bar.full(), volumes)) {
    EXPECT_NEAR(pair.distance, 0.01 * static_cast<double>(pair.second - pair.first), 1e-12);
    // 2k/δ² over the distance.
    const double own = pair.distance < 0.4 + 1e-9 ? 12.5 / pair.distance : 0.0;
    EXPECT_NEAR(pair.full, own, 1e-9 * 12.5 / 0.04);
    EXPECT_GT(pair.condensed, own);
    wider += own == 0.0 ? 1 : 0;
  }
  // Condensation widens the horizon: all pairs exchange heat.
  EXPECT_GT(wider, 100U);
}

TEST(MicroConductivity, is_written_as_a_table) {
  AssembledCase bar(kernel_bar({ConstantKernel{}, 1}, 1.0));
  const std::vector<double> volumes(100, 0.01);
  const auto table = condensed_micro_conductivity(every_fourth(), bar.full(), volumes);
  const auto path = std::filesystem::temp_directory_path() / "peritherm_micro_conductivity.csv";
  write_micro_conductivity(table, bar.grid(), path);
  std::ifstream file(path);
  std::string head, first;
  std::getline(file, head);
  std::getline(file, first);
  EXPECT_EQ(head, "first,second,first_x_m,second_x_m,distance_m,full_W_per_m6_K,condensed_W_per_m6_K");
  EXPECT_EQ(first.rfind("0,4,0.005,0.045,0.04,312.5,", 0), 0U) << first;
  std::size_t lines = 1;
  for (std::string line; std::getline(file, line);) ++lines;
  EXPECT_EQ(lines, table.size());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace peritherm
