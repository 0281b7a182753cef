#include <gtest/gtest.h>

#include <map>

#include "peritherm/solutions/classical.hpp"
#include "peritherm/studies/solve.hpp"
#include "support/order_of_convergence.hpp"
#include "support/published.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

constexpr Slab mei_slab{10.0, 10.0};

template <NamedEnum Enum>
Enum value_named(const std::string& name) {
  for (const auto& [value, known] : EnumNames<Enum>::values) {
    if (known == name) return value;
  }
  throw std::out_of_range("no choice " + name);
}

/// The bar of the 2021 paper in its scheme, in centimetres; ends held at their points.
Problem mei_bar(PartialVolumes rule, int cells, double ratio, double step) {
  Problem problem = unit_body(1, cells, ratio);
  problem.body.size = {mei_slab.length};
  problem.materials["body"].conductivity = mei_slab.diffusivity;
  problem.nonlocality.scheme = Scheme::mei_2021;
  problem.nonlocality.kernel.form = ConstantKernel{};
  problem.nonlocality.partial_volumes = rule;
  problem.initial.temperature = 100.0;
  problem.numerics = {BackendName::stencil, Precision::full, 1};
  problem.time.integrator = Chebyshev{1e-11};
  if (step > 0.0) problem.time.integrator = ForwardEuler{step};
  set_all_faces(problem, HeldTemperature{0.0, std::nullopt, std::nullopt});
  return problem;
}

double temperature_in_the_middle(const Problem& problem, double time) {
  return solve(problem, std::vector{time}).at(0, {5.0, 0.0, 0.0});
}

TEST(MeiBar, has_the_reference_temperatures_for_every_condition_quadrature_and_step) {
  const Published published("mei_2021_bar");
  std::vector<double> sizes, errors;
  for (std::size_t row = 0; row < published.size(); ++row) {
    const double ratio = published.number(row, "ratio");
    const int cells = static_cast<int>(published.number(row, "divisor") * ratio);
    const double step = published.number(row, "step");
    Problem problem = mei_bar(value_named<PartialVolumes>(published.text(row, "rule")), cells, ratio, step);
    const auto imposed = value_named<Imposed>(published.text(row, "imposed"));
    for (BoundaryOptions& boundary : problem.boundaries) {
      std::get<HeldTemperature>(boundary.condition).imposed = imposed;
    }
    const double value = temperature_in_the_middle(problem, 0.5);
    EXPECT_NEAR(value, published.number(row, "middle"), published.number(row, "half_digit")) << row;
    if (step > 0.0 || published.text(row, "rule") != "trapezoid" || ratio < 4.0) continue;
    sizes.push_back(1.0 / ratio);
    errors.push_back(std::abs(value - 77.27949332));  // from the nonlocal solution
  }
  EXPECT_NEAR(order_of_convergence(sizes, errors), 2.0, 0.1);
}

/// Differences from the classical solution at t = 0.5.
struct RerunErrors {
  double largest = 0.0, rms = 0.0, middle = 0.0, beside = 0.0;
};

RerunErrors errors_of_rerun(const Problem& problem) {
  const Solution solution = solve(problem, std::vector{0.5});
  const auto classical = [](double x) { return 100.0 * slab_with_held_ends(mei_slab, x, 0.5); };
  RerunErrors errors;
  const std::vector<double>& values = solution.temperatures.front();
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double error = values[n] - classical(solution.grid.position(solution.grid.index(n))[0]);
    errors.largest = std::max(errors.largest, std::abs(error));
    errors.rms += error * error / static_cast<double>(values.size());
  }
  errors.rms = std::sqrt(errors.rms);
  const std::size_t middle = values.size() / 2;
  errors.middle = std::abs(values[middle] - classical(solution.grid.position(solution.grid.index(middle))[0]));
  errors.beside = std::abs(solution.at(0, {1.1875, 0.0, 0.0}) - classical(1.1875));
  return errors;
}

TEST(MeiBar, the_rerun_with_a_ratio_that_is_no_whole_number_errs_as_in_the_reference) {
  struct Row {
    PartialVolumes rule;
    Calibration calibration;
    int cells;
    double ratio;
    RerunErrors expected;
  };
  const Calibration continuum = Calibration::continuum;
  for (const Row& row : {Row{PartialVolumes::whole, continuum, 80, 3.367, {4.444, 3.720, 4.444, 2.865}},
                         Row{PartialVolumes::half, continuum, 80, 3.367, {5.799, 4.737, 5.799, 3.437}},
                         Row{PartialVolumes::whole, Calibration::discrete, 80, 3.367, {1.556, 0.831, 0.523, 0.976}},
                         Row{PartialVolumes::half_normalised, continuum, 80, 3.367, {1.556, 0.703, 0.430, 0.811}},
                         Row{PartialVolumes::trapezoid, continuum, 80, 3.367, {1.556, 0.324, 0.118, 0.269}},
                         Row{PartialVolumes::whole, continuum, 640, 16.0, {4.374, 3.337, 2.271, 4.031}},
                         Row{PartialVolumes::trapezoid, continuum, 640, 16.0, {3.576, 2.740, 1.880, 3.304}}}) {
    Problem problem = mei_bar(row.rule, row.cells, row.ratio, 1e-4);
    problem.nonlocality.calibration = row.calibration;
    const RerunErrors errors = errors_of_rerun(problem);
    SCOPED_TRACE(std::string(name_of(row.rule)) + " on " + std::to_string(row.cells) + " cells");
    EXPECT_NEAR(errors.largest, row.expected.largest, 5e-4);
    EXPECT_NEAR(errors.rms, row.expected.rms, 5e-4);
    EXPECT_NEAR(errors.middle, row.expected.middle, 5e-4);
    EXPECT_NEAR(errors.beside, row.expected.beside, 5e-4);
  }
}

/// Coefficients of the quadratic through values at 2, 4 and 8.
std::array<double, 3> quadratic_through(const std::array<double, 3>& values) {
  const double first = (values[1] - values[0]) / 2.0, second = (values[2] - values[1]) / 4.0;
  const double curvature = (second - first) / 6.0;
  return {values[0] - 2.0 * first + 8.0 * curvature, first - 6.0 * curvature, curvature};
}

/// Smallest positive ratio at which the curves of two horizons cross.
double crossing_ratio(const std::array<double, 3>& coarse, const std::array<double, 3>& fine) {
  const auto a = quadratic_through(coarse), b = quadratic_through(fine);
  const double c0 = a[0] - b[0], c1 = a[1] - b[1], c2 = a[2] - b[2];
  const double root = std::sqrt(c1 * c1 - 4.0 * c2 * c0);
  const double one = (-c1 + root) / (2.0 * c2), other = (-c1 - root) / (2.0 * c2);
  return std::min(one, other) > 0.0 ? std::min(one, other) : std::max(one, other);
}

template <class MakeProblem>
double crossing_ratio_of(const MakeProblem& make, double time) {
  std::array<std::array<double, 3>, 2> values;
  for (int horizon = 0; horizon < 2; ++horizon) {
    for (int k = 0; k < 3; ++k) {
      const int ratio = 2 << k, divisor = 10 << horizon;
      values[horizon][k] = temperature_in_the_middle(make(divisor * ratio, ratio), time);
    }
  }
  return crossing_ratio(values[0], values[1]);
}

TEST(MeiBar, curves_over_the_ratio_cross_where_the_reference_says_for_each_quadrature) {
  const std::map<PartialVolumes, std::pair<double, double>> crossings{{PartialVolumes::whole, {2.8888, 5e-5}},
                                                                      {PartialVolumes::half, {3.327, 5e-4}},
                                                                      {PartialVolumes::half_normalised, {3.2555, 5e-5}},
                                                                      {PartialVolumes::cell_integrated, {3.3844, 5e-5}},
                                                                      {PartialVolumes::trapezoid, {3.5648, 5e-5}}};
  for (const auto& [rule, expected] : crossings) {
    const double crossing =
        crossing_ratio_of([rule](int cells, int ratio) { return mei_bar(rule, cells, ratio, 1e-4); }, 0.5);
    EXPECT_NEAR(crossing, expected.first, expected.second) << name_of(rule);
  }
}

/// Four segments, good conductors first and third.
Problem mei_segments(PartialVolumes rule, InterfaceRule interface, int cells, double ratio, double step) {
  Problem problem = mei_bar(rule, cells, ratio, step);
  problem.nonlocality.interface = interface;
  problem.materials["poor"] = {1.0, 1.0, 1.0};
  problem.body.regions = {{"poor", Box{{2.5}, {3.75}}}, {"poor", Box{{7.5}, {10.0}}}};
  return problem;
}

TEST(MeiBar, with_four_segments_curves_cross_where_the_reference_says_for_each_quadrature) {
  const std::map<PartialVolumes, double> crossings{{PartialVolumes::whole, 4.013},
                                                   {PartialVolumes::half_normalised, 4.378},
                                                   {PartialVolumes::cell_integrated, 4.714},
                                                   {PartialVolumes::trapezoid, 4.922}};
  for (const auto& [rule, expected] : crossings) {
    const auto make = [rule](int cells, int ratio) {
      return mei_segments(rule, InterfaceRule::sided_harmonic, cells, ratio, 1e-4);
    };
    EXPECT_NEAR(crossing_ratio_of(make, 2.0), expected, 5e-4) << name_of(rule);
  }
}

// The point at 3.75 belongs to the region that holds its edge, the poor segment.
TEST(MeiBar, a_point_on_an_interface_conducts_as_its_region_says_under_the_harmonic_rule) {
  const Problem problem = mei_segments(PartialVolumes::whole, InterfaceRule::harmonic, 20, 2.0, 1e-4);
  EXPECT_NEAR(temperature_in_the_middle(problem, 2.0), 77.30, 5e-3);
}

}  // namespace
}  // namespace peritherm
