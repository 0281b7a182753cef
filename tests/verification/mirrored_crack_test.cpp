#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "peritherm/solutions/classical.hpp"
#include "support/run_problem.hpp"

namespace peritherm {
namespace {

const std::vector<Coordinates> slit_probes{{0.0, 0.1}, {0.0, 0.25}, {0.0, 0.5}, {0.0, 0.75}, {1.0, 0.25}, {1.0, 0.5}};

/// The square [-1, 1]² with an insulated slit of half its width, held at ±100.
Problem mirrored_slit(int cells, double ratio, const KernelForm& form) {
  Problem problem = unit_body(2, cells, ratio);
  problem.body.origin = Coordinates{-1.0, -1.0};
  problem.body.size = {2.0, 2.0};
  problem.body.points = PointPlacement::boundary;
  problem.nonlocality.kernel.form = form;
  problem.nonlocality.faces = Faces::mirror;
  set_face(problem, Face::y_min, held_at(-100.0));
  set_face(problem, Face::y_max, held_at(100.0));
  problem.cracks.emplace_back().points = {{-0.5, 0.0}, {0.5, 0.0}};
  problem.time.end = 6.0;
  problem.time.integrator = RungeKuttaLegendre{1e-7};
  return problem;
}

TEST(MirroredCrack, meets_the_exact_slit_in_a_plate) {
  for (const KernelForm& form : {KernelForm{LinearKernel{}}, KernelForm{ConstantKernel{}}}) {
    March run(mirrored_slit(81, 6.5, form));
    run.advance_to(6.0);
    for (const Coordinates& place : slit_probes) {
      // With bonds that are only cut these are 0.3 to 3.4 off at this spacing.
      EXPECT_NEAR(run.at(place), 100.0 * slit_in_square(0.5, place[0], place[1]), 0.02) << place[0] << ' ' << place[1];
    }
  }
}

/// At t = 0.1 and 0.5; values of tools/slit_reference.py, right to 2e-6 of themselves.
constexpr double early[] = {5.734305, 9.823068, 26.421340, 57.621960, 8.844245, 26.280468};
constexpr double late[] = {42.617371, 47.198704, 61.161497, 79.640347, 27.083450, 52.393588};

TEST(MirroredCrack, warms_up_like_the_exact_slit) {
  March coarse(mirrored_slit(80, 6.5, LinearKernel{})), fine(mirrored_slit(160, 6.5, LinearKernel{}));
  coarse.advance_to(0.1);
  fine.advance_to(0.1);
  for (std::size_t k = 0; k < slit_probes.size(); ++k) {
    // So early the horizon of 0.16 itself delays heat, with or without crack: second order says that this is all.
    const double order = std::log2((coarse.at(slit_probes[k]) - early[k]) / (fine.at(slit_probes[k]) - early[k]));
    EXPECT_NEAR(order, 2.0, 0.1) << k;
  }
  coarse.advance_to(0.5);
  for (std::size_t k = 0; k < slit_probes.size(); ++k) {
    EXPECT_NEAR(coarse.at(slit_probes[k]), late[k], 2e-3 * late[k]) << k;
  }
}

TEST(MirroredCrack, warms_up_within_two_thousandths_of_each_value) {
  const std::pair<int, double> grids[] = {{160, 3.0}, {160, 4.0}, {240, 6.5}};
  for (const KernelForm& form : {KernelForm{LinearKernel{}}, KernelForm{ConstantKernel{}}}) {
    for (const auto& [cells, ratio] : grids) {
      March run(mirrored_slit(cells, ratio, form));
      for (const auto& [time, exact] : {std::pair(0.1, early), std::pair(0.5, late)}) {
        run.advance_to(time);
        for (std::size_t k = 0; k < slit_probes.size(); ++k) {
          EXPECT_NEAR(run.at(slit_probes[k]), exact[k], 2e-3 * exact[k]) << cells << ' ' << time << ' ' << k;
        }
      }
    }
  }
}

/// The left half of the plate is the image of the right one, and its wall the line of symmetry.
TEST(MirroredCrack, ends_at_a_wall_as_if_its_image_went_on) {
  for (const PointPlacement points : placements) {
    Problem whole = mirrored_slit(40, 3.0, LinearKernel{});
    whole.body.points = points;
    whole.initial.temperature = Profile("100*y + 20*x^2");
    Problem half = whole;
    half.body.size = {1.0, 2.0};
    half.body.cells = {20, 40};
    half.body.origin = Coordinates{0.0, -1.0};
    half.cracks[0].points = {{0.0, 0.0}, {0.5, 0.0}};
    March first(whole), second(half);
    first.advance_to(0.01);
    second.advance_to(0.01);
    for (const Coordinates& place : {Coordinates{0.3, 0.1}, {0.3, -0.1}, {0.6, 0.02}, {0.1, 0.4}}) {
      // The fit stops at 1e-9 of the second moment, time integration at 1e-7 per step of values of 100.
      EXPECT_NEAR(first.at(place), second.at(place), 1e-4) << place[0] << ' ' << place[1];
    }
  }
}

/// Steady Im √(z² − a²), z = (x + i y) exp(−i β), held in a layer around [-1, 1]². `offset`: of the grid, in spacings.
struct InclinedSlit {
  double angle = 0.0;  ///< β [degrees]
  double offset_x = 0.13, offset_y = 0.29;
  double ratio = 4.0;
  Faces faces = Faces::mirror;
  double root_mean_square(int points) const;
  double exact(double x, double y) const;
};

double InclinedSlit::exact(double x, double y) const {
  std::complex<double> z = std::complex<double>(x, y) * std::polar(1.0, -angle * std::numbers::pi / 180.0);
  // Points on the slit belong to its left side.
  if (std::abs(z.imag()) < 1e-12) z.imag(1e-15);
  return (std::sqrt(z - 0.5) * std::sqrt(z + 0.5)).imag();
}

/// The body is the square and the layer; the layer's temperature is an expression with the same branch.
double InclinedSlit::root_mean_square(int points) const {
  const double spacing = 2.0 / points, beta = angle * std::numbers::pi / 180.0;
  const int layer = static_cast<int>(std::ceil(ratio + 0.5));
  const int cells = points + 1 + 2 * layer;
  Problem problem = unit_body(2, cells, ratio);
  const double low = -1.0 - (layer + 0.5) * spacing;
  problem.body.origin = Coordinates{low + offset_x * spacing, low + offset_y * spacing};
  problem.body.size = {cells * spacing, cells * spacing};
  problem.body.points = PointPlacement::centres;
  problem.nonlocality.faces = faces;
  const std::string c = std::to_string(std::cos(beta)), s = std::to_string(std::sin(beta));
  const std::string u = "(" + c + "*x+" + s + "*y)", v = "(" + c + "*y-" + s + "*x)";
  const std::string re = "(" + u + "^2-" + v + "^2-0.25)", im = "(2*" + u + "*" + v + ")";
  const Profile exact_text("(" + v + ">0?1:-1)*sqrt(max(0,(sqrt(" + re + "^2+" + im + "^2)-" + re + ")/2))");
  problem.initial.temperature = exact_text;
  const auto& origin = *problem.body.origin;
  const double inner = layer * spacing, outer = cells * spacing;
  const auto hold = [&](double x0, double y0, double x1, double y1) {
    problem.boundaries.push_back({std::nullopt,
                                  Shape{Box{{origin[0] + x0, origin[1] + y0}, {origin[0] + x1, origin[1] + y1}}},
                                  held_at(exact_text)});
  };
  hold(0.0, 0.0, outer, inner);
  hold(0.0, outer - inner, outer, outer);
  hold(0.0, inner, inner, outer - inner);
  hold(outer - inner, inner, outer, outer - inner);
  Crack& crack = problem.cracks.emplace_back();
  crack.points = {{-0.5 * std::cos(beta), -0.5 * std::sin(beta)}, {0.5 * std::cos(beta), 0.5 * std::sin(beta)}};
  problem.time.end = 3.0;
  problem.time.integrator = RungeKuttaLegendre{1e-8};
  March run(problem);
  run.advance_to(3.0);
  double sum = 0.0;
  int count = 0;
  for (int j = 0; j <= points; ++j) {
    for (int i = 0; i <= points; ++i) {
      const double x = origin[0] + (layer + i + 0.5) * spacing, y = origin[1] + (layer + j + 0.5) * spacing;
      const double to_first = std::hypot(x - crack.points[0][0], y - crack.points[0][1]);
      const double to_second = std::hypot(x - crack.points[1][0], y - crack.points[1][1]);
      if (std::min(to_first, to_second) < 0.2) continue;
      sum += std::pow(run.at({x, y}) - exact(x, y), 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(MirroredCrack, has_second_order_at_any_angle) {
  for (const double angle : {0.0, 17.0, 45.0}) {
    const InclinedSlit slit{angle};
    const double coarse = slit.root_mean_square(41), fine = slit.root_mean_square(81);
    // Twice as fine: a quarter of the error at least; the tip's place between points makes it waver.
    EXPECT_LT(fine, coarse / 3.5) << angle;
    EXPECT_LT(coarse, 4e-4) << angle;
    InclinedSlit cut = slit;
    cut.faces = Faces::cut;
    EXPECT_GT(cut.root_mean_square(81), 70.0 * fine) << angle;
  }
}

TEST(MirroredCrack, along_a_line_of_points_is_no_worse) {
  for (const double angle : {0.0, 45.0}) {
    // Points stand on the crack, on its tips and ahead of them, where rounding must not decide on their side.
    const InclinedSlit on{angle, 0.0, 0.0}, beside{angle, 0.0, 1e-3};
    EXPECT_LT(on.root_mean_square(80), 1.1 * beside.root_mean_square(80)) << angle;
  }
}

/// A hot square inside a ring in a cold plate, insulated outside.
Problem hot_ring(const std::vector<Coordinates>& ring) {
  Problem problem = unit_body(2, 24, 3.0);
  problem.nonlocality.faces = Faces::mirror;
  problem.initial.temperature = Profile("abs(x - 0.5) < 0.25 && abs(y - 0.5) < 0.25");
  problem.cracks.emplace_back().points = ring;
  problem.time.integrator = RungeKuttaLegendre{1e-6};
  return problem;
}

TEST(MirroredCrack, lets_nothing_out_of_a_ring_however_it_is_closed) {
  const std::vector<Coordinates> open{{0.26, 0.26}, {0.74, 0.26}, {0.74, 0.74}, {0.26, 0.74}};
  for (const Coordinates& last : {Coordinates{0.26, 0.26}, {0.26, 0.26 + 1e-12}, {0.26, 0.24}}) {
    std::vector<Coordinates> ring = open;
    ring.push_back(last);
    March run(hot_ring(ring));
    run.advance_to(0.5);
    // The plate would be at 0.25 by now; rounding of some thousand evaluations.
    EXPECT_NEAR(run.at({0.5, 0.5}), 1.0, 1e-10) << last[1];
  }
}

TEST(MirroredCrack, keeps_heat_beside_other_materials_and_where_bonds_break) {
  for (const bool breaks : {false, true}) {
    Problem problem = unit_body(2, 20, 3.0);
    problem.nonlocality.faces = Faces::mirror;
    problem.initial.temperature = Profile("y < 0.5 ? 100*x : 0");
    problem.cracks.emplace_back().points = {{0.2, 0.53}, {0.8, 0.56}};
    if (breaks) {
      problem.damage.emplace();
      problem.damage->critical_elongation = 0.1;
      problem.damage->transmission = 0.5;
      problem.damage->displacement = {Profile(0.0), Profile("y > 0.55 ? 1 : -1")};
    } else {
      problem.materials["dense"] = {1.0, 50.0, 1.0};
      problem.body.regions.push_back({"dense", Box{{0.0, 0.5}, {1.0, 1.0}}});
    }
    problem.time.integrator = RungeKuttaLegendre{1e-6};
    March run(problem);
    const double before = run.stored_heat();
    run.advance_to(0.01);
    EXPECT_NEAR(run.stored_heat(), before, 1e-11 * before) << breaks;
    // Half of the plate at 50 on the average.
    EXPECT_NEAR(before, 25.0, 1e-9);
  }
}

TEST(MirroredCrack, beside_an_open_wall_lets_nothing_through) {
  for (const PointPlacement points : placements) {
    for (const double ratio : {1.0, 3.0}) {
      Problem problem = unit_body(1, 20, ratio);
      problem.body.points = points;
      problem.initial.temperature = Profile("x > 0.035 ? 1 : 0");
      problem.cracks.emplace_back().points = {{0.035}};
      set_face(problem, Face::x_min, Insulated{Outside::natural});
      March run(problem);
      run.advance_to(0.1);
      const std::vector<double> values = run.temperatures();
      // Rounding of some thousand evaluations.
      for (std::size_t n = 0; n < values.size(); ++n) EXPECT_NEAR(values[n], n == 0 ? 0.0 : 1.0, 1e-10) << n;
    }
  }
}

}  // namespace
}  // namespace peritherm
