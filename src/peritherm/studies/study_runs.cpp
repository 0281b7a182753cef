#include "peritherm/studies/study_runs.hpp"

#include <algorithm>
#include <cmath>

#include "peritherm/base/text.hpp"
#include "peritherm/output/labels.hpp"
#include "peritherm/simulation/check.hpp"

namespace peritherm {
namespace {

constexpr double whole_slack = 1e-9;
constexpr double most_cells_along = 1e9;

/// Cells along every axis for so many along x.
std::vector<int> cells_of_cubes(const Coordinates& size, double along_x) {
  std::vector<int> cells;
  for (const double length : size) {
    cells.push_back(static_cast<int>(std::lround(std::min(along_x * length / size[0], most_cells_along))));
  }
  return cells;
}

bool are_cubes(const Coordinates& size, int along_x) {
  return std::all_of(size.begin(), size.end(), [&](double length) {
    const double cells = along_x * length / size[0];
    return cells > 0.5 && std::abs(cells - std::round(cells)) <= whole_slack * cells;
  });
}

/// The whole number of cells along x nearest to the wanted one that makes cubes.
int nearest_cells(const Coordinates& size, double wanted) {
  const int start = std::max(1, static_cast<int>(std::lround(std::min(wanted, most_cells_along))));
  for (int off = 0; off <= start / 2; ++off) {
    const bool below_first = wanted < start;
    for (const int cells : {below_first ? start - off : start + off, below_first ? start + off : start - off}) {
      if (cells > 0 && are_cubes(size, cells)) return cells;
    }
  }
  return start;
}

/// Horizon over spacing of a case, as it was written if it was.
double ratio_of(const Problem& problem) {
  if (problem.nonlocality.horizon_ratio) return *problem.nonlocality.horizon_ratio;
  return *problem.nonlocality.horizon / make_grid(problem).spacing;
}

void set_ratio(Problem& problem, double ratio) {
  problem.nonlocality.horizon.reset();
  problem.nonlocality.horizon_ratio = ratio;
}

void set_grid(Problem& problem, const RunChoice& choice) {
  if (choice.cells) {
    problem.body.spacing.reset();
    problem.body.cells = cells_of_cubes(problem.body.size, *choice.cells);
  } else if (choice.spacing) {
    problem.body.cells.reset();
    problem.body.spacing = choice.spacing;
  }
}

void set_step(TimeStepping& stepping, double step) {
  std::visit(
      [step](auto& options) {
        if constexpr (requires { options.step; }) options.step = step;
      },
      stepping);
}

}  // namespace

bool takes_a_step(const TimeStepping& stepping) {
  return std::visit(
      [](const auto& options) {
        return requires { options.step; };
      },
      stepping);
}

void set_tolerance(TimeStepping& stepping, double tolerance) {
  std::visit(
      [tolerance](auto& options) {
        if constexpr (requires { options.relative_tolerance; }) options.relative_tolerance = tolerance;
      },
      stepping);
}

Problem apply_choice(const Problem& base, const RunChoice& choice, double tolerance, double end) {
  Problem problem = base;
  problem.outputs.clear();
  problem.time.end = end > 0.0 ? end : base.time.end;
  set_tolerance(problem.time.integrator, tolerance);
  if (choice.step) set_step(problem.time.integrator, *choice.step);
  const bool gridded = choice.spacing || choice.cells;
  if (gridded) {
    set_grid(problem, choice);
    if (choice.horizon) {
      problem.nonlocality.horizon = choice.horizon;
      problem.nonlocality.horizon_ratio.reset();
    }
    if (choice.horizon_ratio) set_ratio(problem, *choice.horizon_ratio);
  } else if (choice.horizon || choice.horizon_ratio) {
    const double horizon = choice.horizon.value_or(horizon_of(base));
    const double ratio = choice.horizon_ratio.value_or(ratio_of(base));
    problem.body.spacing.reset();
    const int cells = nearest_cells(base.body.size, base.body.size[0] * ratio / horizon);
    problem.body.cells = cells_of_cubes(base.body.size, cells);
    set_ratio(problem, ratio);
  }
  return problem;
}

bool makes_too_many_cells(const Problem& base, const RunChoice& choice) {
  if (choice.spacing) return false;  // Refused as that of a case is.
  double along_x = choice.cells.value_or(0);
  if (!choice.cells && (choice.horizon || choice.horizon_ratio)) {
    along_x =
        base.body.size[0] * choice.horizon_ratio.value_or(ratio_of(base)) / choice.horizon.value_or(horizon_of(base));
  }
  return std::any_of(base.body.size.begin(), base.body.size.end(),
                     [&](double length) { return !(along_x * length / base.body.size[0] <= most_cells_along); });
}

StudyRun describe_run(Problem problem, std::size_t variant) {
  StudyRun run;
  run.variant = variant;
  const Grid grid = make_grid(problem);
  run.entries.fill(-1);
  run.spacing = grid.spacing;
  run.horizon = horizon_of(problem);
  run.horizon_ratio = ratio_of(problem);
  std::visit(
      [&run](const auto& options) {
        if constexpr (requires { options.step; }) run.step = options.step;
      },
      problem.time.integrator);
  run.problem = std::move(problem);
  return run;
}

std::size_t count_values(const StudyAxes& axes, StudyAxis axis) {
  switch (axis) {
    case StudyAxis::horizon:
      return axes.horizons.size();
    case StudyAxis::horizon_ratio:
      return axes.horizon_ratios.size();
    case StudyAxis::spacing:
      return std::max(axes.spacings.size(), axes.cells.size());
    default:
      return axes.time_steps.size();
  }
}

std::string_view axis_name(StudyAxis axis) {
  constexpr std::array<std::string_view, 4> names{"horizon", "horizon ratio", "spacing", "time step"};
  return names[static_cast<std::size_t>(axis)];
}

double axis_value(const StudyRun& run, StudyAxis axis) {
  switch (axis) {
    case StudyAxis::horizon:
      return run.horizon;
    case StudyAxis::horizon_ratio:
      return run.horizon_ratio;
    case StudyAxis::spacing:
      return run.spacing;
    default:
      return run.step.value_or(0.0);
  }
}

std::string axis_text(const StudyRun& run, StudyAxis axis) {
  const double value = axis_value(run, axis);
  if (axis == StudyAxis::horizon_ratio) return rounded_text(value, 4);
  if (axis == StudyAxis::time_step) return time_text(value).substr(4);
  const Unit unit = length_unit(value);
  return rounded_text(value / unit.size, 4) + ' ' + std::string(unit.symbol);
}

std::string run_name(const Study& study, const StudyRun& run) {
  std::vector<std::string> parts;
  if (study.variants.size() > 1) parts.push_back(study.variants[run.variant].name);
  for (const StudyAxis axis : study_axes) {
    const bool varied = run.entries[static_cast<std::size_t>(axis)] >= 0;
    const bool told = axis == StudyAxis::horizon || axis == StudyAxis::horizon_ratio;
    if (varied || (told && parts.size() < 2))
      parts.push_back(std::string(axis_name(axis)) + ' ' + axis_text(run, axis));
  }
  return join(parts);
}

}  // namespace peritherm
