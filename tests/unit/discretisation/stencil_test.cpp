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

/// Continuum calibration at a horizon ratio on cells of edge 1.
Stencil published_stencil(KernelForm form, PartialVolumes rule, double ratio, int dimension,
                          SelfTerm self_term = SelfTerm::none) {
  StencilOptions chosen = options(form, 2, ratio);
  chosen.partial_volumes = rule;
  chosen.calibration = Calibration::continuum;
  chosen.self_term = self_term;
  return make_stencil(chosen, 1.0, dimension);
}

double published_conductivity(KernelForm form, PartialVolumes rule, double ratio, int dimension,
                              SelfTerm self_term = SelfTerm::none) {
  return effective_conductivity(published_stencil(form, rule, ratio, dimension, self_term), 1.0, dimension);
}

// With ω = 1 each neighbour conducts in proportion to what counts of its cell, so the sums are those of lengths.
TEST(Stencil, quadratures_of_the_constant_kernel_have_their_closed_conductivity_in_1d) {
  const ConstantKernel constant;
  const double tolerance = rounding(64, 2.0);
  for (const double m : {1.5, 2.0, 2.25, 3.0, 3.367, 4.0, 4.432, 8.0, 16.0}) {
    const double whole = std::floor(m + 1e-9) / m;
    EXPECT_NEAR(published_conductivity(constant, PartialVolumes::whole, m, 1), whole, tolerance) << m;
    EXPECT_NEAR(published_conductivity(constant, PartialVolumes::half, m, 1), (m - 0.5) / m, tolerance) << m;
    EXPECT_NEAR(published_conductivity(constant, PartialVolumes::half_normalised, m, 1), 1.0, tolerance) << m;
    EXPECT_NEAR(published_conductivity(constant, PartialVolumes::trapezoid, m, 1), 1.0, tolerance) << m;
    double integrated = 0.0;
    for (double j = 1.0; j - 0.5 < m; j += 1.0) {
      integrated += j * j * (1.0 / (j - 0.5) - 1.0 / std::min(j + 0.5, m)) / m;
    }
    EXPECT_NEAR(published_conductivity(constant, PartialVolumes::cell_integrated, m, 1), integrated, 1e-11) << m;
    if (m == std::floor(m)) EXPECT_NEAR(integrated, 1.0, tolerance) << m;  // telescopes
  }
}

TEST(Stencil, quadratures_that_fill_the_horizon_conduct_exactly_in_all_dimensions) {
  for (int dimension = 2; dimension <= 3; ++dimension) {
    for (const double m : {1.5, 2.3, 3.0}) {
      const double tolerance = 1e-11 * std::pow(2.0 * m + 2.0, dimension);
      const double filled = 1.0 - 1.0 / ball_volume(m, dimension);
      EXPECT_NEAR(published_conductivity(ConstantKernel{}, PartialVolumes::half, m, dimension), filled, tolerance);
      EXPECT_NEAR(published_conductivity(ConstantKernel{}, PartialVolumes::half_normalised, m, dimension), 1.0,
                  tolerance);
      EXPECT_NEAR(published_conductivity(ConstantKernel{}, PartialVolumes::trapezoid, m, dimension), 1.0, tolerance);
    }
  }
}

TEST(Stencil, cell_integrated_entries_have_the_closed_weights_in_1d) {
  const Stencil stencil = published_stencil(ConstantKernel{}, PartialVolumes::cell_integrated, 4.0, 1);
  ASSERT_EQ(stencil.entries.size(), 8u);
  for (const auto& [o, conductance] : stencil.entries) {
    const double j = std::abs(o[0]);
    const double weight = j < 4.0 ? j * j / (j * j - 0.25) : j / (2.0 * j - 1.0);
    // κ = k/(δ ξ²) at ξ = j.
    EXPECT_NEAR(conductance * j * j * 4.0, weight, 1e-11 * weight) << j;
  }
}

TEST(Stencil, the_self_term_of_2010_completes_half_cells_exactly) {
  for (int m = 2; m <= 16; m *= 2) {
    for (const KernelForm& form : {KernelForm{ConstantKernel{}}, KernelForm{LinearKernel{}}}) {
      EXPECT_NEAR(published_conductivity(form, PartialVolumes::half, m, 1, SelfTerm::bobaru_2010), 1.0,
                  rounding(5 * 64, 1.0));
    }
  }
}

/// What a self term of eight neighbours adds in 2-D if k is taken at `kernel_share` of a neighbour's distance and that
/// is measured as `share` of it: (1/2) Σ (1/8) k(kernel_share r)/(share r)² ξ_x² for the conical kernel.
double eight_neighbours(double m, double kernel_share, double share) {
  double sum = 0.0;
  for (const double r : {1.0, std::sqrt(2.0)}) {
    const double k = 12.0 / (std::numbers::pi * m * m) * (1.0 - kernel_share * r / m);
    const double squares = r == 1.0 ? 2.0 : 4.0;  // Σ ξ_x² over four neighbours at this distance
    sum += 0.5 / 8.0 * k / (share * share * r * r) * squares;
  }
  return sum;
}

// Computed independently and printed to these digits; columns: as published, with k(r), with k(r) and s = r, none.
TEST(Stencil, the_self_term_of_2012_has_the_known_effective_conductivities) {
  struct Row {
    double m, published, at_neighbour, whole_distance, none, half_digit;
  };
  for (const Row& row :
       {Row{3.0, 1.2697, 1.1843, 0.9940, 0.9306, 5e-5}, Row{4.0, 1.1613, 1.1253, 1.0003, 0.9586, 5e-5},
        Row{5.2, 1.1005, 1.0841, 1.0027, 0.9756, 5e-5}, Row{6.5, 1.066318, 1.057924, 1.002710, 0.984305, 5e-7},
        Row{6.933, 1.0585, 1.0516, 1.0024, 0.9860, 5e-5}, Row{10.4, 1.0269, 1.0248, 1.0014, 0.9936, 5e-5},
        Row{20.0, 1.0075, 1.0072, 1.0005, 0.9983, 5e-5}}) {
    const PartialVolumes rule = PartialVolumes::partial_area;
    const double none = published_conductivity(LinearKernel{}, rule, row.m, 2);
    const double published = published_conductivity(LinearKernel{}, rule, row.m, 2, SelfTerm::bobaru_2012);
    EXPECT_NEAR(none, row.none, row.half_digit) << row.m;
    EXPECT_NEAR(published, row.published, row.half_digit) << row.m;
    EXPECT_NEAR(published - none, eight_neighbours(row.m, 0.5, 0.5), rounding(64, 1.0)) << row.m;
    EXPECT_NEAR(none + eight_neighbours(row.m, 1.0, 0.5), row.at_neighbour, row.half_digit) << row.m;
    EXPECT_NEAR(none + eight_neighbours(row.m, 1.0, 1.0), row.whole_distance, row.half_digit) << row.m;
  }
}

TEST(Stencil, the_self_terms_share_of_each_entry_is_told) {
  const Stencil with = published_stencil(LinearKernel{}, PartialVolumes::partial_area, 2.5, 2, SelfTerm::bobaru_2012);
  const Stencil without = published_stencil(LinearKernel{}, PartialVolumes::partial_area, 2.5, 2);
  ASSERT_EQ(with.entries.size(), without.entries.size());
  ASSERT_EQ(with.self.size(), with.entries.size());
  EXPECT_TRUE(without.self.empty());
  for (std::size_t k = 0; k < with.entries.size(); ++k) {
    const auto& [x, y, z] = with.entries[k].offset;
    EXPECT_EQ(with.self[k] > 0.0, std::max(std::abs(x), std::abs(y)) == 1);
    EXPECT_DOUBLE_EQ(with.entries[k].conductance, without.entries[k].conductance + with.self[k]);
  }
}

TEST(Stencil, reflections_and_exchanges_of_axes_keep_the_bits) {
  StencilOptions chosen = options(QuadraticKernel{}, 2, 0.021);
  chosen.self_term = SelfTerm::bobaru_2012;
  for (const auto& [rule, name] : EnumNames<PartialVolumes>::values) {
    SCOPED_TRACE(name);
    chosen.partial_volumes = rule;
    const Stencil stencil = make_stencil(chosen, 0.01, 3);
    std::map<GridIndex, double> by_offset;
    for (const auto& [offset, conductance] : stencil.entries) by_offset[offset] = conductance;
    ASSERT_EQ(by_offset.size(), stencil.entries.size());
    for (const auto& [offset, conductance] : stencil.entries) {
      const auto& [x, y, z] = offset;
      for (const GridIndex& image :
           {GridIndex{-x, y, z}, GridIndex{x, -y, z}, GridIndex{x, y, -z}, GridIndex{y, z, x}}) {
        ASSERT_TRUE(by_offset.contains(image));
        EXPECT_EQ(by_offset[image], conductance);
      }
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

TEST(Stencil, entries_are_the_kernel_times_both_volumes_before_calibration) {
  StencilOptions chosen = options(GaussianKernel{1.5}, 1, 0.25);
  chosen.calibration = Calibration::continuum;
  chosen.partial_volumes = PartialVolumes::whole;
  const double amplitude = micro_conductivity_amplitude(chosen.kernel, 1.0, 0.25, 2);
  for (const auto& [o, conductance] : make_stencil(chosen, 0.1, 2).entries) {
    const double distance = std::sqrt(static_cast<double>(o[0] * o[0] + o[1] * o[1])) * 0.1;
    const double expected = amplitude * shape(chosen.kernel, distance / 0.25) / distance * std::pow(0.1, 4);
    EXPECT_NEAR(conductance, expected, rounding(8, expected));
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
