#include "check_property.hpp"
#include "measured_body.hpp"
#include "peritherm/base/error.hpp"
#include "peritherm/integrators/integrator.hpp"

namespace peritherm {
namespace {

double largest_rate(const MeasuredBody& body, double time, std::vector<double>& state) {
  std::vector<double> rates(state.size(), 0.0);
  body.system().combine(time, state, 1.0, {}, rates);
  double largest = 0.0;
  for (const std::size_t entry : body.entries) largest = std::max(largest, std::abs(rates[entry]));
  return largest;
}

/// Weights of the mean that the error is measured by, C · loss rate, from point to point.
double contrast_of_weights(const MeasuredBody& body) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  for (std::size_t k = 0; k < body.entries.size(); ++k) {
    const double weight = body.capacities[k] * body.rate_scales[k];
    if (weight > 0.0) lowest = std::min(lowest, weight);
    highest = std::max(highest, weight);
  }
  return highest / lowest;
}

TEST(SteadyState, leaves_no_rate_or_says_that_there_is_none) {
  check_for_every_kernel({12, 12, 2}, [](const BodyRequest& wanted) {
    BodyRequest request = wanted;
    request.expressions = false;
    const Problem problem = *random_problem(request);
    const MeasuredBody body = measure(problem, draw_chance(50) ? BackendName::stencil : BackendName::bond);
    RC_PRE(body.system().fastest_rate() > 0.0);
    std::vector<double> state = random_state(body.system().size(), draw(0, 1000));
    const SteadyState options{};
    const auto integrator = make_integrator(options, body.system());
    try {
      integrator->advance(0.0, problem.time.end, state, [](double, ConstField) { return true; });
    } catch (const Error& error) {
      RC_ASSERT(error.fault() == Fault::input);
      RC_TAG("none");
      return;
    }
    const auto [lowest, highest] = body.system().extremes(state);
    const double size = std::max({std::abs(lowest), std::abs(highest), 1.0});
    const auto points = static_cast<double>(body.entries.size());
    // No mode is faster than the fastest rate, and all of the error may sit at the point of least weight.
    const double error = options.relative_tolerance * 2.0 * size * std::sqrt(contrast_of_weights(body) * points);
    const double tolerance = body.system().fastest_rate() * (error + rounding(body.terms(), size));
    RC_ASSERT(largest_rate(body, problem.time.end, state) <= tolerance);
  });
}

}  // namespace
}  // namespace peritherm
