#include <functional>

#include "check_property.hpp"
#include "measured_body.hpp"
#include "moved_problem.hpp"

namespace peritherm {
namespace {

/// Geometric comparisons have a slack of 1e-9 spacings, so shares of cells may differ by that much.
constexpr double geometric_slack = 1e-9;

/// The rate of point p of `first` must be that of point image(p) of `second`, `factor` times.
void expect_same_rates(const MeasuredBody& first, const MeasuredBody& second, double factor,
                       const std::function<GridIndex(GridIndex)>& image) {
  std::vector<double> state = random_state(first.system().size(), draw(0, 1000));
  std::vector<double> other(second.system().size(), 0.0);
  RC_ASSERT(first.entries.size() == second.entries.size());
  const PaddedGrid& from = first.assembly.layout;
  const PaddedGrid& to = second.assembly.layout;
  for (const std::size_t entry : first.entries) other[to.entry(image(from.index(entry)))] = state[entry];
  const std::vector<double> found = rates(first, state);
  std::vector<double> moved(other.size(), 0.0);
  second.system().combine(0.0, other, 1.0, {}, moved);
  const double largest = std::max(1.0, largest_size(state));
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double expected = factor * moved[to.entry(image(from.index(first.entries[k])))];
    // Sources heat points, too.
    RC_ASSERT(std::abs(found[k] - expected) <= geometric_slack * (first.rate_scales[k] * largest + std::abs(found[k])));
  }
}

GridIndex same(GridIndex p) { return p; }

TEST(Invariance, moving_a_body_changes_nothing) {
  check_for_every_kernel({16, 8, 2}, [](BodyRequest request) {
    request.expressions = false;
    request.mirrors = false;
    const Problem problem = *random_problem(request);
    const double far = 3.0 * problem.body.size[0];
    const Point shift{far * draw_real(-1.0, 1.0), far * draw_real(-1.0, 1.0), far * draw_real(-1.0, 1.0)};
    const Problem moved = moved_problem(problem, [&shift](Coordinates place) {
      for (std::size_t axis = 0; axis < place.size(); ++axis) place[axis] += shift[axis];
      return place;
    });
    for (const BackendName backend : both_backends) {
      expect_same_rates(measure(problem, backend), measure(moved, backend), 1.0, same);
    }
  });
}

TEST(Invariance, changing_units_changes_nothing) {
  check_for_every_kernel({16, 8, 2}, [](BodyRequest request) {
    request.expressions = false;
    request.mirrors = false;
    const Problem problem = *random_problem(request);
    const double lengths[] = {1e-6, 1e3, 0.0254};
    const Units units{lengths[draw(0, 2)], draw_real(0.01, 100.0), draw_real(0.01, 100.0)};
    const Problem scaled = in_units(problem, units);
    const double start = problem.time.end * draw_real(0.0, 0.9);
    const double end = start + 0.1 * problem.time.end;
    for (const BackendName backend : both_backends) {
      const MeasuredBody first = measure(problem, backend);
      const MeasuredBody second = measure(scaled, backend);
      first.system().begin_step(start, end);
      second.system().begin_step(start * units.time(), end * units.time());
      expect_same_rates(first, second, units.time(), same);
    }
  });
}

/// Without what tells the axes or directions apart: where two held faces meet, the later axis decides.
Problem draw_even_problem(BodyRequest request) {
  request.expressions = false;
  request.mirrors = false;
  request.ties = false;
  Problem problem = *random_problem(request);
  surround_with(problem, 0.5);
  for (BoundaryOptions& boundary : problem.boundaries) {
    if (auto* flux = std::get_if<PrescribedFlux>(&boundary.condition)) flux->value = 0.3;
  }
  return problem;
}

TEST(Invariance, a_mirror_image_behaves_alike) {
  check_for_every_kernel({16, 8, 2}, [](const BodyRequest& request) {
    const Problem problem = draw_even_problem(request);
    const int axis = draw(0, request.dimension - 1);
    const Problem mirrored = mirrored_problem(problem, axis);
    for (const BackendName backend : both_backends) {
      const MeasuredBody first = measure(problem, backend);
      const int last = first.assembly.geometry.body.grid.count(axis) - 1;
      expect_same_rates(first, measure(mirrored, backend), 1.0, [axis, last](GridIndex p) {
        p[static_cast<std::size_t>(axis)] = last - p[static_cast<std::size_t>(axis)];
        return p;
      });
    }
  });
}

TEST(Invariance, exchanging_two_axes_changes_nothing) {
  check_for_every_kernel({0, 8, 2}, [](const BodyRequest& request) {
    const Problem problem = draw_even_problem(request);
    const bool has_polygons = std::any_of(problem.body.regions.begin(), problem.body.regions.end(),
                                          [](const auto& r) { return std::holds_alternative<Polygon>(r.shape); }) ||
                              std::any_of(problem.boundaries.begin(), problem.boundaries.end(), [](const auto& b) {
                                return b.where && std::holds_alternative<Polygon>(*b.where);
                              });
    // Polygons are prisms along z.
    const int second = has_polygons ? 1 : request.dimension - 1;
    const Problem exchanged = with_axes_exchanged(problem, 0, second);
    for (const BackendName backend : both_backends) {
      expect_same_rates(measure(problem, backend), measure(exchanged, backend), 1.0, [second](GridIndex p) {
        std::swap(p[0], p[static_cast<std::size_t>(second)]);
        return p;
      });
    }
  });
}

}  // namespace
}  // namespace peritherm
