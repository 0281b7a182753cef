#include <algorithm>
#include <cmath>

#include "check_property.hpp"
#include "measured_body.hpp"
#include "moved_problem.hpp"

namespace peritherm {
namespace {

/// A random body with a crack at least, whose cracks stand still and have faces that mirror.
Problem draw_mirrored(const BodyRequest& request) {
  Problem problem = *random_problem(request);
  RC_PRE(!problem.cracks.empty() && problem.nonlocality.scheme == Scheme::peritherm);
  for (Crack& crack : problem.cracks) {
    crack.tip_speed.reset();
    crack.start_time = 0.0;
    crack.faces = Faces::mirror;
  }
  RC_PRE(find_faults(problem).empty());
  return problem;
}

TEST(MirroredCracks, conduct_alike_by_stencil_and_bonds_and_keep_all_heat) {
  check_for_every_kernel({6, 1, 1}, [](const BodyRequest& request) {
    Problem problem = draw_mirrored(request);
    problem.boundaries.clear();
    problem.sources.clear();
    const MeasuredBody stencil = measure(problem, BackendName::stencil);
    const MeasuredBody bonds = measure(problem, BackendName::bond);
    std::vector<double> state = random_state(stencil.system().size(), draw(0, 1000));
    const std::vector<double> first = rates(stencil, state), second = rates(bonds, state);
    double sum = 0.0;
    for (std::size_t k = 0; k < first.size(); ++k) {
      RC_ASSERT(std::abs(first[k] - second[k]) <= 2.0 * stencil.rate_rounding(k, 1.0));
      sum += stencil.capacities[k] * first[k];
    }
    RC_ASSERT(std::abs(sum) <= stencil.heat_rounding(1.0));
    const ConductionOperator& conduction = stencil.system().conduction();
    double capacity = 0.0;
    for (const double own : stencil.capacities) capacity += own;
    RC_ASSERT(std::abs(conduction.heat_capacity() - capacity) <= 1e-12 * capacity);
    RC_ASSERT(std::abs(bonds.system().conduction().heat_capacity() - capacity) <= 1e-12 * capacity);
  });
}

TEST(MirroredCracks, make_no_point_cool_because_another_warms) {
  check_for_every_kernel({6, 1, 1}, [](const BodyRequest& request) {
    Problem problem = draw_mirrored(request);
    const MeasuredBody body = measure(problem, BackendName::stencil);
    for (std::size_t k = 0; k < body.entries.size(); ++k) {
      std::vector<double> found(body.system().size(), 0.0);
      body.system().conduction().visit_bonds(body.entries[k], [&](std::size_t j, double g) { found[j] += g; });
      for (const double g : found) RC_ASSERT(g >= -body.capacities[k] * body.rate_rounding(k, 1.0));
    }
  });
}

/// A plate of one material with one crack inside that is longer than four spacings, and horizons of two at least: with
/// fewer bonds patches of tips are often given up, and whether they are may hang on a rounding.
Problem draw_plate_with_crack(BodyRequest request) {
  request.fewest_cells = 12;
  Problem problem = *random_problem(request);
  RC_PRE(*problem.nonlocality.horizon_ratio >= 2.0);
  problem.body.regions.clear();
  problem.contacts.clear();
  problem.boundaries.clear();
  problem.sources.clear();
  problem.cracks.clear();
  problem.initial.temperature = Profile(1.0);
  Crack& crack = problem.cracks.emplace_back();
  crack.faces = Faces::mirror;
  for (int end = 0; end < 2; ++end) {
    Coordinates& place = crack.points.emplace_back();
    for (std::size_t axis = 0; axis < 2; ++axis) {
      place.push_back((*problem.body.origin)[axis] + problem.body.size[axis] * draw_real(0.2, 0.8));
    }
  }
  const double spacing = problem.body.size[0] / (*problem.body.cells)[0];
  RC_PRE(std::hypot(crack.points[1][0] - crack.points[0][0], crack.points[1][1] - crack.points[0][1]) > 4.0 * spacing);
  return problem;
}

TEST(MirroredCracks, behave_alike_in_a_mirror_and_with_axes_exchanged) {
  check_for_every_kernel({0, 8, 0}, [](const BodyRequest& request) {
    const Problem problem = draw_plate_with_crack(request);
    const MeasuredBody body = measure(problem, BackendName::stencil);
    const MeasuredBody image = measure(mirrored_problem(problem, 0), BackendName::stencil);
    const MeasuredBody turned = measure(with_axes_exchanged(problem, 0, 1), BackendName::stencil);
    std::vector<double> state = random_state(body.system().size(), draw(0, 1000));
    std::vector<double> of_image(image.system().size()), of_turned(turned.system().size());
    const int last = body.assembly.geometry.body.grid.count(0) - 1;
    const PaddedGrid& layout = body.assembly.layout;
    const auto in_image = [&](std::size_t entry) {
      const GridIndex p = layout.index(entry);
      return image.assembly.layout.entry({last - p[0], p[1], 0});
    };
    const auto in_turned = [&](std::size_t entry) {
      const GridIndex p = layout.index(entry);
      return turned.assembly.layout.entry({p[1], p[0], 0});
    };
    for (const std::size_t entry : body.entries) {
      of_image[in_image(entry)] = of_turned[in_turned(entry)] = state[entry];
    }
    std::vector<double> first(state.size()), second(of_image.size()), third(of_turned.size());
    body.system().combine(0.0, state, 1.0, {}, first);
    image.system().combine(0.0, of_image, 1.0, {}, second);
    turned.system().combine(0.0, of_turned, 1.0, {}, third);
    for (std::size_t k = 0; k < body.entries.size(); ++k) {
      const std::size_t entry = body.entries[k];
      // Patches around tips are squares of the grid, whose edges are felt near the tip to 1e-4 of a share.
      RC_ASSERT(std::abs(first[entry] - second[in_image(entry)]) <= 1e-4 * body.rate_scales[k]);
      RC_ASSERT(std::abs(first[entry] - third[in_turned(entry)]) <= 1e-4 * body.rate_scales[k]);
    }
  });
}

/// As above, and the cracks grow, appear, close, or exchange heat between their faces.
Problem draw_changing(const BodyRequest& request) {
  Problem problem = *random_problem(request);
  RC_PRE(!problem.cracks.empty() && problem.nonlocality.scheme == Scheme::peritherm);
  for (Crack& crack : problem.cracks) {
    crack.faces = draw_chance(80) ? Faces::mirror : Faces::cut;
    crack.tip_shift = NoTipShift{};
    if (draw_chance(40)) crack.gap = GapConvection{draw_real(0.01, 100.0)};
    if (draw_chance(40)) crack.contact = ContactAtTimes{{0.2, 0.6}, {draw_real(0.0, 1.0), draw_real(0.0, 1.0)}};
    if (draw_chance(40)) crack.start_time = draw_real(0.0, 1.0);
    const bool may_grow = problem.body.size.size() == 2;
    if (may_grow && draw_chance(40)) crack.tip_speed = 4.0 * make_grid(problem).spacing;
  }
  problem.time.end = 1.0;
  problem.boundaries.clear();
  problem.sources.clear();
  RC_PRE(find_faults(problem).empty());
  return problem;
}

TEST(ChangingCracks, conduct_alike_by_stencil_and_bonds_and_keep_all_heat) {
  check_for_every_kernel({4, 1, 0}, [](const BodyRequest& request) {
    const Problem problem = draw_changing(request);
    const MeasuredBody stencil = measure(problem, BackendName::stencil);
    const MeasuredBody bonds = measure(problem, BackendName::bond);
    std::vector<double> state = random_state(stencil.system().size(), draw(0, 1000));
    for (int look = 0; look < 2; ++look) {
      const double from = draw_real(0.0, 1.0), to = from + draw_real(0.0, 0.5);
      stencil.system().begin_step(from, to);
      bonds.system().begin_step(from, to);
      const std::vector<double> first = rates(stencil, state), second = rates(bonds, state);
      double sum = 0.0;
      for (std::size_t k = 0; k < first.size(); ++k) {
        // Conductances grow up to some tenfold, and their means are sums of up to a hundred changes.
        RC_ASSERT(std::abs(first[k] - second[k]) <= 100.0 * stencil.rate_rounding(k, 1.0));
        sum += stencil.capacities[k] * first[k];
      }
      RC_ASSERT(std::abs(sum) <= 10.0 * stencil.heat_rounding(1.0));
    }
  });
}

TEST(ChangingCracks, never_conduct_less_than_nothing_nor_faster_than_the_bound) {
  check_for_every_kernel({4, 1, 0}, [](const BodyRequest& request) {
    const Problem problem = draw_changing(request);
    const MeasuredBody body = measure(problem, BackendName::stencil);
    const double bound = body.system().conduction().gershgorin_bound();
    for (const double time : {0.0, 0.3, 0.7, 1.0}) {
      body.system().begin_step(time, time);
      for (std::size_t k = 0; k < body.entries.size(); ++k) {
        std::vector<double> found(body.system().size(), 0.0);
        body.system().conduction().visit_bonds(body.entries[k], [&](std::size_t j, double g) { found[j] += g; });
        double sum = 0.0;
        for (const double g : found) {
          RC_ASSERT(g >= -10.0 * body.capacities[k] * body.rate_rounding(k, 1.0));
          sum += g;
        }
        RC_ASSERT(2.0 * sum / body.capacities[k] <= bound * (1.0 + 1e-9));
      }
    }
  });
}

}  // namespace
}  // namespace peritherm
