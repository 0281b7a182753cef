#include "check_property.hpp"
#include "measured_body.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm {
namespace {

/// Runs a few steps; what is stored must have come in through the accounts.
void expect_balance(const Problem& problem, BackendName backend, const TimeStepping& stepping) {
  const MeasuredBody body = measure(problem, backend);
  RC_PRE(body.system().fastest_rate() > 0.0);
  std::vector<double> state = initial_state(problem, body.assembly);
  const double before = body.system().stored_heat(state);
  const auto integrator = make_integrator(stepping, body.system());
  double largest = largest_size(state), longest = 0.0, time_before = 0.0;
  int steps = 0;
  integrator->advance(0.0, problem.time.end, state, [&](double time, ConstField temperature) {
    longest = std::max(longest, time - time_before);
    time_before = time;
    largest = std::max(largest, largest_size(temperature.first(body.assembly.layout.size())));
    return ++steps < 8;
  });
  double heats = 0.0;
  for (const double heat : body.system().account_heats(state)) heats += heat;
  double capacity = 0.0;
  for (const double value : body.capacities) capacity += value;
  // Every evaluation may lose the rounding of its terms, and every stage that of what is stored.
  const auto evaluations = static_cast<double>(integrator->count().evaluations);
  const double tolerance =
      evaluations * (longest * body.heat_rounding(largest) + rounding(body.entries.size(), capacity * largest));
  RC_ASSERT(std::abs(body.system().stored_heat(state) - before - heats) <= tolerance);
}

TEST(Energy, what_is_stored_has_come_in_through_the_boundaries_and_sources) {
  check_for_every_kernel({16, 12, 2}, [](const BodyRequest& request) {
    const Problem problem = *random_problem(request);
    const TimeStepping steppings[] = {RungeKuttaLegendre{1e-4}, RungeKutta4{}, ForwardEuler{}};
    const BackendName backend = draw_chance(50) ? BackendName::stencil : BackendName::bond;
    for (const TimeStepping& stepping : steppings) expect_balance(problem, backend, stepping);
  });
}

TEST(Energy, a_body_of_one_temperature_rests_under_every_integrator) {
  check_for_every_kernel({8, 6, 1}, [](const BodyRequest& request) {
    Problem problem = *random_problem(request);
    const double constant = draw_real(-300.0, 300.0);
    surround_with(problem, constant);
    problem.initial.temperature = constant;
    const TimeStepping steppings[] = {RungeKuttaLegendre{}, RungeKutta4{}, ForwardEuler{}};
    for (const TimeStepping& stepping : steppings) {
      const MeasuredBody body = measure(problem, BackendName::stencil);
      RC_PRE(body.system().fastest_rate() > 0.0);
      std::vector<double> state = initial_state(problem, body.assembly);
      const auto integrator = make_integrator(stepping, body.system());
      int steps = 0;
      const auto stop_early = [&steps](double, ConstField) { return ++steps < 8; };
      const double end = integrator->advance(0.0, problem.time.end, state, stop_early);
      // Rounding of the rates adds up over the time; that of the combinations over the evaluations.
      const auto evaluations = static_cast<std::size_t>(integrator->count().evaluations);
      for (std::size_t k = 0; k < body.entries.size(); ++k) {
        const double tolerance =
            end * body.rate_rounding(k, std::abs(constant)) + rounding(evaluations, std::abs(constant));
        RC_ASSERT(std::abs(state[body.entries[k]] - constant) <= tolerance);
      }
    }
  });
}

}  // namespace
}  // namespace peritherm
