#include "peritherm/two_field/nonlocal_operators.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "peritherm/base/error.hpp"
#include "support/parts.hpp"
#include "support/tolerance.hpp"

namespace peritherm {
namespace {

const Kernel inverse_distance{ConstantKernel{}, 1};

NonlocalOperators operators_of(const ClosedPart& body, const Kernel& kernel = inverse_distance) {
  return NonlocalOperators(body.dimension, body.part, body.surface, kernel);
}

ClosedPart bar(std::size_t cells, double ratio) {
  const double spacing = 1.0 / static_cast<double>(cells);
  return box_part(1, {static_cast<int>(cells), 1, 1}, spacing, ratio * spacing);
}

/// A bar, a plate or a block in which no two directions are alike.
ClosedPart brick(int dimension) {
  const GridIndex cells = dimension == 3 ? GridIndex{8, 7, 6} : GridIndex{12, dimension > 1 ? 10 : 1, 1};
  return box_part(dimension, cells, 0.1, 0.1 * (dimension == 3 ? 2.0 : 3.0), {0.3, -0.2, 0.0});
}

const Point slope{0.7, -1.3, 0.4};

std::vector<double> linear_field(const SubDomain& part) {
  std::vector<double> values;
  for (const Point& x : part.positions) values.push_back(2.0 + dot(slope, x));
  return values;
}

std::vector<double> random_field(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> values(size);
  for (double& value : values) value = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
  return values;
}

struct Gradient {
  std::array<std::vector<double>, 3> values;
  Gradient(const NonlocalOperators& operators, ConstField temperature) {
    for (auto& value : values) value.resize(operators.size());
    operators.gradient(temperature, {values[0], values[1], values[2]});
  }
};

double inner(ConstField a, ConstField b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double largest_of(ConstField values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

std::vector<double> product_of(const PatternRows& rows, ConstField field) {
  std::vector<double> result(field.size(), 0.0);
  rows.add_product(1.0, field, result);
  return result;
}

TEST(NonlocalOperators, differentiates_linear_temperatures_exactly) {
  for (const int dimension : {1, 2, 3}) {
    const ClosedPart body = brick(dimension);
    const NonlocalOperators operators = operators_of(body);
    const Gradient found(operators, linear_field(body.part));
    for (int axis = 0; axis < dimension; ++axis) {
      for (const double value : found.values[axis]) EXPECT_NEAR(value, slope[axis], 1e-12) << dimension;
    }
  }
}

TEST(NonlocalOperators, has_a_divergence_adjoint_to_the_gradient) {
  for (const int dimension : {1, 2, 3}) {
    const NonlocalOperators operators = operators_of(brick(dimension));
    const std::vector<double> temperature = random_field(operators.size(), 1);
    std::array<std::vector<double>, 3> field;
    for (unsigned axis = 0; axis < 3; ++axis) field[axis] = random_field(operators.size(), axis + 2);
    const Gradient gradient(operators, temperature);
    std::vector<double> adjoint(operators.size(), 0.0);
    operators.add_adjoint_gradient({field[0], field[1], field[2]}, adjoint);
    double sum = 0.0;
    for (int axis = 0; axis < dimension; ++axis) sum += inner(gradient.values[axis], field[axis]);
    EXPECT_NEAR(inner(adjoint, temperature), sum, 1e-12 * static_cast<double>(operators.size()) / 0.1);
  }
}

TEST(NonlocalOperators, traces_are_exact_for_linear_temperatures) {
  for (const int dimension : {1, 2, 3}) {
    const ClosedPart body = brick(dimension);
    const NonlocalOperators operators = operators_of(body);
    const std::vector<double> temperature = linear_field(body.part);
    ASSERT_EQ(operators.traces().size(), body.surface.size());
    for (std::size_t p = 0; p < body.surface.size(); ++p) {
      const Trace& trace = operators.traces()[p];
      double value = 0.0, sum = 0.0;
      for (std::size_t n = 0; n < trace.points.size(); ++n) {
        sum += trace.weights[n];
        value += trace.weights[n] * temperature[static_cast<std::size_t>(trace.points[n])];
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
      EXPECT_NEAR(value, 2.0 + dot(slope, body.surface[p].position), 1e-12);
    }
  }
}

TEST(NonlocalOperators, traces_of_bars_have_the_known_weights) {
  const NonlocalOperators shortest = operators_of(bar(10, 1.0));
  ASSERT_EQ(shortest.traces()[0].weights.size(), 2U);
  EXPECT_NEAR(shortest.traces()[0].weights[0], 1.5, 1e-14);
  EXPECT_NEAR(shortest.traces()[0].weights[1], -0.5, 1e-14);
  const NonlocalOperators usual = operators_of(bar(20, 3.0));
  const std::vector<double> known{0.837302, 0.396825, 0.051587, -0.170635, -0.087302, -0.027778};
  for (const std::size_t end : {0U, 1U}) {
    const Trace& trace = usual.traces()[end];
    ASSERT_EQ(trace.weights.size(), known.size());
    for (std::size_t n = 0; n < known.size(); ++n) {
      const std::size_t place = end == 0 ? n : known.size() - 1 - n;
      EXPECT_NEAR(trace.weights[place], known[n], 5e-7) << "printed with six digits";
    }
  }
}

TEST(NonlocalOperators, refuses_bars_whose_end_layers_overlap) { EXPECT_THROW(operators_of(bar(8, 3.0)), Error); }

TEST(NonlocalOperators, stabilises_nothing_that_is_linear) {
  for (const int dimension : {1, 2, 3}) {
    const ClosedPart body = brick(dimension);
    const PatternRows rows = operators_of(body).conduction({}, 1.0);
    for (const double value : product_of(rows, linear_field(body.part))) EXPECT_NEAR(value, 0.0, 1e-12);
  }
}

/// Σ_j (b_ij + b_ji) (T_j − T_i) with b_ij = V_i tr(K_i⁻¹) ω V_j of a bar, by its definition.
std::vector<double> bond_based(const ClosedPart& body, ConstField temperature) {
  const SubDomain& part = body.part;
  std::vector<double> shape_tensor(part.size(), 0.0), result(part.size(), 0.0);
  const auto weight = [&](std::size_t i, std::size_t j) {
    const double distance = std::abs(part.positions[i][0] - part.positions[j][0]);
    return i == j || distance > part.horizon * 1.000001 ? 0.0 : 1.0 / distance;
  };
  for (std::size_t i = 0; i < part.size(); ++i) {
    for (std::size_t j = 0; j < part.size(); ++j) {
      const double xi = part.positions[j][0] - part.positions[i][0];
      shape_tensor[i] += weight(i, j) * xi * xi * part.volumes[j];
    }
  }
  for (std::size_t i = 0; i < part.size(); ++i) {
    for (std::size_t j = 0; j < part.size(); ++j) {
      const double both = 1.0 / shape_tensor[i] + 1.0 / shape_tensor[j];
      result[i] += part.volumes[i] * part.volumes[j] * weight(i, j) * both * (temperature[i] - temperature[j]);
    }
  }
  return result;
}

TEST(NonlocalOperators, conducts_like_bonds_with_full_stabilisation) {
  const ClosedPart body = bar(20, 3.0);
  const std::vector<double> temperature = random_field(20, 5);
  const std::vector<double> bonds = bond_based(body, temperature);
  const PatternRows rows = operators_of(body).conduction(isotropic_tensor(1, 1.0), 1.0);
  const std::vector<double> found = product_of(rows, temperature);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], bonds[i], 1e-12 * largest_of(bonds));
  const SparseMatrix matrix = rows.matrix();
  EXPECT_EQ(matrix.begin[11] - matrix.begin[10], 7) << "the rows of the bond-based model reach one horizon";
}

TEST(NonlocalOperators, has_the_known_micro_conductivity_inside) {
  // 2 k ω / K is 2 k / (A δ²) in a bar and 6 k / (π h δ³) in a plate where bonds are many.
  const SparseMatrix line = operators_of(bar(400, 40.0)).conduction(isotropic_tensor(1, 1.0), 1.0).matrix();
  const double spacing = 1.0 / 400.0, horizon = 40.0 * spacing;
  const double found = -line.values[static_cast<std::size_t>(line.begin[200])] / (spacing * spacing);
  EXPECT_NEAR(found * horizon, 2.0 / (horizon * horizon), 2.0 / (horizon * horizon) * 0.03)
      << "a sum over 40 cells instead of an integral is (1 + 1/40) times it";
}

TEST(NonlocalOperators, stabilisation_sees_the_sawtooth_that_the_gradient_does_not) {
  const ClosedPart body = bar(40, 3.0);
  const NonlocalOperators operators = operators_of(body);
  std::vector<double> sawtooth(40);
  for (std::size_t i = 0; i < 40; ++i) sawtooth[i] = i % 2 == 0 ? 1.0 : -1.0;
  const Gradient gradient(operators, sawtooth);
  for (std::size_t i = 6; i < 34; ++i) EXPECT_NEAR(gradient.values[0][i], 0.0, rounding(6, 40.0));
  const std::vector<double> stabilised = product_of(operators.conduction({}, 1.0), sawtooth);
  const std::vector<double> bonds = bond_based(body, sawtooth);
  for (std::size_t i = 12; i < 28; ++i) EXPECT_NEAR(stabilised[i], bonds[i], 1e-12 * largest_of(bonds));
  EXPECT_GT(inner(sawtooth, stabilised), 0.0);
}

TEST(NonlocalOperators, conduction_is_gradients_and_stabilisation_together) {
  const Tensor tensor{{{2.0, 0.3, -0.1}, {0.3, 1.0, 0.2}, {-0.1, 0.2, 0.5}}};
  for (const int dimension : {2, 3}) {
    const NonlocalOperators operators = operators_of(brick(dimension));
    const std::vector<double> temperature = random_field(operators.size(), 7);
    const Gradient gradient(operators, temperature);
    std::array<std::vector<double>, 3> flux;
    for (int a = 0; a < 3; ++a) {
      flux[a].assign(operators.size(), 0.0);
      for (std::size_t i = 0; i < operators.size(); ++i) {
        for (int b = 0; b < dimension; ++b) flux[a][i] += operators.volumes()[i] * tensor[a][b] * gradient.values[b][i];
      }
    }
    std::vector<double> expected = product_of(operators.conduction({}, 0.3), temperature);
    operators.add_adjoint_gradient({flux[0], flux[1], flux[2]}, expected);
    const std::vector<double> found = product_of(operators.conduction(tensor, 0.3), temperature);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12 * largest_of(expected));
  }
}

TEST(NonlocalOperators, conduction_is_symmetric_and_keeps_constants) {
  const NonlocalOperators operators = operators_of(brick(2));
  const PatternRows rows = operators.conduction(isotropic_tensor(2, 3.0), 0.2);
  const std::vector<double> one = random_field(operators.size(), 1), other = random_field(operators.size(), 2);
  EXPECT_NEAR(inner(one, product_of(rows, other)), inner(other, product_of(rows, one)), 1e-11);
  for (const double value : product_of(rows, std::vector<double>(operators.size(), 300.0))) {
    EXPECT_NEAR(value, 0.0, rounding(100, 300.0 * rows.diagonal(60)));
  }
}

TEST(NonlocalOperators, products_are_those_of_the_matrix) {
  const NonlocalOperators operators = operators_of(box_part(2, {40, 12, 1}, 0.1, 0.2));
  const std::vector<double> field = random_field(operators.size(), 4);
  for (const double conductivity : {1.0, 0.2}) {
    const PatternRows rows = operators.conduction(isotropic_tensor(2, conductivity), 1.0);
    const SparseMatrix matrix = rows.matrix();
    std::vector<double> found(field.size(), 1.0);
    rows.add_product(-2.0, field, found);
    for (std::size_t i = 0; i < field.size(); ++i) {
      double sum = 0.0;
      for (auto n = static_cast<std::size_t>(matrix.begin[i]); n < static_cast<std::size_t>(matrix.begin[i + 1]); ++n) {
        sum += matrix.values[n] * field[static_cast<std::size_t>(matrix.column_of[n])];
      }
      EXPECT_NEAR(found[i], 1.0 - 2.0 * sum, rounding(60, 4.0 * rows.diagonal(i)));
    }
  }
}

TEST(NonlocalOperators, rows_are_the_same_with_and_without_a_lattice) {
  // Traces, and with them the corrected layers, are others: the inside is compared.
  for (const int dimension : {1, 2}) {
    ClosedPart body = box_part(dimension, {24, dimension > 1 ? 20 : 1, 1}, 0.1, 0.1);
    const PatternRows with = operators_of(body).conduction(isotropic_tensor(dimension, 1.0), 0.5);
    const std::vector<GridIndex> places = body.part.places;
    body.part.places.clear();
    const PatternRows without = operators_of(body).conduction(isotropic_tensor(dimension, 1.0), 0.5);
    const std::vector<double> temperature = random_field(body.part.size(), 3);
    const std::vector<double> a = product_of(with, temperature), b = product_of(without, temperature);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool is_inside =
          places[i][0] >= 8 && places[i][0] < 16 && (dimension == 1 || std::abs(places[i][1] - 9) <= 1);
      if (is_inside) {
        EXPECT_NEAR(a[i], b[i], 1e-12 * largest_of(a));
      }
    }
  }
}

TEST(NonlocalOperators, keeps_equal_rows_once) {
  ClosedPart body = box_part(2, {80, 70, 1}, 0.1, 0.1);
  const PatternRows with = operators_of(body).conduction(isotropic_tensor(2, 1.0), 1.0);
  body.part.places.clear();
  const PatternRows without = operators_of(body).conduction(isotropic_tensor(2, 1.0), 1.0);
  // Rows differ within three horizons of a face, where G is corrected within two: 864 of 5600.
  EXPECT_LT(3 * with.bytes(), without.bytes());
}

/// The largest heating of a point in a uniform flux along an axis, per face of a cell.
double patch_residual(const ClosedPart& body, const NonlocalOperators& operators, int axis) {
  std::array<std::vector<double>, 3> flux;
  for (auto& along : flux) along.assign(operators.size(), 0.0);
  flux[axis].assign(operators.volumes().begin(), operators.volumes().end());
  std::vector<double> heat(operators.size(), 0.0);
  operators.add_adjoint_gradient({flux[0], flux[1], flux[2]}, heat);
  for (std::size_t p = 0; p < body.surface.size(); ++p) {
    const Trace& trace = operators.traces()[p];
    for (std::size_t n = 0; n < trace.points.size(); ++n) {
      heat[static_cast<std::size_t>(trace.points[n])] -=
          body.surface[p].area * body.surface[p].normal[axis] * trace.weights[n];
    }
  }
  return largest_of(heat) / std::pow(body.part.spacing, body.dimension - 1);
}

TEST(NonlocalOperators, a_uniform_flux_heats_nothing) {
  for (const int dimension : {1, 2, 3}) {
    ClosedPart body = brick(dimension);
    for (int axis = 0; axis < dimension; ++axis) {
      EXPECT_LT(patch_residual(body, operators_of(body), axis), 1e-14) << dimension;
    }
  }
}

TEST(NonlocalOperators, a_uniform_flux_heats_nothing_in_a_disc_of_rings) {
  const ClosedPart body = disc_part(10, 3.0);
  ASSERT_EQ(body.part.size(), 314U);
  const NonlocalOperators operators = operators_of(body);
  EXPECT_LT(patch_residual(body, operators, 0), 1e-14);
  EXPECT_LT(patch_residual(body, operators, 1), 1e-14);
  const Gradient found(operators, linear_field(body.part));
  for (std::size_t i = 0; i < body.part.size(); ++i) EXPECT_NEAR(found.values[1][i], slope[1], 1e-12);
}

/// The parts of a box of cells with a ball of its own in it, cut out of the cells.
std::vector<ClosedPart> parts_with_ball(int dimension, int cells, double ratio, double radius) {
  const double spacing = 1.0 / cells;
  const Grid grid{dimension, spacing, {cells, cells, dimension == 3 ? cells : 1}, {}, PointPlacement::centres};
  PartRegion ball;
  ball.shape = Ball{Coordinates(static_cast<std::size_t>(dimension), 0.5), radius};
  ball.name = "ball";
  ball.material = 1;
  const DividedBody body = divide_body(grid, {"matrix", 0, ratio * spacing}, {ball});
  std::vector<ClosedPart> parts;
  for (const SubDomain& part : body.parts) parts.push_back({dimension, part, {}});
  for (SurfacePoint place : body.surface) {
    parts[static_cast<std::size_t>(place.first)].surface.push_back(place);
    if (place.second < 0) continue;
    for (double& component : place.normal) component = -component;
    parts[static_cast<std::size_t>(place.second)].surface.push_back(place);
  }
  return parts;
}

TEST(NonlocalOperators, a_uniform_flux_heats_nothing_where_cells_are_cut) {
  for (const int dimension : {2, 3}) {
    for (const ClosedPart& body : parts_with_ball(dimension, dimension == 2 ? 20 : 10, 2.0, 0.35)) {
      const NonlocalOperators operators = operators_of(body);
      for (int axis = 0; axis < dimension; ++axis) {
        // Sums over the 12 or 32 bonds of a point and those of its neighbours' rows.
        const std::size_t terms = dimension == 2 ? 24 : 64;
        EXPECT_LT(patch_residual(body, operators, axis), rounding(terms, 1.0)) << body.part.name << " in " << dimension;
      }
      const Gradient found(operators, linear_field(body.part));
      for (std::size_t i = 0; i < body.part.size(); ++i) EXPECT_NEAR(found.values[0][i], slope[0], 1e-12);
    }
  }
}

TEST(NonlocalOperators, says_that_a_surface_is_not_closed) {
  ClosedPart body = brick(2);
  body.surface.pop_back();
  try {
    operators_of(body);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("box: its surface does not close"), std::string::npos) << error.what();
  }
}

TEST(NonlocalOperators, stabilisation_is_never_negative) {
  const NonlocalOperators operators = operators_of(disc_part(6, 2.0));
  const PatternRows rows = operators.conduction({}, 1.0);
  for (unsigned seed = 0; seed < 5; ++seed) {
    std::vector<double> field = random_field(operators.size(), seed);
    // Smoothed ones, too: each product takes rough parts away.
    for (int step = 0; step < 20; ++step) {
      const std::vector<double> stabilised = product_of(rows, field);
      EXPECT_GE(inner(field, stabilised), -1e-14 * inner(field, field) * rows.diagonal(0));
      for (std::size_t i = 0; i < field.size(); ++i) field[i] -= 0.5 * stabilised[i] / rows.diagonal(i);
    }
  }
}

TEST(NonlocalOperators, names_the_place_of_a_point_with_too_few_neighbours) {
  const ClosedPart thin = box_part(2, {12, 1, 1}, 0.1, 0.3);
  try {
    operators_of(thin);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("box: the point at (0.05, 0.05, 0)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace peritherm
