#include "peritherm/discretisation/stencil.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "peritherm/base/error.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

StencilOptions options(KernelForm form, int exponent, double horizon) {
  StencilOptions result;
  result.kernel = Kernel{form, exponent};
  result.horizon = horizon;
  return result;
}

/// (1/2) Σ G ξ² along one axis, over the cell volume.
double conductivity_along(const Stencil& stencil, int axis, double spacing, int dimension) {
  double sum = 0.0;
  for (const StencilEntry& entry : stencil.entries) {
    sum += 0.5 * entry.conductance * std::pow(entry.offset[axis] * spacing, 2);
  }
  return sum / std::pow(spacing, dimension);
}

double symbol(const Stencil& stencil, const Point& wave_vector) {
  double sum = 0.0;
  for (const auto& [o, conductance] : stencil.entries) {
    sum += conductance * (1.0 - std::cos(wave_vector[0] * o[0] + wave_vector[1] * o[1] + wave_vector[2] * o[2]));
  }
  return sum;
}

TEST(Stencil, discrete_calibration_is_exact_along_every_axis_for_every_kernel) {
  const double spacing = 0.02;
  for (const KernelForm& form : {KernelForm{ConstantKernel{}}, KernelForm{LinearKernel{}},
                                 KernelForm{QuadraticKernel{}}, KernelForm{GaussianKernel{}}}) {
    for (int exponent = 0; exponent <= 2; ++exponent) {
      for (int dimension = 1; dimension <= 3; ++dimension) {
        const Stencil stencil = make_stencil(options(form, exponent, 3.3 * spacing), spacing, dimension);
        const double tolerance = rounding(stencil.entries.size(), 1.0);
        EXPECT_NEAR(effective_conductivity(stencil, spacing, dimension), 1.0, tolerance);
        for (int axis = 0; axis < dimension; ++axis) {
          EXPECT_NEAR(conductivity_along(stencil, axis, spacing, dimension), 1.0, tolerance);
        }
      }
    }
  }
}

// The values of the 2-D conical kernel with Algorithm 1 were computed independently and printed to these digits.
TEST(Stencil, continuum_calibration_has_the_known_effective_conductivity_in_2d) {
  const std::map<double, std::pair<double, double>> table{{3.0, {0.9306, 5e-5}},  {4.0, {0.9586, 5e-5}},
                                                          {5.2, {0.9756, 5e-5}},  {6.5, {0.984305, 5e-7}},
                                                          {10.4, {0.9936, 5e-5}}, {20.0, {0.9983, 5e-5}}};
  for (const auto& [ratio, expected] : table) {
    StencilOptions conical = options(LinearKernel{}, 2, ratio);
    conical.calibration = Calibration::continuum;
    EXPECT_NEAR(effective_conductivity(make_stencil(conical, 1.0, 2), 1.0, 2), expected.first, expected.second)
        << "horizon ratio " << ratio;
  }
}

TEST(Stencil, continuum_calibration_with_half_cells_has_the_closed_conductivity_in_1d) {
  for (int m = 2; m <= 16; m *= 2) {
    StencilOptions chosen = options(ConstantKernel{}, 2, m * 0.1);
    chosen.calibration = Calibration::continuum;
    chosen.partial_volumes = PartialVolumes::half;
    const double tolerance = rounding(5 * 64, 1.0);
    EXPECT_NEAR(effective_conductivity(make_stencil(chosen, 0.1, 1), 0.1, 1), 1.0 - 0.5 / m, tolerance);
    chosen.kernel.form = LinearKernel{};
    EXPECT_NEAR(effective_conductivity(make_stencil(chosen, 0.1, 1), 0.1, 1), 1.0 - 1.0 / m, tolerance);
  }
}

TEST(Stencil, reflections_and_exchanges_of_axes_keep_the_bits) {
  const Stencil stencil = make_stencil(options(QuadraticKernel{}, 1, 0.031), 0.01, 3);
  std::map<GridIndex, double> by_offset;
  for (const auto& [offset, conductance] : stencil.entries) by_offset[offset] = conductance;
  ASSERT_EQ(by_offset.size(), stencil.entries.size());
  for (const auto& [offset, conductance] : stencil.entries) {
    const auto& [x, y, z] = offset;
    for (const GridIndex& image : {GridIndex{-x, y, z}, GridIndex{x, -y, z}, GridIndex{x, y, -z}, GridIndex{y, z, x}}) {
      ASSERT_TRUE(by_offset.contains(image));
      EXPECT_EQ(by_offset[image], conductance);
    }
  }
}

TEST(Stencil, entries_come_in_the_order_of_point_numbers_without_the_point_itself) {
  const Stencil stencil = make_stencil(options(ConstantKernel{}, 2, 2.2), 1.0, 3);
  GridIndex before{0, 0, -100};
  for (const StencilEntry& entry : stencil.entries) {
    const auto& [x, y, z] = entry.offset;
    EXPECT_LT(std::tuple(before[2], before[1], before[0]), std::tuple(z, y, x));
    EXPECT_NE(entry.offset, (GridIndex{0, 0, 0}));
    before = entry.offset;
  }
}

TEST(Stencil, unused_axes_have_no_offsets) {
  for (const StencilEntry& entry : make_stencil(options(LinearKernel{}, 2, 3.0), 1.0, 1).entries) {
    EXPECT_EQ(entry.offset[1], 0);
    EXPECT_EQ(entry.offset[2], 0);
  }
}

TEST(Stencil, the_radius_is_that_of_the_farthest_covered_cell) {
  StencilOptions chosen = options(ConstantKernel{}, 2, 3.0);
  EXPECT_EQ(make_stencil(chosen, 1.0, 2).radius, 3);
  chosen.horizon = 3.6;
  EXPECT_EQ(make_stencil(chosen, 1.0, 2).radius, 4);
  chosen.partial_volumes = PartialVolumes::whole;
  EXPECT_EQ(make_stencil(chosen, 1.0, 2).radius, 3);
}

TEST(Stencil, a_neighbour_on_the_edge_of_the_horizon_counts_in_spite_of_rounding) {
  StencilOptions chosen = options(ConstantKernel{}, 2, 0.3);
  chosen.partial_volumes = PartialVolumes::whole;
  EXPECT_EQ(make_stencil(chosen, 0.1, 1).radius, 3);
}

TEST(Stencil, bonds_that_do_not_conduct_are_left_out) {
  StencilOptions chosen = options(LinearKernel{}, 2, 3.0);
  chosen.partial_volumes = PartialVolumes::whole;
  const Stencil stencil = make_stencil(chosen, 1.0, 1);
  EXPECT_EQ(stencil.radius, 2);
  EXPECT_EQ(stencil.entries.size(), 4u);
}

TEST(Stencil, a_horizon_that_reaches_no_neighbour_is_refused_and_the_spacing_named) {
  StencilOptions chosen = options(ConstantKernel{}, 2, 0.4);
  chosen.partial_volumes = PartialVolumes::whole;
  try {
    make_stencil(chosen, 0.5, 2);
    FAIL() << "a stencil without neighbours was made";
  } catch (const Error& error) {
    EXPECT_NE(error.issues().at(0).problem.find("reaches no neighbour"), std::string::npos);
    EXPECT_NE(error.issues().at(0).hint.find("0.5 m"), std::string::npos);
  }
}

TEST(Stencil, entries_are_the_cell_conductances_before_calibration) {
  StencilOptions chosen = options(GaussianKernel{1.5}, 1, 0.25);
  chosen.calibration = Calibration::continuum;
  for (const auto& [o, conductance] : make_stencil(chosen, 0.1, 2).entries) {
    const double distance = std::sqrt(static_cast<double>(o[0] * o[0] + o[1] * o[1])) * 0.1;
    EXPECT_DOUBLE_EQ(conductance, CellConductance(chosen, 0.1, 2)(distance));
  }
}

TEST(Stencil, a_change_of_the_unit_of_length_scales_conductances_as_length_to_the_dimension_minus_two) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    const Stencil metres = make_stencil(options(LinearKernel{}, 2, 3.5), 1.0, dimension);
    const Stencil millimetres = make_stencil(options(LinearKernel{}, 2, 3.5e3), 1e3, dimension);
    ASSERT_EQ(metres.entries.size(), millimetres.entries.size());
    const double factor = std::pow(1e3, dimension - 2);
    for (std::size_t k = 0; k < metres.entries.size(); ++k) {
      const double expected = factor * metres.entries[k].conductance;
      EXPECT_NEAR(millimetres.entries[k].conductance, expected, rounding(metres.entries.size(), expected));
    }
  }
}

// With nearest neighbours only, the symbol 2 G Σ_a (1 − cos k_a) is largest at the corner of the zone: 4 d G.
TEST(Stencil, the_largest_symbol_of_nearest_neighbours_is_bounded_sharply) {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    StencilOptions chosen = options(ConstantKernel{}, 2, 1.0);
    chosen.partial_volumes = PartialVolumes::whole;
    const Stencil stencil = make_stencil(chosen, 1.0, dimension);
    const double exact = 4.0 * dimension * stencil.entries[0].conductance;
    EXPECT_GE(largest_symbol(stencil, dimension), exact);
    EXPECT_LE(largest_symbol(stencil, dimension), 1.003 * exact);
  }
}

RC_GTEST_PROP(Stencil, no_wave_has_a_larger_symbol_than_the_bound, ()) {
  const int dimension = *rc::gen::inRange(1, 4);
  const double ratio = *rc::gen::inRange(1200, 3600) / 1000.0;
  const int exponent = *rc::gen::inRange(0, 3);
  const KernelForm form = *rc::gen::element(KernelForm{ConstantKernel{}}, KernelForm{LinearKernel{}});
  const Stencil stencil = make_stencil(options(form, exponent, ratio), 1.0, dimension);
  Point wave_vector{};
  for (int axis = 0; axis < dimension; ++axis)
    wave_vector[axis] = *rc::gen::inRange(-1000, 1001) * 1e-3 * std::numbers::pi;
  RC_ASSERT(symbol(stencil, wave_vector) <= largest_symbol(stencil, dimension));
}

}  // namespace
}  // namespace peritherm
