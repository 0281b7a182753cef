#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "peritherm/base/larger.hpp"
#include "peritherm/papers/bobaru_2010_bars.hpp"
#include "peritherm/papers/bobaru_2010_values.hpp"
#include "peritherm/papers/paper.hpp"
#include "peritherm/papers/paper_chart.hpp"

namespace peritherm {
namespace {

namespace values_2010 = bobaru_2010_values;

constexpr double end_of_2010 = 8.0;  ///< [s]
const std::vector<double> figure_times_2010{0.1, 4.0, 8.0};

/// All runs of one of the two examples with convergence studies.
class BarStudy {
 public:
  BarStudy(int example, PaperRuns& runs) : example_(example), runs_(runs) {
    classical_ = make_temperature(classical_of_2010(example));
    ratios_ = runs.quick() ? std::vector<int>{2, 4} : std::vector<int>{2, 4, 8, 16};
    march();
  }

  const Solution& scheme(bool constant, int divisor, int ratio) const { return scheme_.at({constant, divisor, ratio}); }
  const Solution& defaults(bool constant, int divisor) const { return defaults_.at({constant, divisor}); }
  const std::vector<int>& ratios() const { return ratios_; }
  const TemperatureAt& classical() const { return classical_; }
  int example() const { return example_; }
  PaperRuns& runs() const { return runs_; }

  double middle(const Solution& solution) const { return solution.at(last(solution), {0.05, 0.0, 0.0}); }
  ComparedPoints at_end(const Solution& solution) const { return compare_bar(solution, last(solution), classical_); }
  static std::size_t last(const Solution& solution) { return solution.times.size() - 1; }

 private:
  static std::vector<double> times_of(int divisor, int ratio) {
    return divisor == 800 && ratio == 4 ? figure_times_2010 : std::vector<double>{end_of_2010};
  }

  void march() {
    std::vector<PaperRun> runs;
    for (const bool constant : {true, false}) {
      for (const int divisor : values_2010::divisors) {
        for (const int ratio : ratios_) {
          runs.push_back(scheme_run_of_2010({example_, constant, divisor, ratio}, times_of(divisor, ratio)));
        }
        runs.push_back(default_run_of_2010({example_, constant, divisor, 4}, times_of(divisor, 4)));
      }
    }
    const std::vector<Solution> solutions = runs_.solve(std::move(runs));
    auto next = solutions.begin();
    for (const bool constant : {true, false}) {
      for (const int divisor : values_2010::divisors) {
        for (const int ratio : ratios_) scheme_[{constant, divisor, ratio}] = *next++;
        defaults_[{constant, divisor}] = *next++;
      }
    }
  }

  int example_;
  PaperRuns& runs_;
  TemperatureAt classical_;
  std::vector<int> ratios_;
  std::map<std::tuple<bool, int, int>, Solution> scheme_;
  std::map<std::tuple<bool, int>, Solution> defaults_;
};

std::vector<double> horizons_of_rates() { return {3.0 / 200, 3.0 / 400, 3.0 / 800}; }

ReportTable middle_table(const BarStudy& study, bool constant) {
  ReportTable table{
      fmt::format("Fig. 10, {} micro-conductivity: temperature in the middle at 8 s", kernel_word(constant)), {}};
  const int example = study.example();
  const double exact = study.classical()({0.05, 0.0, 0.0}, end_of_2010);
  for (std::size_t h = 0; h < 4; ++h) {
    for (std::size_t k = 0; k < study.ratios().size(); ++k) {
      const int divisor = values_2010::divisors[h];
      const int ratio = study.ratios()[k];
      ReportRow row(fmt::format("δ = 3L/{}, m = {}", divisor, ratio), {4, false});
      row.recomputed(values_2010::recomputed_middle[example - 1][constant ? 0 : 1][h][k])
          .scheme(study.middle(study.scheme(constant, divisor, ratio)))
          .exact(exact);
      // Half of the last digit that the prototype's table has, and the integration in time.
      row.near(ValueKind::scheme, ValueKind::recomputed, 5.1e-5);
      if (ratio == 4) row.defaults(study.middle(study.defaults(constant, divisor)));
      table.rows.push_back(row);
    }
  }
  return table;
}

/// Eq. (38) in the middle of the bar, with the sign before θ₂ that is printed; + is meant.
double stepped_as_printed(double time) {
  const auto bar = std::get<SteppedStart>(classical_of_2010(2));
  double sum = 0.0;
  for (int n = 1; n < 60; n += 2) {
    const double angle = 0.5 * n * std::numbers::pi;
    const double step = std::sin(angle * bar.step / bar.length);
    const double wave = angle / bar.length;
    sum += 4.0 / (n * std::numbers::pi) *
           ((bar.left - bar.held) * step - (bar.right - bar.held) * (std::sin(angle) - step)) * std::cos(0.5 * angle) *
           std::exp(-bar.diffusivity * wave * wave * time);
  }
  return bar.held + sum;
}

ReportTable classical_table(const BarStudy& study) {
  const auto number = static_cast<std::size_t>(study.example() - 1);
  ReportRow row("classical temperature in the middle at 8 s", {8, false});
  row.published(values_2010::printed_classical_middle[number], "Fig. 10, caption")
      .recomputed(values_2010::classical_middle[number])
      .exact(study.classical()({0.05, 0.0, 0.0}, end_of_2010))
      .near(ValueKind::exact, ValueKind::recomputed, 1e-6)
      .near(ValueKind::exact, ValueKind::published, 5e-3);
  ReportTable table{"The classical solution", {row}};
  if (study.example() == 2) {
    table.rows.push_back(ReportRow("eq. (38) summed with its printed sign", {2, false})
                             .published(stepped_as_printed(end_of_2010), "eq. (38)")
                             .recomputed(values_2010::stepped_as_printed)
                             .near(ValueKind::published, ValueKind::recomputed, 5.1e-3));
  }
  return table;
}

double rate_of_scheme(const BarStudy& study, bool constant, int ratio) {
  std::vector<double> norms;
  for (const int divisor : {200, 400, 800})
    norms.push_back(measure(StudyNorm::bobaru_2010, study.at_end(study.scheme(constant, divisor, ratio))));
  return fitted_rate(horizons_of_rates(), norms);
}

/// Two of the printed rates stand apart: the independent prototype is as far from them (0.0251 and 0.0631) as we are.
/// The first is not judged by the printed value.
std::optional<double> limit_of_rate(double printed) {
  if (printed == 1.4877) return std::nullopt;
  return printed == 1.4433 ? 0.065 : 0.025;
}

constexpr double half_digit_of_rates = 5.01e-5;  ///< the prototype's are given to four digits

ReportTable rate_table(const BarStudy& study) {
  const int example = study.example();
  ReportTable table{"Rates of δ-convergence at 8 s over δ = 3L/200, 3L/400, 3L/800, in the norm (1/N) √Σ((c − p)/c)²",
                    {}};
  for (const bool constant : {true, false}) {
    for (std::size_t k = 0; k < study.ratios().size(); ++k) {
      const int kernel = constant ? 0 : 1;
      const int ratio = study.ratios()[k];
      const double printed = values_2010::printed_rates[example - 1][kernel][k];
      ReportRow row(fmt::format("{}, m = {}", kernel_word(constant), ratio), {4, false});
      row.published(printed, example == 1 ? "section 4.2.1, Fig. 11" : "section 4.2.1, Fig. 12")
          .recomputed(values_2010::recomputed_rates[example - 1][kernel][k])
          .scheme(rate_of_scheme(study, constant, ratio))
          .near(ValueKind::scheme, ValueKind::recomputed, half_digit_of_rates);
      if (const auto limit = limit_of_rate(printed)) row.near(ValueKind::scheme, ValueKind::published, *limit);
      table.rows.push_back(row);
    }
  }
  return table;
}

ReportTable default_table(const BarStudy& study) {
  ReportTable table{"Defaults, m = 4: √(mean of ((c − p)/c)²) at 8 s, and its order", {}};
  for (const bool constant : {true, false}) {
    std::vector<double> norms;
    for (const int divisor : {200, 400, 800}) {
      norms.push_back(measure(StudyNorm::relative_rms, without_zeros(study.at_end(study.defaults(constant, divisor)))));
      table.rows.push_back(
          ReportRow(fmt::format("{}, δ = 3L/{}", kernel_word(constant), divisor), {3, true})
              .scheme(measure(StudyNorm::relative_rms, without_zeros(study.at_end(study.scheme(constant, divisor, 4)))))
              .defaults(norms.back()));
    }
    const double order = fitted_rate(horizons_of_rates(), norms);
    table.rows.push_back(ReportRow(kernel_word(constant) + ", order", {3, false})
                             .defaults(order)
                             .below("|order - 2|", std::abs(order - 2.0), 0.1));
  }
  return table;
}

ReportPicture profile_picture(const BarStudy& study, int figure) {
  Chart chart =
      make_paper_chart(fmt::format("2010, Fig. {}: example {}", figure, study.example()), "x [cm]", "temperature [°C]");
  const Solution& constant = study.scheme(true, 800, 4);
  const Solution& triangular = study.scheme(false, 800, 4);
  for (std::size_t time = 0; time < figure_times_2010.size(); ++time) {
    const ComparedPoints all = compare_bar(constant, time, study.classical());
    const ComparedPoints other = compare_bar(triangular, time, study.classical());
    Curve dots{time == 0 ? "constant" : "", {}, {}, CurveStyle::dots, 1};
    Curve more{time == 0 ? "triangular" : "", {}, {}, CurveStyle::dots, 2};
    for (std::size_t n = 35; n < all.x.size(); n += 71) {
      dots.x.push_back(all.x[n]);
      dots.y.push_back(all.computed[n]);
    }
    for (std::size_t n = 71; n + 1 < other.x.size(); n += 71) {
      more.x.push_back(other.x[n]);
      more.y.push_back(other.computed[n]);
    }
    chart.curves.push_back({time == 0 ? "classical" : "", all.x, all.classical, CurveStyle::line, 0});
    chart.curves.push_back(std::move(dots));
    chart.curves.push_back(std::move(more));
  }
  return save_paper_chart(
      chart, fmt::format("2010_figure_{:02}", figure),
      fmt::format("Fig. {}: temperatures at 0.1, 4 and 8 s of the classical solution and of the published scheme with "
                  "δ = 3L/800, m = 4 (1067 nodes; the caption's Δx = L/800 contradicts them).",
                  figure),
      study.runs());
}

ReportPicture m_picture(const BarStudy& study, bool constant) {
  Chart chart = make_paper_chart(fmt::format("2010, Fig. 10: example {}, {}", study.example(), kernel_word(constant)),
                                 "m = δ/Δx", "temperature in the middle at 8 s [°C]");
  for (const int divisor : values_2010::divisors) {
    Curve curve{fmt::format("δ = 3L/{}", divisor), {}, {}, CurveStyle::line};
    for (const int ratio : study.ratios()) {
      curve.x.push_back(ratio);
      curve.y.push_back(study.middle(study.scheme(constant, divisor, ratio)));
    }
    chart.curves.push_back(std::move(curve));
  }
  const double exact = study.classical()({0.05, 0.0, 0.0}, end_of_2010);
  chart.curves.push_back(
      {"classical", {2.0, static_cast<double>(study.ratios().back())}, {exact, exact}, CurveStyle::dashed});
  return save_paper_chart(chart, fmt::format("2010_figure_10_example_{}_{}", study.example(), kernel_word(constant)),
                          "Fig. 10: m-convergence in the published scheme. The curves cross near the classical value, "
                          "but not at one point.",
                          study.runs());
}

ReportPicture rate_picture(const BarStudy& study) {
  const int figure = study.example() == 1 ? 11 : 12;
  Chart chart = make_paper_chart(fmt::format("2010, Fig. {}: example {}", figure, study.example()), "δ/L",
                                 "average relative difference", true);
  for (const bool constant : {true, false}) {
    for (const int ratio : study.ratios()) {
      Curve curve{fmt::format("{}, m = {}", kernel_word(constant), ratio),
                  horizons_of_rates(),
                  {},
                  constant ? CurveStyle::line : CurveStyle::dashed};
      for (const int divisor : {200, 400, 800}) {
        curve.y.push_back(measure(StudyNorm::bobaru_2010, study.at_end(study.scheme(constant, divisor, ratio))));
      }
      chart.curves.push_back(std::move(curve));
    }
    Curve curve{"defaults, " + kernel_word(constant) + ", m = 4", horizons_of_rates(), {}, CurveStyle::dots};
    for (const int divisor : {200, 400, 800}) {
      const ComparedPoints points = study.at_end(study.defaults(constant, divisor));
      curve.y.push_back(measure(StudyNorm::relative_rms, without_zeros(points)) /
                        std::sqrt(static_cast<double>(points.x.size())));
    }
    chart.curves.push_back(std::move(curve));
  }
  return save_paper_chart(
      chart, fmt::format("2010_figure_{}", figure),
      fmt::format("Fig. {}: δ-convergence at 8 s, (1/N) √Σ((c − p)/c)². In this norm an error of order "
                  "2 falls with slope 2.5.",
                  figure),
      study.runs());
}

/// Differences to the classical flux over κ at 8 s, away from the ends by a horizon.
ReportBlock flux_blocks(const BarStudy& study, int figure, int ratio, ReportTable& table) {
  Chart chart = make_paper_chart(fmt::format("2010, Fig. {}: example {}, m = {}", figure, study.example(), ratio),
                                 "x [cm]", "heat flux over κ [K/cm]");
  const ExactSolution exact = classical_of_2010(study.example());
  for (const bool constant : {true, false}) {
    const BarOf2010 bar{study.example(), constant, 800, ratio};
    const Solution& solution = study.scheme(constant, 800, ratio);
    const BarFlux flux = flux_of_2010(bar, solution, BarStudy::last(solution));
    Curve dots{kernel_word(constant), {}, {}, CurveStyle::dots};
    Curve line{"classical", {}, {}, CurveStyle::line};
    double largest = 0.0;
    const auto edge = static_cast<std::size_t>(2 * ratio);
    for (std::size_t n = edge; n + edge < flux.x.size(); ++n) {
      const double right = -gradient_along_x(exact, {flux.x[n] * centimetre, 0.0, 0.0}, end_of_2010) * centimetre;
      largest = larger(largest, std::abs(flux.flux[n] - right));
      line.x.push_back(flux.x[n]);
      line.y.push_back(right);
      if (n % (study.example() == 1 ? 40 : 19) != 0) continue;
      dots.x.push_back(flux.x[n]);
      dots.y.push_back(flux.flux[n]);
    }
    if (constant) chart.curves.push_back(std::move(line));
    chart.curves.push_back(std::move(dots));
    table.rows.push_back(
        ReportRow(fmt::format("{}: largest difference of the flux over κ, two horizons from the ends [K/cm]",
                              kernel_word(constant)),
                  {4, false})
            .scheme(largest));
  }
  return save_paper_chart(
      chart, fmt::format("2010_figure_{}", figure),
      fmt::format("Fig. {}: heat flux at 8 s by eqs. (19) and (20), δ = 3L/800, m = {}.", figure, ratio), study.runs());
}

ReportTable time_table(const BarStudy& study) {
  std::vector<PaperRun> runs;
  const BarOf2010 bar{study.example(), true, 800, 4};
  runs.push_back(with_tolerance(scheme_run_of_2010(bar, figure_times_2010), 1e-12));
  runs.push_back(with_tolerance(default_run_of_2010(bar, figure_times_2010), 1e-12));
  const std::vector<Solution> tighter = study.runs().solve(std::move(runs));
  return {"Time integration",
          {time_error_row("published scheme, constant, δ = 3L/800, m = 4 [K]", study.scheme(true, 800, 4), tighter[0],
                          1e-5),
           time_error_row("defaults, the same bar [K]", study.defaults(true, 800), tighter[1], 1e-6)}};
}

ReportSection convergence_section(PaperRuns& runs, int example) {
  const BarStudy study(example, runs);
  ReportSection section;
  section.blocks.push_back(
      ReportText{"Published scheme: nodes in the middle of the cells, half a cell at the edge of the horizon, the p = "
                 "i term with k(0), "
                 "end nodes held, insulated ends slaved by eq. (22), N = round(L m/δ). The printed eq. (45) is not "
                 "what the paper plots: "
                 "only (1/N) √Σ((c − p)/c)² over all nodes gives rates near 1.0 and 1.5, and it is used here."});
  if (example == 2) {
    section.blocks.push_back(ReportText{
        "Eq. (38) is printed with a wrong sign: as printed it gives more than 100 °C in the middle at 8 s. The "
        "exact column has it mended. The paper does not say how the node at x = L/2 starts; 30 °C is used. Two "
        "printed rates, 1.4877 and 1.4433 (triangular, m = 8 and 16), lie 0.0251 and 0.0631 below what the scheme "
        "gives "
        "here and in the prototype. The first is beyond the 0.025 that all others keep, and judged by the prototype "
        "only; "
        "the second is judged by 0.065."});
  }
  section.blocks.push_back(classical_table(study));
  section.blocks.push_back(profile_picture(study, example == 1 ? 8 : 9));
  section.blocks.push_back(rate_table(study));
  section.blocks.push_back(rate_picture(study));
  section.blocks.push_back(default_table(study));
  for (const bool constant : {true, false}) {
    section.blocks.push_back(m_picture(study, constant));
    section.blocks.push_back(middle_table(study, constant));
  }
  ReportTable fluxes{fmt::format("Heat flux at 8 s (Fig. {})", example == 1 ? 13 : 14), {}};
  section.blocks.push_back(flux_blocks(study, example == 1 ? 13 : 14, example == 1 ? 2 : 4, fluxes));
  section.blocks.push_back(std::move(fluxes));
  section.blocks.push_back(time_table(study));
  if (runs.quick()) section.left_out = "m = 8 and 16.";
  return section;
}

}  // namespace

Paper bobaru_2010() {
  return {
      "bobaru_2010",
      "Bobaru and Duangpanya 2010",
      "F. Bobaru, M. Duangpanya: The peridynamic formulation for transient heat conduction. International Journal "
      "of Heat "
      "and Mass Transfer 53 (2010) 4047–4059.",
      {{"Example 1: bar with held ends", [](PaperRuns& runs) { return convergence_section(runs, 1); }},
       {"Example 2: bar insulated at one end", [](PaperRuns& runs) { return convergence_section(runs, 2); }},
       {"Example 3: bar with a heat flux at one end", [](PaperRuns& runs) { return gradient_section_of_2010(runs); }}}};
}

}  // namespace peritherm
