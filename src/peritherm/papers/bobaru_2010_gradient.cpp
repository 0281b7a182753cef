#include <fmt/format.h>

#include <array>

#include "peritherm/papers/bobaru_2010_bars.hpp"
#include "peritherm/papers/bobaru_2010_values.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2010 = bobaru_2010_values;

const std::vector<double> gradient_times_2010{0.1, 4.0, 8.0};

ReportTable gradient_table(const Solution (&solutions)[2], const Solution& defaults, const TemperatureAt& classical) {
  ReportTable table{"Average relative difference (1/N) √Σ((c − p)/c)², δ = 3L/800, m = 4", {}};
  for (std::size_t kernel = 0; kernel < 2; ++kernel) {
    for (std::size_t time = 0; time < gradient_times_2010.size(); ++time) {
      const double value = measure(StudyNorm::bobaru_2010, compare_bar(solutions[kernel], time, classical));
      const double right = values_2010::recomputed_differences[kernel][time];
      ReportRow row(fmt::format("{}, t = {} s", kernel_word(kernel == 0), gradient_times_2010[time]), {3, true});
      row.recomputed(right).scheme(value);
      // The prototype's numbers have three or four digits.
      row.near(ValueKind::scheme, ValueKind::recomputed, 0.51 * (time == 0 ? 1e-6 : 1e-7));
      if (time == 2) row.published(values_2010::printed_differences[kernel], "section 4.2.2");
      if (kernel == 0) row.defaults(measure(StudyNorm::bobaru_2010, compare_bar(defaults, time, classical)));
      table.rows.push_back(row);
    }
  }
  return table;
}

/// The printed averages beside other readings of eq. (45), and how the two kernels compare.
ReportTable readings_table(const Solution (&solutions)[2], const TemperatureAt& classical) {
  ReportTable table{"Readings of eq. (45) at 8 s, δ = 3L/800, m = 4", {}};
  constexpr std::size_t last = 2;
  std::array<double, 2> averages{};
  for (std::size_t kernel = 0; kernel < 2; ++kernel) {
    const std::string word = kernel_word(kernel == 0);
    const ComparedPoints points = compare_bar(solutions[kernel], last, classical);
    averages[kernel] = measure(StudyNorm::bobaru_2010, points);
    const double root = measure(StudyNorm::relative_rms, points);
    const double printed = values_2010::printed_differences[kernel];
    const double known = values_2010::recomputed_printed_norm[kernel];
    const double known_root = values_2010::recomputed_printed_norm_root[kernel];
    table.rows.push_back(ReportRow(word + ", eq. (45) as printed, (1/N) Σ((c − p)/c)²", {2, true})
                             .published(printed, "section 4.2.2")
                             .recomputed(known)
                             .scheme(root * root)
                             .near(ValueKind::scheme, ValueKind::recomputed, 5.1e-8));
    table.rows.push_back(ReportRow(word + ", its root", {2, true})
                             .published(printed, "section 4.2.2")
                             .recomputed(known_root)
                             .scheme(root)
                             .near(ValueKind::scheme, ValueKind::recomputed, 5.1e-5));
    table.rows.push_back(ReportRow(word + ", (1/N) √Σ((c − p)/c)² over the printed average", {2, false})
                             .scheme(averages[kernel] / printed));
  }
  table.rows.push_back(
      ReportRow("triangular over constant, (1/N) √Σ((c − p)/c)²", {2, false})
          .published(values_2010::printed_differences[1] / values_2010::printed_differences[0], "section 4.2.2")
          .recomputed(values_2010::recomputed_differences[1][last] / values_2010::recomputed_differences[0][last])
          .scheme(averages[1] / averages[0])
          .below("constant over triangular", averages[0] / averages[1], 1.0));
  return table;
}

ReportTable node_table(const Solution (&solutions)[2]) {
  ReportTable table{"Temperatures of three nodes, δ = 3L/800, m = 4", {}};
  constexpr std::array<std::size_t, 3> nodes{266, 533, 1066};
  for (std::size_t kernel = 0; kernel < 2; ++kernel) {
    for (std::size_t time = 0; time < gradient_times_2010.size(); ++time) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        table.rows.push_back(ReportRow(fmt::format("{}, node {}, t = {} s", kernel_word(kernel == 0), nodes[k],
                                                   gradient_times_2010[time]),
                                       {8, false})
                                 .recomputed(values_2010::recomputed_nodes[kernel][time][k])
                                 .scheme(solutions[kernel].temperatures[time][nodes[k]])
                                 .near(ValueKind::scheme, ValueKind::recomputed, 1e-6));
      }
    }
  }
  return table;
}

ReportTable classical_gradient_table(const TemperatureAt& classical) {
  ReportTable table{"The classical solution", {}};
  const double length = length_of_2010(3) * centimetre;
  for (std::size_t time = 0; time < gradient_times_2010.size(); ++time) {
    for (const int place : {0, 1}) {
      const double x = place == 0 ? 0.5 * length : length;
      table.rows.push_back(
          ReportRow(fmt::format("{}, t = {} s", place == 0 ? "x = L/2" : "x = L", gradient_times_2010[time]),
                    {8, false})
              .recomputed(values_2010::classical_example_3[time][place])
              .exact(classical({x, 0.0, 0.0}, gradient_times_2010[time]))
              .near(ValueKind::exact, ValueKind::recomputed, 1e-6));
    }
  }
  return table;
}

ReportPicture gradient_picture(const Solution (&solutions)[2], const TemperatureAt& classical, const PaperRuns& runs) {
  Chart chart = make_paper_chart("2010, Fig. 15: example 3", "x [cm]", "temperature [°C]");
  for (std::size_t time = 0; time < gradient_times_2010.size(); ++time) {
    for (std::size_t kernel = 0; kernel < 2; ++kernel) {
      const ComparedPoints points = compare_bar(solutions[kernel], time, classical);
      if (kernel == 0)
        chart.curves.push_back({time == 0 ? "classical" : "", points.x, points.classical, CurveStyle::line, 0});
      Curve dots{time == 0 ? kernel_word(kernel == 0) : "", {}, {}, CurveStyle::dots, static_cast<int>(kernel) + 1};
      for (std::size_t n = kernel == 0 ? 35 : 71; n < points.x.size(); n += 71) {
        dots.x.push_back(points.x[n]);
        dots.y.push_back(points.computed[n]);
      }
      chart.curves.push_back(std::move(dots));
    }
  }
  return save_paper_chart(
      chart, "2010_figure_15",
      "Fig. 15: temperatures at 0.1, 4 and 8 s of example 3 in the published scheme and of the classical solution.",
      runs);
}

}  // namespace

ReportSection gradient_section_of_2010(PaperRuns& runs) {
  const TemperatureAt classical = make_temperature(classical_of_2010(3));
  const std::vector<Solution> all =
      runs.solve({scheme_run_of_2010({3, true, 800, 4}, gradient_times_2010),
                  scheme_run_of_2010({3, false, 800, 4}, gradient_times_2010),
                  default_run_of_2010({3, true, 800, 4}, gradient_times_2010),
                  with_tolerance(scheme_run_of_2010({3, true, 800, 4}, gradient_times_2010), 1e-12)});
  const Solution schemes[2] = {all[0], all[1]};
  ReportSection section;
  section.blocks.push_back(
      ReportText{"The published averages, 3.43e-5 (constant) and 2.84e-5 (triangular), are not reproduced: in the norm "
                 "that gives the "
                 "published rates of examples 1 and 2 they fit t = 8 s by magnitude only, and "
                 "here the triangular "
                 "micro-conductivity differs more than the constant one, not less. Neither eq. (45) as printed nor its "
                 "root comes near. The rows are judged against an independent prototype of the same scheme."});
  section.blocks.push_back(gradient_table(schemes, all[2], classical));
  section.blocks.push_back(readings_table(schemes, classical));
  section.blocks.push_back(gradient_picture(schemes, classical, runs));
  section.blocks.push_back(node_table(schemes));
  section.blocks.push_back(classical_gradient_table(classical));
  section.blocks.push_back(
      ReportTable{"Time integration", {time_error_row("published scheme, constant [°C]", all[0], all[3], 1e-6)}});
  return section;
}

}  // namespace peritherm
