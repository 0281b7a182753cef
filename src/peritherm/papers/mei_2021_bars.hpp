#pragma once

#include <optional>

#include "peritherm/papers/paper_cases.hpp"
#include "peritherm/solutions/exact_solution.hpp"

namespace peritherm {

/// A bar of the 2021 paper: 10 cm, 100 °C at the start, ends at 0 °C, constant micro-conductivity.
struct BarOf2021 {
  double ratio = 2.0;  ///< m
  int cells = 20;      ///< N = m L/δ
  Imposed wall = Imposed::row;
  PartialVolumes rule = PartialVolumes::whole;
  bool layered = false;  ///< four segments of diffusivities 10 and 1 cm²/s, else 10
  InterfaceRule interface = InterfaceRule::sided_harmonic;
  std::optional<double> step{};  ///< of forward Euler [s]; none: exact in time
};
/// m·q cells for the horizon L/q.
BarOf2021 bar_of_2021(int q, int ratio, Imposed wall, PartialVolumes rule = PartialVolumes::whole);
PaperRun run_of_2021(const BarOf2021& bar, std::vector<double> times);
/// The same bar with Peritherm's defaults.
PaperRun default_run_of_2021(const BarOf2021& bar, std::vector<double> times);

TemperatureAt classical_bar_2021();
TemperatureAt classical_layered_bar_2021();
Point place_in_bar(double x_cm);

std::string rule_name(PartialVolumes rule);

/// Six runs, L/10 then L/20, each m = 2, 4, 8, and their crossing.
struct SixRuns {
  static constexpr std::array<double, 3> ratios{2.0, 4.0, 8.0};
  std::vector<PaperRun> runs() const;
  BarOf2021 bar;  ///< what all have in common
  std::vector<double> times;
  std::vector<Solution> solutions;

  /// m* and temperature there; NaN if the parabolas do not cross.
  struct Crossing {
    double ratio, temperature;
  };
  Crossing crossing(std::size_t time, double x_cm) const;
  std::array<double, 3> curve(int q, std::size_t time, double x_cm) const;
};

/// Errors of a run against the classical solution [°C]; `middle`: mean of the two nodes next to x = 5 cm.
struct BarErrors {
  double largest, rms, middle;
};
BarErrors errors_of(const Solution& solution, std::size_t time, const TemperatureAt& classical);

// Sections of the report.
ReportSection analytic_section_2021(PaperRuns& runs);
ReportSection wall_section_2021(PaperRuns& runs);
ReportSection crossing_section_2021(PaperRuns& runs);
ReportSection layered_section_2021(PaperRuns& runs);

}  // namespace peritherm
