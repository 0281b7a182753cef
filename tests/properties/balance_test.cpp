#include "check_property.hpp"
#include "measured_body.hpp"

namespace peritherm {
namespace {

bool is_not_insulated(const BoundaryCondition& condition) { return !std::holds_alternative<Insulated>(condition); }

/// Small enough to measure every pair of points.
BodyRequest made_small(BodyRequest request) {
  request.fewest_cells = request.dimension == 1 ? 6 : 4;
  request.most_cells = request.dimension == 3 ? 5 : 9;
  return request;
}

TEST(Balance, constants_stay_constant) {
  check_for_every_kernel({16, 12, 2}, [](const BodyRequest& request) {
    Problem problem = *random_problem(request);
    const double constant = draw_real(-300.0, 300.0);
    surround_with(problem, constant);
    for (const BackendName backend : both_backends) {
      const MeasuredBody body = measure(problem, backend);
      std::vector<double> state(body.system().size(), constant);
      const std::vector<double> found = rates(body, state);
      for (std::size_t k = 0; k < found.size(); ++k) {
        RC_ASSERT(std::abs(found[k]) <= body.rate_rounding(k, std::abs(constant)));
      }
    }
  });
}

TEST(Balance, what_one_point_gives_another_is_what_it_gets_back) {
  check_for_every_kernel({16, 8, 2}, [](const BodyRequest& request) {
    Problem problem = *random_problem(made_small(request));
    surround_with(problem, 0.0);
    for (const BackendName backend : both_backends) {
      const MeasuredBody body = measure(problem, backend);
      const auto matrix = conductance_matrix(body);
      for (std::size_t i = 0; i < matrix.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const double tolerance =
              body.capacities[i] * body.rate_rounding(i, 1.0) + body.capacities[j] * body.rate_rounding(j, 1.0);
          RC_ASSERT(std::abs(matrix[i][j] - matrix[j][i]) <= tolerance);
        }
      }
    }
  });
}

TEST(Balance, an_insulated_body_keeps_its_heat) {
  check_for_every_kernel({16, 12, 2}, [](const BodyRequest& request) {
    Problem problem = *random_problem(request);
    remove_boundaries(problem, is_not_insulated);
    problem.sources.clear();
    for (const BackendName backend : both_backends) {
      const MeasuredBody body = measure(problem, backend);
      const double time = problem.time.end * draw_real(0.0, 1.0);
      body.system().begin_step(time, 1.2 * time);
      std::vector<double> state = random_state(body.system().size(), draw(0, 1000));
      RC_ASSERT(std::abs(heat_rate(body, rates(body, state))) <= body.heat_rounding(1.0));
    }
  });
}

/// Area of the points of a face that a boundary covers and that are not cut away [m²].
double area_of(const BoundaryOptions& boundary, const Geometry& geometry) {
  const Grid& grid = geometry.body.grid;
  const int across = axis_of(*boundary.face);
  double area = 0.0;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const GridIndex p = grid.index(n);
    if (p[across] != (is_upper(*boundary.face) ? grid.count(across) - 1 : 0)) continue;
    Point x = grid.position(p);
    x[across] = grid.origin[across] + (is_upper(*boundary.face) ? grid.length(across) : 0.0);
    if (boundary.where && !contains(*boundary.where, x, 1e-9 * grid.spacing)) continue;
    if (geometry.body.material_of[n] == no_material) continue;
    double share = 1.0;
    for (int axis = 0; axis < grid.dimension; ++axis) {
      if (axis == across) continue;
      const bool on_edge = grid.placement == PointPlacement::boundary && (p[axis] == 0 || p[axis] == grid.cells[axis]);
      share *= grid.spacing * (on_edge ? 0.5 : 1.0);
    }
    area += share;
  }
  return area;
}

TEST(Balance, a_flux_brings_in_its_value_times_the_area_of_the_face) {
  check_for_every_kernel({16, 12, 2}, [](BodyRequest request) {
    request.expressions = false;
    Problem problem = *random_problem(request);
    std::erase_if(problem.boundaries, [](const BoundaryOptions& boundary) { return !boundary.face; });
    for (BoundaryOptions& boundary : problem.boundaries) {
      if (is_not_insulated(boundary.condition)) boundary.condition = PrescribedFlux{draw_real(-1.0, 1.0)};
    }
    problem.sources.clear();
    // A face whose points are all cut away has no area, and a flux on it is refused.
    RC_PRE(acts_somewhere(problem));
    for (const BackendName backend : both_backends) {
      const MeasuredBody body = measure(problem, backend);
      double expected = 0.0;
      for (const BoundaryOptions& boundary : problem.boundaries) {
        const auto* flux = std::get_if<PrescribedFlux>(&boundary.condition);
        if (flux != nullptr) {
          expected += std::get<double>(flux->value.value) * area_of(boundary, body.assembly.geometry);
        }
      }
      std::vector<double> state = random_state(body.system().size(), draw(0, 1000));
      RC_ASSERT(std::abs(heat_rate(body, rates(body, state)) - expected) <= body.heat_rounding(1.0));
    }
  });
}

TEST(Balance, differences_of_temperature_only_fade) {
  check_for_every_kernel({16, 12, 2}, [](const BodyRequest& request) {
    Problem problem = *random_problem(request);
    surround_with(problem, 0.0);
    for (const BackendName backend : both_backends) {
      const MeasuredBody body = measure(problem, backend);
      std::vector<double> state = random_state(body.system().size(), draw(0, 1000));
      std::vector<double> found = rates(body, state);
      for (std::size_t k = 0; k < found.size(); ++k) found[k] *= state[body.entries[k]];
      RC_ASSERT(heat_rate(body, found) <= body.heat_rounding(1.0));
    }
  });
}

}  // namespace
}  // namespace peritherm
