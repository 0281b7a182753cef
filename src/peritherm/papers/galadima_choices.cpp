#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "peritherm/papers/galadima_plates.hpp"
#include "peritherm/papers/galadima_sections.hpp"
#include "peritherm/papers/galadima_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace choice_v = galadima_values;

const std::vector<double> choice_times(choice_v::plate_times.begin(), choice_v::plate_times.end());
constexpr int random_seed = 1;

RetainedPoints random_points(int count) {
  RetainedPoints points;
  points.share = static_cast<double>(count) / (plate_points * plate_points);
  points.seed = random_seed;
  return points;
}

/// Every point of the square of 3.3 mm around the crack, every 2nd elsewhere.
RetainedPoints adaptive_points() {
  RetainedPoints points = every_point(2);
  const double half = 0.5 * 0.0033;
  points.regions.push_back({Box{{-half, -half}, {half, half}}, 1});
  return points;
}

void add_choice(ReportSection& section, TrialBody& body, const std::vector<const TriedModel*>& models,
                const PaperRuns& runs) {
  section.blocks.push_back(side_by_side(
      "Side by side: largest errors from 1e-6 s to 7e-3 s over the largest temperature, sizes, durations", models));
  Chart chart =
      make_paper_chart("Largest error over retained points", "time [s]", "error over the largest temperature", true);
  for (const TriedModel* model : models) {
    if (model->at_retained.empty()) continue;
    chart.curves.push_back({model->name, body.full().times, model->at_retained, CurveStyle::dots_on_line});
  }
  section.blocks.push_back(save_paper_chart(chart, "galadima_choices", "Errors of the three choices over time.", runs));
}

ReportTable random_table(const TriedModel& random, double slowest) {
  ReportTable table{"2,025 points at random (seed 1)", {}};
  table.rows.push_back(ReportRow("retained points", {0, false})
                           .scheme(static_cast<double>(random.unknowns()))
                           .below("|retained - 2025|", std::abs(static_cast<double>(random.unknowns()) - 2025.0), 0.0));
  table.rows.push_back(
      ReportRow("slowest rate above that of the whole plate, relative (another random choice)", {2, true})
          .recomputed(choice_v::random_slowest)
          .scheme(random.rates()[1] / slowest - 1.0)
          .below("below it", 1.0 - random.rates()[1] / slowest, 0.0));
  for (std::size_t k = 0; k < choice_times.size(); ++k) {
    table.rows.push_back(ReportRow(fmt::format("largest error at retained points, {} s", choice_times[k]), {3, true})
                             .scheme(random.at_retained[k]));
  }
  add_shape_rows(table, random);
  return table;
}

ReportTable adaptive_table(const TriedModel& adaptive) {
  ReportTable table{
      "Every 2nd point, and all near the crack (2,700): largest error at retained points over the largest temperature",
      {}};
  add_error_rows(table, adaptive, choice_times, choice_v::heated_adaptive.errors);
  table.rows.push_back(ReportRow("longest stable step, consistent [s]", {3, true})
                           .recomputed(choice_v::adaptive_step)
                           .scheme(longest_step(adaptive))
                           .near(ValueKind::scheme, ValueKind::recomputed, half_last_digit(choice_v::adaptive_step)));
  add_shape_rows(table, adaptive);
  return table;
}

void add_quick_choice(ReportSection& section, TrialBody& body, const TriedModel& krylov, const PaperRuns& runs) {
  const TriedModel few = body.reduce(
      "200 at random", condensed_plate(random_points(200), CondensedCapacity::consistent, ModelStart::projected));
  ReportTable table{"200 points at random", {}};
  add_shape_rows(table, few);
  section.blocks.push_back(std::move(table));
  add_choice(section, body, {&few, &krylov}, runs);
}

}  // namespace

ReportSection galadima_choices_section(PaperRuns& runs) {
  TrialBody body(galadima_plate(PlateLoad::heated), choice_times, true, runs);
  RationalKrylov finest;
  finest.tolerance = 1e-8;
  const TriedModel krylov = body.reduce("rational Krylov, tolerance 1e-8", finest);
  const double slowest = krylov.rates()[1];
  ReportSection section;
  section.blocks.push_back(
      ReportText{"The heated plate once more. At random: the paper draws 2,025 of 8,190 points, but the plate has "
                 "8,100. Adaptive: "
                 "all of the 30 × 30 points in a square of 3.3 mm around the crack, every 2nd elsewhere, 2,700 in all. "
                 "Its largest error early on "
                 "is that of the regular choice, because it stands at the heated row, which the window does not "
                 "change; late it is almost "
                 "halved. The window takes away what lumping gains in the step: fine points that stay bring fast rates "
                 "that stay."});
  if (runs.quick()) {
    add_quick_choice(section, body, krylov, runs);
    return section;
  }
  const TriedModel random = body.reduce(
      "at random", condensed_plate(random_points(2025), CondensedCapacity::consistent, ModelStart::projected));
  runs.pass();
  const TriedModel adaptive =
      body.reduce(choice_v::heated_adaptive.name,
                  condensed_plate(adaptive_points(), CondensedCapacity::consistent, ModelStart::projected));
  section.blocks.push_back(random_table(random, slowest));
  for (ReportPicture& picture : plate_pictures(body, random, 16, runs)) section.blocks.push_back(std::move(picture));
  section.blocks.push_back(plate_line_picture(body, random, 17, {3, 5, 7}, runs));
  section.blocks.push_back(adaptive_table(adaptive));
  for (ReportPicture& picture : plate_pictures(body, adaptive, 18, runs)) section.blocks.push_back(std::move(picture));
  section.blocks.push_back(plate_line_picture(body, adaptive, 19, {3, 5, 7}, runs));
  add_choice(section, body, {&random, &adaptive, &krylov}, runs);
  return section;
}

}  // namespace peritherm
