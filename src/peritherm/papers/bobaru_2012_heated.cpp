#include <fmt/format.h>

#include <cmath>
#include <map>

#include "peritherm/base/larger.hpp"
#include "peritherm/papers/bobaru_2012_plates.hpp"
#include "peritherm/papers/bobaru_2012_sections.hpp"
#include "peritherm/papers/bobaru_2012_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2012 = bobaru_2012_values;

constexpr double heated_row = 0.5 * centimetre;
constexpr double mirrored_limit = 0.0005;  ///< of the entries of Table 1
const std::vector<double> heated_times(values_2012::table_1_times.begin(), values_2012::table_1_times.end());

/// Runs of example 2 with m = 6.5, by scheme and horizon.
struct HeatedStudy {
  std::size_t horizons = 3;
  std::map<std::pair<PlateScheme, std::size_t>, Solution> solutions;
  TemperatureAt classical = make_temperature(classical_square(2));
  static constexpr PlateScheme schemes[] = {PlateScheme::mirrored, PlateScheme::literal, PlateScheme::defaults};

  explicit HeatedStudy(PaperRuns& runs) : horizons(runs.quick() ? 2 : 3) {
    std::vector<PaperRun> all;
    for (const PlateScheme scheme : schemes) {
      for (std::size_t h = 0; h < count(scheme); ++h) all.push_back(square_run({2, 60, 1 << h, scheme}, heated_times));
    }
    std::vector<Solution> computed = runs.solve(std::move(all));
    auto next = computed.begin();
    for (const PlateScheme scheme : schemes) {
      for (std::size_t h = 0; h < count(scheme); ++h) solutions[{scheme, h}] = std::move(*next++);
    }
  }

  /// Horizons of a scheme; the quick variant reads section 3.2 literally at the coarsest one only.
  std::size_t count(PlateScheme scheme) const { return scheme == PlateScheme::literal && horizons < 3 ? 1 : horizons; }
  double difference(const Solution& solution, std::size_t time) const {
    return measure(StudyNorm::relative_l2, compare_row(solution, time, heated_row, classical));
  }
  double difference(PlateScheme scheme, std::size_t h, std::size_t time) const {
    return difference(solutions.at({scheme, h}), time);
  }
  std::vector<double> differences(PlateScheme scheme, std::size_t time) const {
    std::vector<double> values;
    for (std::size_t h = 0; h < count(scheme); ++h) values.push_back(difference(scheme, h, time));
    return values;
  }
  std::vector<double> horizon_sizes() const {
    std::vector<double> sizes;
    for (std::size_t h = 0; h < horizons; ++h) sizes.push_back(13.0 / (120 << h));
    return sizes;
  }
};

struct TableReading {
  std::string caption;
  PlateScheme scheme;
  const double (&recomputed)[3][3];
  const std::array<double, 3>& recomputed_rates;
  double limit, rate_limit;
};

ReportTable table_1(const HeatedStudy& study, const TableReading& reading) {
  ReportTable table{reading.caption, {}};
  for (std::size_t time = 0; time < 3; ++time) {
    const std::string when = fmt::format("t = {} s", heated_times[time]);
    const std::vector<double> differences = study.differences(reading.scheme, time);
    const std::vector<double> defaults = study.differences(PlateScheme::defaults, time);
    for (std::size_t h = 0; h < differences.size(); ++h) {
      table.rows.push_back(ReportRow(fmt::format("{}, δ = 13L/{}", when, 120 << h), {5, false})
                               .published(values_2012::table_1[time][h], "Table 1")
                               .recomputed(reading.recomputed[time][h])
                               .scheme(differences[h])
                               .defaults(defaults[h])
                               .near(ValueKind::scheme, ValueKind::published, reading.limit));
    }
    if (study.horizons < 3) continue;
    table.rows.push_back(ReportRow(when + ", rate", {3, false})
                             .published(values_2012::table_1_rates[time], "Fig. 15, text")
                             .recomputed(reading.recomputed_rates[time])
                             .scheme(fitted_rate(study.horizon_sizes(), differences))
                             .defaults(fitted_rate(study.horizon_sizes(), defaults))
                             .near(ValueKind::scheme, ValueKind::published, reading.rate_limit));
  }
  return table;
}

ReportPicture heated_profile_picture(const HeatedStudy& study, std::size_t h, const PaperRuns& runs) {
  Chart chart = make_paper_chart(fmt::format("2012, Fig. 14: example 2 on y = 0.5, δ = 13L/{}", 120 << h), "x [cm]",
                                 "temperature [°C]");
  for (std::size_t time = 0; time < 3; ++time) {
    const std::string when = fmt::format("{} s", heated_times[time]);
    const int colour = static_cast<int>(time);
    const ComparedPoints scheme =
        compare_row(study.solutions.at({PlateScheme::mirrored, h}), time, heated_row, study.classical);
    const ComparedPoints defaults =
        compare_row(study.solutions.at({PlateScheme::defaults, h}), time, heated_row, study.classical);
    chart.curves.push_back({"classical, " + when, scheme.x, scheme.classical, CurveStyle::line, colour});
    chart.curves.push_back({"scheme, " + when, scheme.x, scheme.computed, CurveStyle::dashed, colour});
    Curve dots{"defaults, " + when, {}, {}, CurveStyle::dots, colour};
    for (std::size_t n = 0; n < defaults.x.size(); n += defaults.x.size() / 20) {
      dots.x.push_back(defaults.x[n]);
      dots.y.push_back(defaults.computed[n]);
    }
    chart.curves.push_back(std::move(dots));
  }
  return save_paper_chart(chart, fmt::format("2012_figure_14_horizon_{}", 120 << h),
                          "Fig. 14: temperatures on y = 0.5, m = 6.5; top and bottom mirrored in the published scheme.",
                          runs);
}

ReportPicture heated_rate_picture(const HeatedStudy& study, const PaperRuns& runs) {
  Chart chart = make_paper_chart("2012, Fig. 15: example 2, m = 6.5", "δ/L", "relative difference", true);
  for (std::size_t time = 0; time < 3; ++time) {
    const std::string when = fmt::format("{} s", heated_times[time]);
    const int colour = static_cast<int>(time);
    std::vector<double> published(values_2012::table_1[time], values_2012::table_1[time] + study.horizons);
    chart.curves.push_back({"Table 1, " + when, study.horizon_sizes(), published, CurveStyle::dots, colour});
    chart.curves.push_back({"scheme, " + when, study.horizon_sizes(), study.differences(PlateScheme::mirrored, time),
                            CurveStyle::line, colour});
    chart.curves.push_back({"defaults, " + when, study.horizon_sizes(), study.differences(PlateScheme::defaults, time),
                            CurveStyle::dashed, colour});
  }
  return save_paper_chart(chart, "2012_figure_15",
                          "Fig. 15: δ-convergence of example 2; dots are the entries of Table 1.", runs);
}

ReportTable heated_time_table(const HeatedStudy& study, PaperRuns& runs) {
  const std::vector<Solution> tighter =
      runs.solve({with_tolerance(square_run({2, 60, 1, PlateScheme::mirrored}, heated_times), 1e-8),
                  with_tolerance(square_run({2, 60, 1, PlateScheme::defaults}, heated_times), 1e-8)});
  const auto row = [&](const std::string& name, const Solution& run, const Solution& tight) {
    double change = 0.0;
    for (std::size_t time = 0; time < 3; ++time) {
      change = larger(change, std::abs(study.difference(run, time) - study.difference(tight, time)));
    }
    return difference_change_row(name, change, 0.1 * mirrored_limit);
  };
  return {"Time integration (judged by a tenth of what Table 1 is)",
          {row("published scheme, δ = 13L/120", study.solutions.at({PlateScheme::mirrored, 0}), tighter[0]),
           row("defaults, δ = 13L/120", study.solutions.at({PlateScheme::defaults, 0}), tighter[1])}};
}

}  // namespace

ReportSection heated_square_section(PaperRuns& runs) {
  const HeatedStudy study(runs);
  ReportSection section;
  section.blocks.push_back(
      ReportText{"Section 3.2 prints one flux formula for every insulated side. Taken literally on three sides it "
                 "gives Table 1 within "
                 "0.0015; with the formula on the right and mirrors on top and bottom, every entry comes within "
                 "0.0005. That mirrors "
                 "were used there was inferred from the agreement: the paper does not say so. The heat flux of eq. "
                 "(19) is printed with "
                 "cos(βx)/β where β cos(βx) is meant; the exact column does not use it."});
  section.blocks.push_back(
      table_1(study, {"Table 1, flux formula on the right, mirrors on top and bottom (inferred)", PlateScheme::mirrored,
                      values_2012::table_1_mirrored, values_2012::table_1_mirrored_rates, mirrored_limit, 0.01}));
  section.blocks.push_back(
      table_1(study, {"Table 1, flux formula on three sides (as printed)", PlateScheme::literal,
                      values_2012::table_1_literal, values_2012::table_1_literal_rates, 0.0015, 0.03}));
  section.blocks.push_back(heated_rate_picture(study, runs));
  for (std::size_t h = 1; h < study.horizons; ++h) section.blocks.push_back(heated_profile_picture(study, h, runs));
  section.blocks.push_back(heated_time_table(study, runs));
  if (runs.quick())
    section.left_out = "δ = 13L/480, and with it the rates; the flux formula on three sides at δ = 13L/240.";
  return section;
}

}  // namespace peritherm
