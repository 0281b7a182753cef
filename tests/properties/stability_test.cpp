#include "check_property.hpp"
#include "measured_body.hpp"

namespace peritherm {
namespace {

/// An odd mirror image may take more from a point than the point itself gives: where a crack, a void or another
/// material weakens the direct bond only, and where two held faces meet. Elsewhere extremes are kept.
void replace_odd_mirrors(Problem& problem) {
  for (BoundaryOptions& boundary : problem.boundaries) {
    auto* held = std::get_if<HeldTemperature>(&boundary.condition);
    if (held != nullptr && boundary.face && held->imposed == Imposed::mirror) held->imposed = Imposed::constant;
  }
}

void remove_heating(Problem& problem) {
  problem.sources.clear();
  remove_boundaries(problem, [](const BoundaryCondition& c) { return std::holds_alternative<PrescribedFlux>(c); });
}

/// A plain body with one face held by an odd mirror.
void make_plain(Problem& problem) {
  problem.body.regions.clear();
  problem.contacts.clear();
  problem.cracks.clear();
  problem.boundaries = {{Face::x_max, std::nullopt, HeldTemperature{draw_real(-1.0, 1.0), Imposed::mirror, {}}}};
}

double largest_loss(const MeasuredBody& body) {
  double largest = 0.0;
  std::vector<double> state(body.system().size(), 0.0);
  for (const std::size_t entry : body.entries) {
    state[entry] = 1.0;
    std::vector<double> found(state.size(), 0.0), at_zero(state.size(), 0.0);
    body.system().combine(0.0, state, 1.0, {}, found);
    state[entry] = 0.0;
    body.system().combine(0.0, state, 1.0, {}, at_zero);
    largest = std::max(largest, at_zero[entry] - found[entry]);
  }
  return largest;
}

void expect_extremes_kept(const MeasuredBody& body) {
  const double loss = largest_loss(body);
  // Cracks and voids may have cut every bond.
  if (loss <= rounding(body.terms(), largest_size(body.rate_scales))) return;
  // At this step the own share of the fastest point reaches 0 and every other share is still positive.
  const double step = 1.0 / loss;
  std::vector<double> state = random_state(body.system().size(), draw(0, 1000));
  body.system().fill(0.0, state);
  const auto [lowest, highest] = body.system().extremes(state);
  for (int n = 1; n <= 20; ++n) {
    const std::vector<double> found = rates(body, state);
    for (std::size_t k = 0; k < found.size(); ++k) {
      state[body.entries[k]] += step * found[k];
      const double slack = n * rounding(body.terms(), step * body.rate_scales[k] + 1.0);
      RC_ASSERT(state[body.entries[k]] >= lowest - slack);
      RC_ASSERT(state[body.entries[k]] <= highest + slack);
    }
  }
}

TEST(Stability, short_steps_keep_temperatures_between_their_extremes) {
  check_for_every_kernel({16, 12, 2}, [](BodyRequest request) {
    request.expressions = false;
    request.fewest_cells = 4;
    request.most_cells = request.dimension == 3 ? 5 : 9;
    Problem problem = *random_problem(request);
    remove_heating(problem);
    if (draw_chance(30)) {
      make_plain(problem);
    } else {
      replace_odd_mirrors(problem);
    }
    for (const BackendName backend : both_backends) expect_extremes_kept(measure(problem, backend));
  });
}

TEST(Stability, no_point_cools_because_another_warms) {
  check_for_every_kernel({8, 6, 2}, [](BodyRequest request) {
    request.fewest_cells = 4;
    request.most_cells = request.dimension == 3 ? 5 : 9;
    Problem problem = *random_problem(request);
    surround_with(problem, 0.0);
    replace_odd_mirrors(problem);
    const MeasuredBody body = measure(problem, BackendName::stencil);
    const auto matrix = conductance_matrix(body);
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      for (std::size_t j = 0; j < matrix.size(); ++j) {
        if (i != j) RC_ASSERT(matrix[i][j] >= -body.capacities[i] * body.rate_rounding(i, 1.0));
      }
    }
  });
}

/// A lower bound of the fastest rate by power iteration, −⟨T, C dT/dt⟩ / ⟨T, C T⟩.
double rayleigh_quotient(const MeasuredBody& body, int iterations) {
  std::vector<double> state = random_state(body.system().size(), 1);
  double quotient = 0.0;
  for (int n = 0; n < iterations; ++n) {
    const std::vector<double> found = rates(body, state);
    double above = 0.0, below = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double value = state[body.entries[k]];
      above -= body.capacities[k] * value * found[k];
      below += body.capacities[k] * value * value;
    }
    quotient = below > 0.0 ? above / below : 0.0;
    const double size = largest_size(found);
    if (size == 0.0) return quotient;
    for (std::size_t k = 0; k < found.size(); ++k) state[body.entries[k]] = found[k] / size;
  }
  return quotient;
}

TEST(Stability, nothing_decays_faster_than_the_fastest_rate) {
  check_for_every_kernel({16, 12, 2}, [](const BodyRequest& request) {
    Problem problem = *random_problem(request);
    surround_with(problem, 0.0);
    for (const BackendName backend : both_backends) {
      const MeasuredBody body = measure(problem, backend);
      const double rate = body.system().fastest_rate();
      RC_ASSERT(rayleigh_quotient(body, 100) <= rate * (1.0 + rounding(body.entries.size(), 1.0)));
    }
  });
}

/// Largest Σ G (1 − cos k·ξ) over a mesh of wave vectors from 0 to π along each axis.
double largest_symbol_found(const Stencil& stencil, int dimension) {
  const int steps = dimension == 3 ? 40 : 200;
  const auto cosine = [steps](int step, int offset) { return std::cos(std::numbers::pi * step * offset / steps); };
  double largest = 0.0;
  for (int z = 0; z <= (dimension > 2 ? steps : 0); ++z) {
    for (int y = 0; y <= (dimension > 1 ? steps : 0); ++y) {
      for (int x = 0; x <= steps; ++x) {
        double sum = 0.0;
        // The stencil is even along every axis, so the cosine of the sum is the product of cosines.
        for (const auto& [o, g] : stencil.entries) {
          if (o[0] < 0 || o[1] < 0 || o[2] < 0) continue;
          const int images = (o[0] > 0 ? 2 : 1) * (o[1] > 0 ? 2 : 1) * (o[2] > 0 ? 2 : 1);
          sum += images * g * (1.0 - cosine(x, o[0]) * cosine(y, o[1]) * cosine(z, o[2]));
        }
        largest = std::max(largest, sum);
      }
    }
  }
  return largest;
}

TEST(Stability, the_fastest_rate_of_a_plain_body_is_that_of_the_fastest_wave) {
  check_for_every_kernel({8, 6, 2}, [](BodyRequest request) {
    request.most_cells = 6;
    Problem problem = *random_problem(request);
    make_plain(problem);
    problem.boundaries.clear();
    const Assembly assembly = assemble(problem);
    const Material& material = problem.materials.at("first");
    const double wave = material.conductivity * largest_symbol_found(assembly.geometry.stencil, request.dimension) /
                        (volumetric_heat_capacity(material) * assembly.geometry.body.grid.cell_volume());
    // The mesh of waves misses the peak by half a step at most, which costs less than 1 % for these horizons.
    RC_ASSERT(assembly.system->fastest_rate() >= wave * (1.0 - rounding(1000, 1.0)));
    RC_ASSERT(assembly.system->fastest_rate() <= 1.01 * wave);
  });
}

}  // namespace
}  // namespace peritherm
