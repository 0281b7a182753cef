#include "check_property.hpp"
#include "measured_body.hpp"
#include "moved_problem.hpp"

namespace peritherm {
namespace {

/// Does the crack stay on its side of the plane that the body will be mirrored about?
bool stays_inside(const Crack& crack, double wall) {
  return !crack.disc && std::all_of(crack.points.begin(), crack.points.end(),
                                    [wall](const Coordinates& point) { return point[0] > wall; });
}

/// A body whose face x_min carries `wall`, and which can be mirrored about it.
Problem draw_half(BodyRequest request, const BoundaryCondition& wall) {
  request.expressions = false;
  request.mirrors = false;
  request.ties = false;
  request.contained = true;
  Problem problem = *random_problem(request);
  // What covers only a part of a face or of the body may touch its own mirror image.
  std::erase_if(problem.boundaries, [](const BoundaryOptions& boundary) {
    return boundary.where || !boundary.face || *boundary.face == Face::x_min;
  });
  problem.boundaries.push_back({Face::x_min, std::nullopt, wall});
  std::erase_if(problem.cracks, [&](const Crack& crack) { return !stays_inside(crack, (*problem.body.origin)[0]); });
  return problem;
}

/// The half and its mirror image beyond x_min.
Problem doubled(const Problem& half) {
  Problem whole = half;
  const double wall = (*half.body.origin)[0];
  const auto mirror = [wall](Coordinates place) {
    place[0] = 2.0 * wall - place[0];
    return place;
  };
  const Problem image = with_contents_moved(half, mirror);
  whole.body.regions.clear();
  for (std::size_t k = 0; k < half.body.regions.size(); ++k) {
    whole.body.regions.push_back(half.body.regions[k]);
    whole.body.regions.push_back(image.body.regions[k]);
  }
  whole.cracks.insert(whole.cracks.end(), image.cracks.begin(), image.cracks.end());
  (*whole.body.origin)[0] -= half.body.size[0];
  whole.body.size[0] *= 2.0;
  (*whole.body.cells)[0] *= 2;
  std::erase_if(whole.boundaries, [](const BoundaryOptions& boundary) { return boundary.face == Face::x_min; });
  std::vector<BoundaryOptions> images;
  for (const BoundaryOptions& boundary : whole.boundaries) {
    if (boundary.face == Face::x_max) images.push_back({Face::x_min, std::nullopt, boundary.condition});
  }
  whole.boundaries.insert(whole.boundaries.end(), images.begin(), images.end());
  return whole;
}

/// `sign` of the temperatures on the far side.
void expect_half_of_double(const Problem& problem, BackendName backend, double sign) {
  const MeasuredBody half = measure(problem, backend);
  const MeasuredBody whole = measure(doubled(problem), backend);
  const int cells = (*problem.body.cells)[0];
  const int shift = problem.body.points == PointPlacement::boundary ? 0 : 1;
  std::vector<double> state = random_state(half.system().size(), draw(0, 1000));
  std::vector<double> other(whole.system().size(), 0.0);
  const auto near_side = [&](GridIndex p) { return whole.assembly.layout.entry({p[0] + cells, p[1], p[2]}); };
  for (const std::size_t entry : half.entries) {
    const GridIndex p = half.assembly.layout.index(entry);
    other[whole.assembly.layout.entry({cells - p[0] - shift, p[1], p[2]})] = sign * state[entry];
    other[near_side(p)] = state[entry];
  }
  const std::vector<double> found = rates(half, state);
  std::vector<double> expected(other.size(), 0.0);
  whole.system().combine(0.0, other, 1.0, {}, expected);
  const double largest = std::max(1.0, largest_size(state));
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double difference = found[k] - expected[near_side(half.assembly.layout.index(half.entries[k]))];
    // Geometric comparisons have a slack of 1e-9 spacings, so shares of cells may differ by that much.
    RC_ASSERT(std::abs(difference) <= 1e-9 * (half.rate_scales[k] * largest + std::abs(found[k])));
  }
}

TEST(Mirrors, an_insulated_face_is_the_middle_of_a_body_twice_as_long) {
  check_for_every_kernel({16, 8, 2}, [](const BodyRequest& request) {
    const Problem problem = draw_half(request, Insulated{});
    for (const BackendName backend : both_backends) expect_half_of_double(problem, backend, 1.0);
  });
}

TEST(Mirrors, a_face_held_at_zero_is_the_middle_of_a_body_with_opposite_halves) {
  check_for_every_kernel({16, 8, 2}, [](const BodyRequest& request) {
    Problem problem = draw_half(request, HeldTemperature{});
    surround_with(problem, 0.0);
    for (const BackendName backend : both_backends) expect_half_of_double(problem, backend, -1.0);
  });
}

}  // namespace
}  // namespace peritherm
