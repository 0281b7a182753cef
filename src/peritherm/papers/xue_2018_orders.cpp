#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "peritherm/papers/paper_chart.hpp"
#include "peritherm/papers/xue_2018_cases.hpp"
#include "peritherm/papers/xue_2018_sections.hpp"
#include "peritherm/simulation/two_field_assembly.hpp"
#include "peritherm/two_field/two_field_gs4.hpp"

namespace peritherm {
namespace {

constexpr double order_end_2018 = 0.2;
constexpr int order_reference_2018 = 64;  ///< times as many steps

struct Member2018 {
  double rho, rho_rate;
};
constexpr std::array<Member2018, 6> members_2018{{{1, 1}, {1, 0.5}, {1, 0}, {0.5, 0.5}, {0.5, 0}, {0, 0}}};

/// The state of a driven slab at the end, and the rate as the family keeps it.
struct Marched2018 {
  TwoFieldState state;
  std::vector<double> raw_rate;
  double residual = 0.0;
};

/// A level below cases, because files do not hold rates.
Marched2018 march_steps_2018(const LayersOf2018& layers, const Member2018& member, int steps) {
  Problem problem = problem_of_2018({layers, 24, 3.0, 1.0, 1});
  drive(problem, ramp_of(layers));
  step_by(problem, order_end_2018 / steps, member.rho, member.rho_rate, SingleStepStart::consistent);
  const TwoFieldAssembly assembly = assemble_two_field(problem);
  Marched2018 result{initial_state(problem, assembly), {}};
  make_consistent(*assembly.system, 0.0, result.state);
  TwoFieldGs4 integrator(std::get<GeneralisedSingleStep>(problem.time.integrator), *assembly.system);
  integrator.march(0.0, std::array{order_end_2018}, result.state, {});
  result.raw_rate = integrator.raw_rate().temperature;
  result.residual = integrator.count().largest_residual;
  return result;
}

double largest_change_2018(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Largest errors of temperature, flux, multipliers, corrected and raw rate.
std::array<double, 5> step_errors_2018(const Marched2018& found, const Marched2018& reference) {
  const auto& a = found.state;
  const auto& b = reference.state;
  return {largest_change_2018(a.temperature, b.temperature),
          a.flux.empty() ? 0.0 : largest_change_2018(a.flux[0], b.flux[0]),
          largest_change_2018(a.multipliers, b.multipliers),
          largest_change_2018(a.temperature_rate, b.temperature_rate),
          largest_change_2018(found.raw_rate, b.temperature_rate)};
}

const std::array<std::string_view, 5> rated_2018{"T", "q", "λ", "dT/dt corrected", "dT/dt raw"};

struct OrderSeries2018 {
  std::string name;
  Member2018 member;
  std::array<double, 5> coarse{}, fine{};
  double residual = 0.0;
};

std::vector<OrderSeries2018> order_series_2018(PaperRuns& runs, int steps) {
  std::vector<OrderSeries2018> series;
  for (const LayersOf2018& layers : layers_of_2018()) {
    for (const Member2018& member : members_2018) series.push_back({layers.name, member});
  }
  std::vector<std::function<void()>> tasks;
  for (std::size_t c = 0; c < layers_of_2018().size(); ++c) {
    tasks.emplace_back([c, steps, &series] {
      const LayersOf2018& layers = layers_of_2018()[c];
      const Marched2018 reference = march_steps_2018(layers, {1, 1}, order_reference_2018 * steps);
      for (std::size_t m = 0; m < members_2018.size(); ++m) {
        OrderSeries2018& one = series[c * members_2018.size() + m];
        const Marched2018 fine = march_steps_2018(layers, one.member, 2 * steps);
        one.coarse = step_errors_2018(march_steps_2018(layers, one.member, steps), reference);
        one.fine = step_errors_2018(fine, reference);
        one.residual = fine.residual;
      }
    });
  }
  runs.carry_out(tasks);
  return series;
}

ReportTable order_table_2018(const std::vector<OrderSeries2018>& series) {
  ReportTable table{"Orders in the step, 24 points per layer, errors against a march of far more steps", {}};
  for (const OrderSeries2018& one : series) {
    for (std::size_t k = 0; k < rated_2018.size(); ++k) {
      if (one.coarse[k] == 0.0) continue;
      const double order = halving_order(one.coarse[k], one.fine[k]);
      const double expected = k == 4 && one.member.rho_rate < 1.0 ? 1.0 : 2.0;
      table.rows.push_back(
          ReportRow(fmt::format("{}, ({}, {}): {}", one.name, one.member.rho, one.member.rho_rate, rated_2018[k]),
                    {3, false})
              .defaults(order)
              .below(fmt::format("|order - {}|", expected), std::abs(order - expected), 0.1));
    }
    table.rows.push_back(
        ReportRow(fmt::format("{}, ({}, {}): constraint residual", one.name, one.member.rho, one.member.rho_rate),
                  {1, true})
            .defaults(one.residual)
            .below("residual", one.residual, 1e-12));
  }
  return table;
}

ReportPicture order_picture_2018(const std::vector<OrderSeries2018>& series, int steps, const PaperRuns& runs) {
  Chart chart = make_paper_chart("Case II resistance, (ρ∞, ρ∞ of the rate) = (1, 0)", "step", "largest error", true);
  for (const OrderSeries2018& one : series) {
    if (one.name != "II resistance" || one.member.rho != 1.0 || one.member.rho_rate != 0.0) continue;
    for (std::size_t k = 0; k < rated_2018.size(); ++k) {
      chart.curves.push_back({std::string(rated_2018[k]),
                              {order_end_2018 / steps, 0.5 * order_end_2018 / steps},
                              {one.coarse[k], one.fine[k]},
                              CurveStyle::dots_on_line,
                              static_cast<int>(k)});
    }
  }
  return save_paper_chart(chart, "2018_orders",
                          "The rate that the family keeps is of first order; corrected, of second.", runs);
}

}  // namespace

ReportSection orders_section_2018(PaperRuns& runs) {
  const int steps = 160;
  const std::vector<OrderSeries2018> series = order_series_2018(runs, steps);
  ReportSection section;
  section.blocks.push_back(
      ReportText{"The abstract promises second order for the temperature, its rate and the multipliers in every member "
                 "of the family "
                 "(ρ∞, ρ∞ of the rate). The rate that the family keeps stands for a time before the end of the step "
                 "unless γ = 1/2, "
                 "that is ρ∞ of the rate = 1: it is of first order. Moved to the end of the step it is of second order "
                 "too, as are "
                 "temperatures, fluxes and multipliers. Constraints hold at the end of every step to rounding."});
  section.blocks.push_back(order_picture_2018(series, steps, runs));
  section.blocks.push_back(order_table_2018(series));
  return section;
}

}  // namespace peritherm
