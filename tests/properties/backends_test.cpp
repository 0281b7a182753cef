#include <omp.h>

#include "check_property.hpp"
#include "measured_body.hpp"
#include "peritherm/operators/kernels.hpp"

namespace peritherm {
namespace {

struct Pair {
  MeasuredBody stencil, bond;
};

Pair measure_both(const Problem& problem) {
  return {measure(problem, BackendName::stencil), measure(problem, BackendName::bond)};
}

void expect_same_rates(const Pair& pair, std::vector<double> state, double time) {
  std::vector<double> copy = state;
  const std::vector<double> first = rates(pair.stencil, state, time);
  const std::vector<double> second = rates(pair.bond, copy, time);
  RC_ASSERT(pair.stencil.entries == pair.bond.entries);
  const double largest = std::max(1.0, largest_size(state));
  for (std::size_t k = 0; k < first.size(); ++k) {
    // Rows of the stencil hold cancelling terms, so they set the scale of both.
    RC_ASSERT(std::abs(first[k] - second[k]) <= pair.stencil.rate_rounding(k, largest));
  }
}

void expect_same_accounts(const Pair& pair, std::vector<double> state, double time) {
  std::vector<double> copy = state;
  const std::vector<double> first = pair.stencil.system().account_rates(time, state);
  const std::vector<double> second = pair.bond.system().account_rates(time, copy);
  const double tolerance = pair.stencil.heat_rounding(std::max(1.0, largest_size(state)));
  RC_ASSERT(first.size() == second.size());
  for (std::size_t a = 0; a < first.size(); ++a) RC_ASSERT(std::abs(first[a] - second[a]) <= tolerance);
  RC_ASSERT(std::abs(pair.stencil.system().stored_heat(state) - pair.bond.system().stored_heat(state)) <=
            rounding(state.size(),
                     pair.stencil.system().stored_heat(std::vector<double>(state.size(), 1.0)) * largest_size(state)));
  const auto [lowest, highest] = pair.stencil.system().extremes(state);
  const auto expected = pair.bond.system().extremes(copy);
  RC_ASSERT(lowest == expected.lowest && highest == expected.highest);
}

void expect_same_fluxes(const Pair& pair, std::vector<double> state) {
  pair.stencil.system().fill(0.0, state);
  const std::vector<Point> first = heat_flux(pair.stencil.assembly, state);
  const std::vector<Point> second = heat_flux(pair.bond.assembly, state);
  const Geometry& geometry = pair.stencil.assembly.geometry;
  const double reach = geometry.stencil.radius * geometry.body.grid.spacing * geometry.stencil.radius;
  const double largest = std::max(1.0, largest_size(state));
  for (std::size_t k = 0; k < pair.stencil.entries.size(); ++k) {
    const GridIndex p = pair.stencil.assembly.layout.index(pair.stencil.entries[k]);
    const std::size_t n = geometry.body.grid.number(p);
    const double volume = geometry.body.grid.cell_volume() * geometry.body.grid.volume_share(p);
    const double scale = pair.stencil.capacities[k] / volume * reach;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      RC_ASSERT(std::abs(first[n][axis] - second[n][axis]) <= scale * pair.stencil.rate_rounding(k, largest));
    }
  }
  for (std::size_t n = 0; n < first.size(); ++n) RC_ASSERT(std::isnan(first[n][0]) == std::isnan(second[n][0]));
}

TEST(Backends, the_stencil_and_the_bonds_give_the_same_rates_fluxes_and_accounts) {
  check_for_every_kernel({16, 12, 2}, [](const BodyRequest& request) {
    const Problem problem = *random_problem(request);
    const Pair pair = measure_both(problem);
    const std::vector<double> state = random_state(pair.stencil.system().size(), draw(0, 1000));
    expect_same_rates(pair, state, 0.0);
    expect_same_accounts(pair, state, 0.0);
    expect_same_fluxes(pair, state);
  });
}

TEST(Backends, agree_over_any_steps_while_cracks_grow) {
  check_for_every_kernel({16, 12, 2}, [](const BodyRequest& request) {
    const Problem problem = *random_problem(request);
    const Pair pair = measure_both(problem);
    const std::vector<double> state = random_state(pair.stencil.system().size(), draw(0, 1000));
    for (int step = 0; step < 6; ++step) {
      const double from = problem.time.end * draw_real(0.0, 1.0);
      const double to = from + (draw_chance(20) ? 0.0 : problem.time.end * draw_real(0.0, 0.3));
      const bool changed = pair.stencil.system().begin_step(from, to);
      RC_ASSERT(pair.bond.system().begin_step(from, to) == changed);
      expect_same_rates(pair, state, from);
      expect_same_accounts(pair, state, from);
    }
  });
}

TEST(Backends, every_instruction_set_gives_the_same_rates) {
  check_for_every_kernel({16, 8, 2}, [](const BodyRequest& request) {
    const Problem problem = *random_problem(request);
    const MeasuredBody body = measure(problem, BackendName::bond);
    const Geometry& geometry = body.assembly.geometry;
    std::vector<double> state = random_state(body.system().size(), draw(0, 1000));
    body.system().fill(0.0, state);
    const ConstField field = ConstField(state).first(body.assembly.layout.size());
    std::vector<double> expected(state.size(), 0.0), result(state.size(), 0.0);
    const MeasuredBody stencil = measure(problem, BackendName::stencil);
    body.system().conduction().combine(field, 1.0, {}, Field(expected).first(field.size()));
    for (std::size_t kernel = 0; kernel < available_kernels().size(); ++kernel) {
      const auto conduction =
          make_stencil_operator(geometry.body, body.assembly.layout, geometry.stencil, geometry.held_by, kernel);
      conduction->average_over(0.0, 0.0);
      conduction->combine(field, 1.0, {}, Field(result).first(field.size()));
      for (std::size_t k = 0; k < body.entries.size(); ++k) {
        const std::size_t entry = body.entries[k];
        RC_ASSERT(std::abs(result[entry] - expected[entry]) <=
                  stencil.rate_rounding(k, std::max(1.0, largest_size(state))));
      }
    }
  });
}

TEST(Backends, the_stencil_gives_the_same_bits_for_any_number_of_threads) {
  const int threads_before = omp_get_max_threads();
  check_for_every_kernel({1, 1, 1}, [](BodyRequest request) {
    request.fewest_cells = request.dimension == 1 ? 9000 : 25;
    request.most_cells = request.dimension == 1 ? 9001 : 30;
    Problem problem = *random_problem(request);
    problem.time.integrator = RungeKuttaLegendre{};
    std::vector<double> first;
    for (const int threads : {1, 2, 3}) {
      omp_set_num_threads(threads);
      Problem run = problem;
      run.numerics.backend = BackendName::stencil;
      const Assembly assembly = assemble(run);
      RC_PRE(assembly.system->conduction().free_points() > 0);
      std::vector<double> state = initial_state(run, assembly);
      const auto integrator = make_integrator(run.time.integrator, *assembly.system);
      int steps = 0;
      integrator->advance(0.0, 0.2 * run.time.end, state, [&steps](double, ConstField) { return ++steps < 2; });
      if (threads == 1) first = state;
      RC_ASSERT(state == first);
    }
  });
  omp_set_num_threads(threads_before);
}

}  // namespace
}  // namespace peritherm
