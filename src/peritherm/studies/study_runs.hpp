#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "peritherm/simulation/problem.hpp"
#include "peritherm/studies/study.hpp"

namespace peritherm {

/// What a study may vary, in the order in which runs are nested.
enum class StudyAxis { horizon, horizon_ratio, spacing, time_step };
inline constexpr std::array study_axes{StudyAxis::horizon, StudyAxis::horizon_ratio, StudyAxis::spacing,
                                       StudyAxis::time_step};

/// One run of a study.
struct StudyRun {
  Problem problem;               ///< ready to be solved: no outputs, its end is the last time of the study
  std::size_t variant = 0;       ///< number in the list of variants
  std::array<int, 4> entries{};  ///< per axis: the entry of its list; −1: the axis is not varied
  double horizon = 0.0;          ///< [m]
  double horizon_ratio = 0.0;    ///< m
  double spacing = 0.0;          ///< [m]
  std::optional<double> step;    ///< of a fixed-step integrator, if it was given [s]
};

/// Values that replace those of a case; what is left out follows from the case as `StudyAxes` says.
struct RunChoice {
  std::optional<double> horizon;
  std::optional<double> horizon_ratio;
  std::optional<double> spacing;
  std::optional<int> cells;  ///< along x, instead of spacing
  std::optional<double> step;
};

/// The case with these values, for the times up to `end`, with this relative tolerance. Horizon and ratio together give
/// the number of cells, rounded to whole ones; the ratio is exact, so that the horizon may differ by part of a spacing.
Problem apply_choice(const Problem& base, const RunChoice& choice, double tolerance, double end);

/// Would a choice make more than 1e9 cells along an axis? `apply_choice` then takes fewer.
bool makes_too_many_cells(const Problem& base, const RunChoice& choice);

/// A run with its numbers; the problem's body must be sound.
StudyRun describe_run(Problem problem, std::size_t variant);

/// Is the integrator one with a fixed step?
bool takes_a_step(const TimeStepping& stepping);

/// Sets a tolerance that the integrator has; a method of fixed step is left alone.
void set_tolerance(TimeStepping& stepping, double tolerance);

/// Number of values along an axis; 0: it is not varied.
std::size_t count_values(const StudyAxes& axes, StudyAxis axis);

/// "trapezoid, horizon 5 mm, horizon ratio 4": the variant if there are several, what is varied, and before two parts
/// stand there horizon and ratio in any case.
std::string run_name(const Study& study, const StudyRun& run);

/// "horizon", "horizon ratio", "spacing", "time step".
std::string_view axis_name(StudyAxis axis);

/// Value of a run along an axis [m, 1, m, s].
double axis_value(const StudyRun& run, StudyAxis axis);

/// "5 mm", "4", "20 ms".
std::string axis_text(const StudyRun& run, StudyAxis axis);

}  // namespace peritherm
