#include "peritherm/papers/bobaru_2012_plates.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "peritherm/base/larger.hpp"
#include "peritherm/simulation/assemble.hpp"
#include "peritherm/simulation/plan.hpp"

namespace peritherm {
namespace {

constexpr double time_tolerance_of_2012 = 1e-7;

Problem in_plate_scheme(Problem problem, PlateScheme scheme) {
  if (scheme == PlateScheme::defaults) return problem;
  return in_scheme(std::move(problem), Scheme::bobaru_2012, PointPlacement::boundary);
}

}  // namespace

double ratio_of_2012(int coarse_cells) { return coarse_cells * 13.0 / 120.0; }

PaperRun square_run(const SquareOf2012& square, std::vector<double> times) {
  PaperBody body;
  body.size = {1.0, 1.0};
  body.diffusivity = square.example == 1 ? 1.14 : 1.0;
  body.cells = square.coarse_cells * square.refinement;
  body.ratio = ratio_of_2012(square.coarse_cells);
  Problem problem = paper_problem(body);
  if (square.example == 1) {
    problem.initial.temperature = 40.0;
    for (const Face face : {Face::x_min, Face::x_max, Face::y_min, Face::y_max}) hold(problem, face, 0.0);
  } else {
    hold(problem, Face::x_min, 1.0);
    if (square.scheme == PlateScheme::mirrored) {
      insulate(problem, Face::y_min, Outside::mirror);
      insulate(problem, Face::y_max, Outside::mirror);
    }
  }
  problem = with_time_error(std::move(problem), time_tolerance_of_2012);
  return {in_plate_scheme(std::move(problem), square.scheme), std::move(times)};
}

ExactSolution classical_square(int example) {
  const double side = centimetre;
  const double area = centimetre * centimetre;
  if (example == 1) return HeldBox{{side, side}, 1.14 * area, 40.0, 0.0};
  return HeldAndInsulated{side, area, 0.0, 1.0};
}

Problem cracked_plate(int cells, double diffusivity, PlateScheme scheme) {
  PaperBody body;
  body.origin = {-1.0, -1.0};
  body.size = {2.0, 2.0};
  body.diffusivity = diffusivity;
  body.cells = cells;
  body.ratio = 6.5;
  Problem problem = paper_problem(body);
  hold(problem, Face::y_min, -100.0);
  hold(problem, Face::y_max, 100.0);
  return in_plate_scheme(std::move(problem), scheme);
}

std::vector<Point> flux_of_solution(const Problem& problem, const Solution& solution, std::size_t time) {
  const Problem prepared = prepare(problem).problem;
  const Assembly assembly = assemble(prepared);
  FieldStorage state = initial_state(prepared, assembly);
  const std::vector<double>& temperatures = solution.temperatures.at(time);
  assembly.layout.for_rows([&](std::size_t entry, std::size_t number, std::size_t length) {
    for (std::size_t k = 0; k < length; ++k) state[entry + k] = temperatures[number + k];
  });
  assembly.system->begin_step(solution.times[time], solution.times[time]);
  assembly.system->fill(solution.times[time], state);
  return heat_flux(assembly, state);
}

std::vector<ProbeLine> probe_lines(std::string_view table) {
  std::vector<ProbeLine> lines;
  std::istringstream text{std::string(table)};
  for (std::string line; std::getline(text, line);) {
    if (line.empty()) continue;
    std::istringstream words(line);
    ProbeLine& probe = lines.emplace_back();
    std::string scheme;
    words >> probe.cells >> probe.time >> scheme;
    probe.defaults = scheme == "defaults";
    for (std::string word; words >> word;) {
      probe.values.push_back(word == "-" ? std::numeric_limits<double>::quiet_NaN() : std::stod(word));
    }
  }
  return lines;
}

std::vector<Point> probe_places(std::string_view places) {
  std::vector<Point> result;
  std::istringstream words{std::string(places)};
  for (std::string word; words >> word;) {
    const std::size_t comma = word.find(',');
    result.push_back(
        {std::stod(word.substr(0, comma)) * centimetre, std::stod(word.substr(comma + 1)) * centimetre, 0.0});
  }
  return result;
}

void add_probe_rows(ReportTable& table, std::string_view places, std::string_view lines, bool defaults,
                    const Solution& solution, double limit) {
  const std::vector<Point> at = probe_places(places);
  for (const ProbeLine& line : probe_lines(lines)) {
    if (line.cells != solution.grid.cells[0] || line.defaults != defaults) continue;
    std::size_t time = 0;
    while (time < solution.times.size() && std::abs(solution.times[time] - line.time) > 1e-9) ++time;
    if (time == solution.times.size()) continue;
    double largest = 0.0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (std::isnan(line.values[k])) continue;
      largest = larger(largest, std::abs(solution.at(time, at[k]) - line.values[k]));
    }
    ReportRow row(fmt::format("{}, n = {}, t = {} s, at {} places", defaults ? "defaults" : "published scheme",
                              line.cells, line.time, at.size()),
                  {5, false});
    row.below("largest difference", largest, limit);
    table.rows.push_back(row);
  }
}

}  // namespace peritherm
