#include <gtest/gtest.h>

#include "peritherm/solutions/classical.hpp"
#include "support/order_of_convergence.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

constexpr Slab slab{1.0, 1.0};
constexpr double decay_end = 0.1;

struct Choice {
  int dimension;
  std::vector<int> cells;
  double horizon_ratio;
  PointPlacement points = PointPlacement::centres;
  Kernel kernel{};
  Calibration calibration = Calibration::discrete;
};

Problem make_problem(const Choice& choice, int cells) {
  Problem problem = unit_body(choice.dimension, cells, choice.horizon_ratio);
  problem.body.points = choice.points;
  problem.nonlocality.kernel = choice.kernel;
  problem.nonlocality.calibration = choice.calibration;
  // Errors in time stay two orders below those in space, which are larger on the coarse grids in 3-D.
  problem.time.integrator = RungeKuttaLegendre{choice.dimension == 3 ? 1e-6 : 1e-8};
  return problem;
}

std::vector<double> errors_of_held_box(const Choice& choice) {
  std::vector<double> errors;
  for (const int cells : choice.cells) {
    Problem problem = make_problem(choice, cells);
    problem.initial.temperature = 1.0;
    set_all_faces(problem, held_at(0.0));
    March run(problem);
    run.advance_to(decay_end);
    errors.push_back(run.relative_error([&](const Point& x) {
      double product = 1.0;
      for (int axis = 0; axis < choice.dimension; ++axis) product *= slab_with_held_ends(slab, x[axis], decay_end);
      return product;
    }));
  }
  return errors;
}

std::vector<double> errors_of_half_held_bar(const Choice& choice) {
  std::vector<double> errors;
  for (const int cells : choice.cells) {
    Problem problem = make_problem(choice, cells);
    problem.initial.temperature = 1.0;
    set_face(problem, Face::x_min, held_at(0.0));
    March run(problem);
    run.advance_to(decay_end);
    errors.push_back(run.relative_error([](const Point& x) { return slab_held_and_insulated(slab, x[0], decay_end); }));
  }
  return errors;
}

double order_of(const Choice& choice, const std::vector<double>& errors) {
  std::vector<double> spacings;
  for (const int cells : choice.cells) spacings.push_back(1.0 / cells);
  return order_of_convergence(spacings, errors);
}

const Kernel kernels[] = {Kernel{LinearKernel{}, 2}, Kernel{ConstantKernel{}, 2}};
template <class Errors>
void expect_second_order(Choice choice, const Errors& errors) {
  for (const Kernel& kernel : kernels) {
    for (const PointPlacement points : placements) {
      choice.kernel = kernel;
      choice.points = points;
      EXPECT_NEAR(order_of(choice, errors(choice)), 2.0, 0.1) << kernel.form.index() << ", " << name_of(points);
    }
  }
}

TEST(HorizonOrder, a_bar_with_held_ends_converges_with_order_two) {
  expect_second_order({1, {40, 80, 160, 320}, 4.0}, errors_of_held_box);
}

TEST(HorizonOrder, a_bar_held_at_one_end_converges_with_order_two) {
  expect_second_order({1, {40, 80, 160, 320}, 4.0}, errors_of_half_held_bar);
}

TEST(HorizonOrder, a_square_with_held_sides_converges_with_order_two) {
  expect_second_order({2, {24, 48, 96}, 3.0}, errors_of_held_box);
}

TEST(HorizonOrder, a_cube_with_held_faces_converges_with_order_two) {
  expect_second_order({3, {8, 16, 32}, 2.0}, errors_of_held_box);
}

TEST(HorizonOrder, continuum_calibration_stalls_at_a_fixed_horizon_ratio) {
  for (const int dimension : {1, 2}) {
    Choice choice{dimension, {32, 64, 128}, 3.0, PointPlacement::centres, Kernel{LinearKernel{}, 2}};
    choice.calibration = Calibration::continuum;
    const std::vector<double> errors = errors_of_held_box(choice);
    // Order 2 would divide the error by 4; what is left is the constant error of the conductivity.
    EXPECT_NEAR(errors[1] / errors[2], 1.0, 0.1) << dimension;
  }
}

}  // namespace
}  // namespace peritherm
