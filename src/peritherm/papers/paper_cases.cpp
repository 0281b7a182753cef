#include "peritherm/papers/paper_cases.hpp"

#include <algorithm>
#include <cmath>

namespace peritherm {
namespace {

Coordinates in_metres(Coordinates lengths) {
  for (double& length : lengths) length *= centimetre;
  return lengths;
}

}  // namespace

Material paper_material(double diffusivity_cm2) { return {100.0 * diffusivity_cm2, 1e6, 1.0}; }

Problem paper_problem(const PaperBody& body) {
  Problem problem;
  problem.body.size = in_metres(body.size);
  if (!body.origin.empty()) problem.body.origin = in_metres(body.origin);
  std::vector<int> cells;
  for (const double length : body.size)
    cells.push_back(static_cast<int>(std::lround(body.cells * length / body.size[0])));
  problem.body.cells = cells;
  problem.body.points = PointPlacement::boundary;
  problem.body.material = "body";
  problem.materials["body"] = paper_material(body.diffusivity);
  problem.nonlocality.horizon_ratio = body.ratio;
  problem.nonlocality.kernel.form = body.kernel;
  problem.time.end = 1.0;
  return problem;
}

void hold(Problem& problem, Face face, double temperature) {
  HeldTemperature held;
  held.value = temperature;
  problem.boundaries.push_back({face, std::nullopt, held});
}

void insulate(Problem& problem, Face face, Outside imposed) {
  Insulated insulated;
  insulated.imposed = imposed;
  problem.boundaries.push_back({face, std::nullopt, insulated});
}

void add_paper_crack(Problem& problem, const Coordinates& from_cm, const Coordinates& to_cm) {
  Crack& crack = problem.cracks.emplace_back();
  crack.points = {in_metres(from_cm), in_metres(to_cm)};
  crack.faces = Faces::cut;
}

Problem in_scheme(Problem problem, Scheme scheme, PointPlacement points) {
  problem.nonlocality.scheme = scheme;
  problem.body.points = points;
  return problem;
}

Problem with_time_error(Problem problem, double relative_tolerance) {
  problem.time.integrator = AutomaticStepping{relative_tolerance};
  return problem;
}

ComparedPoints compare_bar(const Solution& solution, std::size_t time, const ClassicalTemperature& classical) {
  ComparedPoints points;
  for (int i = 0; i < solution.grid.count(0); ++i) {
    const Point place = solution.grid.position({i, 0, 0});
    points.x.push_back(place[0] / centimetre);
    points.computed.push_back(solution.temperatures.at(time)[solution.grid.number({i, 0, 0})]);
    points.classical.push_back(classical(place, solution.times[time]));
  }
  return points;
}

ComparedPoints compare_row(const Solution& solution, std::size_t time, double y,
                           const ClassicalTemperature& classical) {
  const Grid& grid = solution.grid;
  const int row = static_cast<int>(std::lround((y - grid.origin[1]) / grid.spacing - grid.first_depth()));
  ComparedPoints points;
  for (int i = 0; i < grid.count(0); ++i) {
    const Point place = grid.position({i, row, 0});
    points.x.push_back(place[0] / centimetre);
    points.computed.push_back(solution.temperatures.at(time)[grid.number({i, row, 0})]);
    points.classical.push_back(classical(place, solution.times[time]));
  }
  return points;
}

double measure(StudyNorm norm, const ComparedPoints& points) {
  return measure(norm, points.computed, points.classical);
}

ComparedPoints without_zeros(const ComparedPoints& points) {
  ComparedPoints result;
  for (std::size_t n = 0; n < points.x.size(); ++n) {
    if (std::abs(points.classical[n]) < 1e-9) continue;
    result.x.push_back(points.x[n]);
    result.computed.push_back(points.computed[n]);
    result.classical.push_back(points.classical[n]);
  }
  return result;
}

ReportRow difference_change_row(const std::string& what, double change, double limit) {
  ReportRow row("error in time: change of the relative difference with a tenth of the tolerance, " + what, {1, true});
  return row.below("change", change, limit);
}

ReportRow time_error_row(const std::string& what, const Solution& run, const Solution& tighter, double limit) {
  ReportRow row("error in time: largest change with a tenth of the tolerance, " + what, {1, true});
  row.below("change", largest_difference(run, tighter), limit);
  return row;
}

}  // namespace peritherm
