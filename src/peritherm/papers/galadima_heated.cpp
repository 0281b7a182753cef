#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "peritherm/papers/galadima_plates.hpp"
#include "peritherm/papers/galadima_sections.hpp"
#include "peritherm/papers/galadima_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace heated_v = galadima_values;

const std::vector<double> galadima_heated_times(heated_v::plate_times.begin(), heated_v::plate_times.end());

ReportTable whole_heated_table(const TrialBody& body) {
  ReportTable table{"The whole plate, bottom row heated by 1e7 K/s: points (row from the bottom, column) [°C]", {}};
  const Solution& solution = body.full();
  for (const heated_v::PlateValue& value : heated_v::heated_plate) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t time = plate_times_drawn[k];
      const double reference = value.temperatures[k];
      // The march may leave 1e-11 of 1,000 °C.
      const double limit = half_last_digit(reference) + 1e-8;
      ReportRow row(fmt::format("({}, {}), {} s", value.row, value.column, solution.times[time]), {7, true});
      table.rows.push_back(row.recomputed(reference)
                               .scheme(solution.temperatures[time][plate_point(value.row, value.column)])
                               .near(ValueKind::scheme, ValueKind::recomputed, limit));
    }
  }
  for (const std::size_t time : plate_times_drawn) {
    const std::vector<double>& values = solution.temperatures[time];
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    const double exact = plate_heating * solution.times[time] / plate_points;
    table.rows.push_back(ReportRow(fmt::format("mean, {} s", solution.times[time]), {7, true})
                             .scheme(mean)
                             .exact(exact)
                             .near(ValueKind::scheme, ValueKind::exact, 1e-9 * exact));
  }
  return table;
}

void add_source_rows(ReportTable& table, const TriedModel& wrong) {
  double worst = 0.0;
  for (const double error : wrong.at_retained) worst = std::max(worst, error);
  table.rows.push_back(
      ReportRow("wrong on purpose: sources of condensed points dropped, worst of the times", {2, false})
          .recomputed(0.5)
          .scheme(worst));
}

void add_condensed_heated(ReportSection& section, const TrialBody& body, const std::vector<TriedModel>& condensed,
                          double slowest, const PaperRuns& runs) {
  ReportTable errors{"Condensed plate (2,025 points): largest error at retained points over the largest temperature",
                     {}};
  add_error_rows(errors, condensed[0], galadima_heated_times, heated_v::heated_every_second.errors);
  add_error_rows(errors, condensed[1], galadima_heated_times, heated_v::heated_lumped.errors);
  add_source_rows(errors, body.judge("dropped", without_condensed_sources(condensed[0].reduction, plate_heating)));
  ReportTable facts{"Condensed plate: what follows from its eigenvalues and shares", {}};
  facts.rows.push_back(ReportRow("slowest rate above that of the whole plate, relative", {2, true})
                           .recomputed(heated_v::heated_slowest)
                           .scheme(condensed[0].rates()[1] / slowest - 1.0)
                           .near(ValueKind::scheme, ValueKind::recomputed, half_last_digit(heated_v::heated_slowest)));
  add_shape_rows(facts, condensed[0]);
  section.blocks.push_back(std::move(errors));
  section.blocks.push_back(std::move(facts));
  for (ReportPicture& picture : plate_pictures(body, condensed[0], 14, runs))
    section.blocks.push_back(std::move(picture));
  section.blocks.push_back(plate_line_picture(body, condensed[0], 15, {5, 6, 7}, runs));
}

ReportTable heated_step_table(const PaperRuns&) {
  ReportTable table{"The whole plate: bonds and the longest stable step of forward Euler", {}};
  const BondFacts facts = bond_facts(galadima_plate(PlateLoad::heated));
  table.rows.push_back(ReportRow("bonds", {0, false})
                           .recomputed(110178)
                           .scheme(facts.bonds)
                           .near(ValueKind::scheme, ValueKind::recomputed, 0.0));
  table.rows.push_back(ReportRow("bonds that the crack cuts", {0, false})
                           .recomputed(262)
                           .scheme(facts.cut_bonds)
                           .near(ValueKind::scheme, ValueKind::recomputed, 0.0));
  table.rows.push_back(ReportRow("conductivity over the material's", {6, false})
                           .recomputed(1.0254)
                           .scheme(facts.effective_conductivity)
                           .near(ValueKind::scheme, ValueKind::recomputed, 5.1e-7));
  table.rows.push_back(ReportRow("fastest rate [1/s]", {2, false})
                           .recomputed(heated_v::plate_fastest_rate)
                           .scheme(facts.fastest_rate)
                           .near(ValueKind::scheme, ValueKind::recomputed, 0.0051));
  table.rows.push_back(ReportRow("the paper's step over the longest stable one", {3, false})
                           .scheme(1e-6 * facts.fastest_rate / 2.0)
                           .below("step", 1e-6 * facts.fastest_rate / 2.0, 1.0));
  return table;
}

std::vector<const TriedModel*> heated_pointers(const std::vector<TriedModel>& models) {
  std::vector<const TriedModel*> all;
  for (const TriedModel& model : models) all.push_back(&model);
  return all;
}

std::vector<TriedModel> condense_heated(ReportSection& section, TrialBody& body, double slowest, PaperRuns& runs) {
  std::vector<TriedModel> condensed;
  if (runs.quick()) {
    section.left_out =
        "condensation to every 2nd point (eigenvalue problems of 2,025 unknowns), 200 modes, "
        "Figs. 14 and 15.";
    condensed.push_back(
        body.reduce("every 10th, condensed",
                    condensed_plate(every_point(10), CondensedCapacity::consistent, ModelStart::projected)));
  } else {
    condensed.push_back(
        body.reduce(heated_v::heated_every_second.name,
                    condensed_plate(every_point(2), CondensedCapacity::consistent, ModelStart::sampled)));
    runs.pass();
    condensed.push_back(body.reduce(heated_v::heated_lumped.name,
                                    condensed_plate(every_point(2), CondensedCapacity::lumped, ModelStart::sampled)));
    add_condensed_heated(section, body, condensed, slowest, runs);
  }
  return condensed;
}

}  // namespace

ReportSection galadima_heated_section(PaperRuns& runs) {
  TrialBody body(galadima_plate(PlateLoad::heated), galadima_heated_times, true, runs);
  ReportSection section;
  section.blocks.push_back(ReportText{
      "The same plate, insulated, its bottom row heated. The paper's 10^7 has no unit; read as 1e7 K/s on the bottom "
      "row of points. Results scale with it. Errors are told over the largest temperature of each time. Half of the "
      "heated "
      "points are condensed away: their heat goes to retained ones through h_G = h_r + Rᵀ h_t, the part of eq. (65) "
      "that is easily "
      "forgotten; without it half of the heat is lost. Lumped capacities are worse here, since they "
      "store a source layer's heat in the wrong places."});
  section.blocks.push_back(heated_step_table(runs));
  section.blocks.push_back(whole_heated_table(body));
  const std::vector<TriedModel> krylov = krylov_family(body, runs.quick());
  const std::vector<TriedModel> condensed = condense_heated(section, body, krylov.back().rates()[1], runs);
  std::vector<TriedModel> modes;
  for (const int count : runs.quick() ? std::vector<int>{50} : std::vector<int>{50, 200})
    modes.push_back(body.reduce(fmt::format("every 10th and {} modes", count), plate_with_modes(10, count)));
  std::vector<std::pair<int, double>> reference;
  for (const heated_v::KrylovValue& value : heated_v::heated_krylov)
    reference.emplace_back(value.unknowns, value.error);
  section.blocks.push_back(krylov_table(krylov, reference));
  std::vector<const TriedModel*> all = heated_pointers(condensed);
  std::vector<const TriedModel*> drawn = all;
  drawn.insert(drawn.end(), {&modes.back(), &krylov[2], &krylov.back()});
  for (const auto& family : {heated_pointers(modes), heated_pointers(krylov)})
    all.insert(all.end(), family.begin(), family.end());
  section.blocks.push_back(side_by_side(
      "All methods side by side: largest errors from 1e-6 s to 7e-3 s over the largest temperature, sizes, durations",
      all));
  section.blocks.push_back(save_paper_chart(
      chart_over_time("Heated edge: largest error over all points", "error over the largest temperature",
                      galadima_heated_times, drawn),
      "galadima_heated_methods", "Errors over time, 8,100 points; all models are exact in time.", runs));
  return section;
}

}  // namespace peritherm
