#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "peritherm/papers/galadima_plates.hpp"
#include "peritherm/papers/galadima_sections.hpp"
#include "peritherm/papers/galadima_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace held_v = galadima_values;

const std::vector<double> galadima_held_times(held_v::plate_times.begin(), held_v::plate_times.end());

constexpr double march_error = 1e-11;  ///< that the full run may leave [°C]

ReportTable whole_held_table(const TrialBody& body, PaperRuns& runs) {
  ReportTable table{"The whole plate, bottom row held at 1 °C: points (row from the bottom, column) [°C]", {}};
  const auto add = [&](const std::string& how, const Solution& solution, const held_v::PlateValue& value, int digits) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t time = solution.times.size() == 3 ? k : plate_times_drawn[k];
      ReportRow row(fmt::format("({}, {}), {} s, {}", value.row, value.column, solution.times[time], how),
                    {digits, true});
      table.rows.push_back(
          row.recomputed(value.temperatures[k])
              .scheme(solution.temperatures[time][plate_point(value.row, value.column)])
              .near(ValueKind::scheme, ValueKind::recomputed, half_last_digit(value.temperatures[k]) + march_error));
    }
  };
  for (const held_v::PlateValue& value : held_v::held_plate) add("exact in time", body.full(), value, 7);
  if (runs.quick()) return table;
  PaperRun euler{galadima_plate(PlateLoad::held), {7e-5, 7e-4, 7e-3}};
  euler.problem.time.integrator = ForwardEuler{1e-6};
  const Solution stepped = runs.solve(euler);
  for (const held_v::PlateValue& value : held_v::held_plate_euler) add("steps of 1e-6 s", stepped, value, 7);
  return table;
}

/// Every 2nd point, in the three ways; one eigenvalue problem serves both starts.
struct CondensedHeld {
  std::vector<TriedModel> models;  ///< sampled, projected, lumped; none in the quick variant
};

CondensedHeld condense_held(TrialBody& body, PaperRuns& runs) {
  CondensedHeld condensed;
  if (runs.quick()) return condensed;
  TriedModel projected =
      body.reduce(held_v::held_projected.name,
                  condensed_plate(every_point(2), CondensedCapacity::consistent, ModelStart::projected));
  TriedModel sampled = body.judge(held_v::held_sampled.name, with_sampled_start(projected.reduction));
  sampled.set_up = projected.set_up;
  runs.pass();
  TriedModel lumped = body.reduce(held_v::held_lumped.name,
                                  condensed_plate(every_point(2), CondensedCapacity::lumped, ModelStart::sampled));
  condensed.models = {std::move(sampled), std::move(projected), std::move(lumped)};
  return condensed;
}

void add_condensed_held(ReportSection& section, const TrialBody& body, const CondensedHeld& condensed, double slowest,
                        const PaperRuns& runs) {
  ReportTable errors{"Condensed plate (1,980 free and 90 held points): largest error at retained points [°C]", {}};
  add_error_rows(errors, condensed.models[0], galadima_held_times, held_v::held_sampled.errors);
  add_error_rows(errors, condensed.models[1], galadima_held_times, held_v::held_projected.errors);
  add_error_rows(errors, condensed.models[2], galadima_held_times, held_v::held_lumped.errors);
  ReportTable facts{"Condensed plate: what follows from its eigenvalues and shares", {}};
  const TriedModel& consistent = condensed.models[0];
  facts.rows.push_back(ReportRow("longest stable step, consistent [s]", {3, true})
                           .recomputed(held_v::held_step)
                           .scheme(longest_step(consistent))
                           .near(ValueKind::scheme, ValueKind::recomputed, half_last_digit(held_v::held_step)));
  facts.rows.push_back(ReportRow("longest stable step, lumped [s]", {3, true})
                           .recomputed(held_v::held_lumped_step)
                           .scheme(longest_step(condensed.models[2]))
                           .near(ValueKind::scheme, ValueKind::recomputed, half_last_digit(held_v::held_lumped_step)));
  const double above = consistent.rates().front() / slowest - 1.0;
  facts.rows.push_back(ReportRow("slowest rate above that of the whole plate, relative", {1, true})
                           .recomputed(held_v::held_slowest)
                           .scheme(above)
                           .near(ValueKind::scheme, ValueKind::recomputed, half_last_digit(held_v::held_slowest)));
  add_shape_rows(facts, consistent);
  section.blocks.push_back(std::move(errors));
  section.blocks.push_back(std::move(facts));
  for (ReportPicture& picture : plate_pictures(body, condensed.models[0], 12, runs))
    section.blocks.push_back(std::move(picture));
  section.blocks.push_back(plate_line_picture(body, condensed.models[0], 13, {3, 5, 7}, runs));
}

/// Craig-Bampton models beside the reference, and what condensation of the same points does.
std::vector<TriedModel> craig_bampton_family(TrialBody& body, PaperRuns& runs, ReportTable& table) {
  std::vector<TriedModel> family;
  for (const held_v::CraigBamptonValue& value : held_v::held_craig_bampton) {
    if (runs.quick() && value.every != 10) continue;
    const std::string name = value.modes == 0 ? fmt::format("every {}th, condensed", value.every)
                                              : fmt::format("every {}th and {} modes", value.every, value.modes);
    const ReductionMethod method =
        value.modes == 0 ? ReductionMethod{condensed_plate(every_point(value.every), CondensedCapacity::consistent,
                                                           ModelStart::projected)}
                         : ReductionMethod{plate_with_modes(value.every, value.modes)};
    const TriedModel& model = family.emplace_back(body.reduce(name, method));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t time = plate_times_drawn[k];
      ReportRow row(fmt::format("{} ({} unknowns), {} s", name, model.unknowns(), galadima_held_times[time]),
                    {2, true});
      row.recomputed(value.errors[k])
          .scheme(model.at_retained[time])
          .near(ValueKind::scheme, ValueKind::recomputed,
                std::max(0.02 * value.errors[k], half_last_digit(value.errors[k])));
      if (k == 0) {
        const double apart = std::abs(static_cast<double>(model.unknowns()) - value.unknowns);
        row.below("|unknowns - recomputed|", apart, 0.0);
      }
      table.rows.push_back(std::move(row));
    }
    runs.pass();
  }
  return family;
}

std::vector<TriedModel> orthogonal_family(TrialBody& body) {
  std::vector<TriedModel> family;
  for (const int power : {3, 5, 7}) {
    ProperOrthogonal method;
    method.tolerance = std::pow(10.0, -power);
    family.push_back(body.reduce(fmt::format("proper orthogonal, tolerance 1e-{}", power), method));
  }
  return family;
}

ReportTable orthogonal_table(const std::vector<TriedModel>& family) {
  ReportTable table{"Proper orthogonal directions of a full run of this load: largest error over all points and times",
                    {}};
  table.further = {"unknowns"};
  for (const TriedModel& model : family) {
    ReportRow row(model.name, {1, true});
    row.scheme(model.worst());
    row.further = {std::to_string(model.unknowns())};
    table.rows.push_back(row);
  }
  for (const held_v::KrylovValue& value : held_v::held_proper_orthogonal) {
    ReportRow row("the prototype", {1, true});
    row.recomputed(value.error);
    row.further = {std::to_string(value.unknowns)};
    table.rows.push_back(row);
  }
  return table;
}

std::vector<const TriedModel*> pointers_to(const std::vector<TriedModel>& models) {
  std::vector<const TriedModel*> all;
  for (const TriedModel& model : models) all.push_back(&model);
  return all;
}

void add_held_methods(ReportSection& section, const std::vector<TriedModel>& condensed,
                      const std::vector<TriedModel>& modes, const std::vector<TriedModel>& krylov,
                      const std::vector<TriedModel>& orthogonal, const PaperRuns& runs) {
  std::vector<const TriedModel*> all = pointers_to(condensed);
  for (const auto& family : {pointers_to(modes), pointers_to(krylov), pointers_to(orthogonal)})
    all.insert(all.end(), family.begin(), family.end());
  section.blocks.push_back(
      side_by_side("All methods side by side: largest errors from 1e-6 s to 7e-3 s [°C], sizes, durations", all));
  std::vector<const TriedModel*> drawn = pointers_to(condensed);
  drawn.insert(drawn.end(), {&modes[0], &modes[1], &krylov[2], &krylov.back(), &orthogonal.back()});
  section.blocks.push_back(save_paper_chart(
      chart_over_time("Held edge: largest error over all points", "error [°C]", galadima_held_times, drawn),
      "galadima_held_methods", "Errors over time, 8,100 points; all models are exact in time.", runs));
  std::vector<MethodCurve> curves{{"condensed", {}},
                                  {"Craig-Bampton", {}},
                                  {"rational Krylov", pointers_to(krylov)},
                                  {"proper orthogonal", pointers_to(orthogonal)}};
  for (const TriedModel& model : modes) {
    const bool has_modes = std::holds_alternative<CraigBampton>(model.model().method);
    curves[has_modes ? 1 : 0].models.push_back(&model);
  }
  if (!condensed.empty()) curves.front().models.push_back(&condensed[1]);
  section.blocks.push_back(unknowns_picture(curves, "galadima_held_unknowns", runs));
}

}  // namespace

ReportSection galadima_held_section(PaperRuns& runs) {
  TrialBody body(galadima_plate(PlateLoad::held), galadima_held_times, false, runs);
  ReportSection section;
  section.blocks.push_back(ReportText{
      "90 × 90 points, the bottom row held at 1 °C from the start on, a horizontal crack of 1.6 mm in the middle. The "
      "paper's step of 1e-6 s is stable (limit 1.39e-6 s). Whole and reduced plates are exact in time, so that no "
      "integrator stands between them. Held points stay held: the unknowns are the free retained points alone, and "
      "what the condensed capacity couples them with a sudden change of the held row by is kept exactly. A sudden "
      "change can "
      "begin in two ways: with retained points as they are, or with the closest start in the sense of heat, which is "
      "worse at the very first times and better after some 5e-6 s."});
  section.blocks.push_back(whole_held_table(body, runs));
  const std::vector<TriedModel> krylov = krylov_family(body, runs.quick());
  const CondensedHeld condensed = condense_held(body, runs);
  if (!condensed.models.empty()) {
    add_condensed_held(section, body, condensed, krylov.back().rates().front(), runs);
  } else {
    section.left_out =
        "condensation to every 2nd point (eigenvalue problems of 1,980 unknowns), Figs. 12 and 13, "
        "forward Euler, Craig-Bampton with every 4th point.";
  }
  ReportTable bampton{
      "Craig-Bampton: retained points and the slowest modes between them; largest error at retained points [°C]", {}};
  const std::vector<TriedModel> modes = craig_bampton_family(body, runs, bampton);
  section.blocks.push_back(std::move(bampton));
  std::vector<std::pair<int, double>> reference;
  for (const held_v::KrylovValue& value : held_v::held_krylov) reference.emplace_back(value.unknowns, value.error);
  section.blocks.push_back(krylov_table(krylov, reference));
  const std::vector<TriedModel> orthogonal = orthogonal_family(body);
  section.blocks.push_back(orthogonal_table(orthogonal));
  add_held_methods(section, condensed.models, modes, krylov, orthogonal, runs);
  return section;
}

}  // namespace peritherm
