#include <map>

#include "check_property.hpp"
#include "measured_body.hpp"

namespace peritherm {
namespace {

/// A displacement that bends, shears and stretches, more and more, until bonds here and there are too long.
void tear(Problem& problem) {
  const auto dimension = problem.body.size.size();
  DamageOptions& damage = problem.damage.emplace();
  damage.critical_elongation = draw_real(0.005, 0.3);
  damage.transmission = draw_chance(50) ? 0.0 : draw_real(0.0, 1.0);
  damage.every = problem.time.end * draw_real(0.1, 0.6);
  damage.displacement.emplace();
  const double length = problem.body.size.front();
  for (std::size_t c = 0; c < dimension; ++c) {
    const double strain = damage.critical_elongation * draw_real(0.0, 3.0);
    const double waves = draw_real(0.5, 4.0) / length;
    damage.displacement->emplace_back(std::to_string(strain * length) + "*t/" + std::to_string(problem.time.end) +
                                      "*sin(" + std::to_string(waves) + "*(x + 2*y - z))");
  }
}

std::size_t count_broken(const MeasuredBody& body) { return body.assembly.geometry.body.broken.size(); }

TEST(BrokenBonds, backends_agree_over_any_steps_while_bonds_break) {
  check_for_every_kernel({6, 5, 1}, [](const BodyRequest& request) {
    Problem problem = *random_problem(request);
    tear(problem);
    const MeasuredBody stencil = measure(problem, BackendName::stencil), bond = measure(problem, BackendName::bond);
    RC_ASSERT(count_broken(stencil) == count_broken(bond));
    std::vector<double> state = random_state(stencil.system().size(), draw(0, 1000));
    const double largest = std::max(1.0, largest_size(state));
    for (int step = 0; step < 4; ++step) {
      const double from = problem.time.end * draw_real(0.0, 1.0);
      const double to = from + (draw_chance(20) ? 0.0 : problem.time.end * draw_real(0.0, 0.3));
      const bool changed = stencil.system().begin_step(from, to);
      RC_ASSERT(bond.system().begin_step(from, to) == changed);
      std::vector<double> copy = state;
      const std::vector<double> first = rates(stencil, state, from), second = rates(bond, copy, from);
      for (std::size_t k = 0; k < first.size(); ++k) {
        RC_ASSERT(std::abs(first[k] - second[k]) <= stencil.rate_rounding(k, largest));
      }
    }
  });
}

TEST(BrokenBonds, insulated_bodies_keep_their_heat_while_bonds_break) {
  check_for_every_kernel({4, 3, 1}, [](const BodyRequest& request) {
    Problem problem = *random_problem(request);
    problem.sources.clear();
    remove_boundaries(problem, [](const auto& condition) { return !std::holds_alternative<Insulated>(condition); });
    tear(problem);
    for (const BackendName backend : both_backends) {
      const MeasuredBody body = measure(problem, backend);
      std::vector<double> state = random_state(body.system().size(), draw(0, 1000));
      for (const double share : {0.2, 0.5, 1.0}) {
        body.system().begin_step(0.0, share * problem.time.end);
        RC_ASSERT(std::abs(heat_rate(body, rates(body, state))) <= body.heat_rounding(1.0));
      }
    }
  });
}

/// Conductances to each place of the padded grid [W/K].
std::map<std::pair<std::size_t, std::size_t>, double> all_conductances(const MeasuredBody& body) {
  std::map<std::pair<std::size_t, std::size_t>, double> found;
  for (const std::size_t entry : body.entries) {
    body.system().conduction().visit_bonds(entry, [&](std::size_t j, double g) { found[{entry, j}] += g; });
  }
  return found;
}

/// A crack through the whole body, at right angles to an axis, between rows two or more points away from its faces.
Crack through_crack(const Problem& problem, std::size_t axis, double at) {
  const std::size_t dimension = problem.body.size.size();
  const double far = 10.0 * (problem.body.size.front() + std::abs((*problem.body.origin)[0]) + 1.0);
  Crack crack;
  if (dimension == 1) crack.points = {{at}};
  if (dimension == 2) crack.points = {{-far, -far}, {far, far}};
  if (dimension == 3) {
    crack.points = {{-far, -far, -far}, {far, far, -far}, {far, far, far}, {-far, -far, far}};
    const std::size_t first = (axis + 1) % 3, second = (axis + 2) % 3;
    const double signs[4][2] = {{-far, -far}, {far, -far}, {far, far}, {-far, far}};
    for (std::size_t k = 0; k < 4; ++k) {
      crack.points[k][first] = signs[k][0];
      crack.points[k][second] = signs[k][1];
    }
  }
  for (Coordinates& corner : crack.points) corner[axis] = at;
  return crack;
}

TEST(BrokenBonds, a_body_torn_in_two_conducts_like_one_with_a_crack_through_it) {
  check_for_every_kernel({6, 5, 1}, [](BodyRequest request) {
    request.ties = false;
    Problem problem = *random_problem(request);
    problem.cracks.clear();
    problem.body.regions.clear();
    problem.contacts.clear();
    // A shape may have acted on the surface of a part that is no longer cut away.
    std::erase_if(problem.boundaries, [](const BoundaryOptions& boundary) { return !boundary.face; });
    const std::size_t axis = static_cast<std::size_t>(draw(0, request.dimension - 1));
    const int cells = (*problem.body.cells)[axis];
    RC_PRE(cells >= 5 && find_faults(problem).empty());
    const double spacing = problem.body.size[0] / (*problem.body.cells)[0];
    const double row = draw(2, cells - 3) + (problem.body.points == PointPlacement::boundary ? 0.5 : 1.0);
    const double at = (*problem.body.origin)[axis] + row * spacing;
    Problem cracked = problem, torn = problem;
    cracked.cracks.push_back(through_crack(problem, axis, at));
    cracked.cracks.back().faces = Faces::cut;
    DamageOptions& damage = torn.damage.emplace();
    damage.critical_elongation = 0.5;
    damage.displacement.emplace(static_cast<std::size_t>(request.dimension), Profile(0.0));
    for (Profile& component : *damage.displacement) {
      component = Profile(std::to_string(50.0 * spacing) + "*(" + std::string(1, "xyz"[axis]) + " > " +
                          std::to_string(at) + ")");
    }
    for (const BackendName backend : both_backends) {
      const auto expected = all_conductances(measure(cracked, backend));
      auto found = all_conductances(measure(torn, backend));
      double largest = 0.0;
      for (const auto& [bond, g] : expected) largest = std::max(largest, g);
      for (const auto& [bond, g] : expected) RC_ASSERT(std::abs(found[bond] - g) <= rounding(8, largest));
    }
  });
}

}  // namespace
}  // namespace peritherm
