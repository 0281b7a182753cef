#include "peritherm/papers/galadima_plates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "peritherm/papers/galadima_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

constexpr int line_column = 44;

Solution reduced_solution(const TrialBody& body, const TriedModel& model) {
  Solution solution = body.full();
  solution.temperatures = model.temperatures;
  return solution;
}

}  // namespace

StaticCondensation condensed_plate(RetainedPoints points, CondensedCapacity capacity, ModelStart start) {
  StaticCondensation method;
  method.retained = std::move(points);
  method.capacity = capacity;
  method.start = start;
  return method;
}

CraigBampton plate_with_modes(int every, int modes) {
  CraigBampton method;
  method.retained = every_point(every);
  method.modes = modes;
  return method;
}

ReportPicture plate_line_picture(const TrialBody& body, const TriedModel& model, int figure,
                                 const std::vector<std::size_t>& times, const PaperRuns& runs) {
  Chart chart = make_paper_chart(fmt::format("Fig. {}: along x = -0.055 mm, {}", figure, model.name), "y [mm]",
                                 "temperature [°C]");
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double time = body.full().times[times[k]];
    Curve whole{fmt::format("{} s, whole", time), {}, {}, CurveStyle::line, static_cast<int>(k)};
    Curve reduced{fmt::format("{} s, condensed", time), {}, {}, CurveStyle::dots, static_cast<int>(k)};
    for (int row = 0; row < plate_points; ++row) {
      const std::size_t point = plate_point(row, line_column);
      const double y = 1e3 * plate_spacing * (row + 0.5 - 0.5 * plate_points);
      whole.x.push_back(y);
      whole.y.push_back(body.full().temperatures[times[k]][point]);
      const std::vector<std::int64_t>& retained = model.model().retained;
      if (!std::binary_search(retained.begin(), retained.end(), static_cast<std::int64_t>(point))) continue;
      reduced.x.push_back(y);
      reduced.y.push_back(model.temperatures[times[k]][point]);
    }
    chart.curves.push_back(std::move(whole));
    chart.curves.push_back(std::move(reduced));
  }
  return save_paper_chart(chart, fmt::format("galadima_figure_{}", figure),
                          fmt::format("Fig. {}: temperature along the points next to the vertical axis; dots: retained "
                                      "points of the condensed plate.",
                                      figure),
                          runs);
}

std::vector<ReportPicture> plate_pictures(const TrialBody& body, const TriedModel& model, int figure,
                                          const PaperRuns& runs) {
  std::vector<ReportPicture> pictures;
  const Solution reduced = reduced_solution(body, model);
  const auto add = [&](const Solution& solution, const std::string& what, char part, std::size_t time) {
    const std::vector<double>& values = body.full().temperatures[time];
    PaperField field{solution, time, fmt::format("Fig. {}{}: {}, {} s", figure, part, what, solution.times[time])};
    field.low = 0.0;
    field.high = *std::max_element(values.begin(), values.end());
    field.problem = &body.problem();
    pictures.push_back(save_paper_field(field, fmt::format("galadima_figure_{}{}", figure, part),
                                        fmt::format("Fig. {}{}: temperature of the {} plate [°C].", figure, part, what),
                                        runs));
  };
  for (std::size_t k = 0; k < 3; ++k) add(body.full(), "whole", "abc"[k], plate_times_drawn[k]);
  for (std::size_t k = 0; k < 3; ++k) add(reduced, "condensed", "def"[k], plate_times_drawn[k]);
  return pictures;
}

std::vector<TriedModel> krylov_family(TrialBody& body, bool quick) {
  std::vector<TriedModel> family;
  for (int power = 2; power <= (quick ? 6 : 8); ++power) {
    RationalKrylov method;
    method.tolerance = std::pow(10.0, -power);
    family.push_back(body.reduce(fmt::format("rational Krylov, tolerance 1e-{}", power), method));
  }
  return family;
}

ReportTable krylov_table(const std::vector<TriedModel>& family, const std::vector<std::pair<int, double>>& reference) {
  ReportTable table{"Rational Krylov: largest error over all points and the eight times, over the largest temperature",
                    {}};
  table.further = {"unknowns"};
  double best = 1.0;
  for (const TriedModel& model : family) {
    ReportRow row(model.name, {1, true});
    row.scheme(model.worst());
    row.further = {std::to_string(model.unknowns())};
    table.rows.push_back(row);
    if (model.unknowns() <= 20) best = std::min(best, model.worst());
  }
  for (const auto& [unknowns, error] : reference) {
    ReportRow row("the prototype, shifts chosen by hand", {1, true});
    row.recomputed(error);
    row.further = {std::to_string(unknowns)};
    table.rows.push_back(row);
  }
  table.rows.push_back(
      ReportRow("the best with at most 20 unknowns", {1, true}).scheme(best).below("error", best, 1e-5));
  return table;
}

ReportPicture unknowns_picture(const std::vector<MethodCurve>& curves, const std::string& stem, const PaperRuns& runs) {
  Chart chart = make_paper_chart("Largest error over all points and times", "unknowns",
                                 "error over the largest temperature", true);
  for (const MethodCurve& curve : curves) {
    if (curve.models.empty()) continue;
    Curve drawn{curve.name, {}, {}, CurveStyle::dots_on_line};
    for (const TriedModel* model : curve.models) {
      drawn.x.push_back(static_cast<double>(model->unknowns()));
      drawn.y.push_back(model->worst());
    }
    chart.curves.push_back(std::move(drawn));
  }
  return save_paper_chart(chart, stem, "Errors over the size of the model, 1e-6 s to 7e-3 s, all 8,100 points.", runs);
}

}  // namespace peritherm
